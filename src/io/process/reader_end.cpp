#include "io/process/reader_end.h"

#include <abut/error.h>

#include "io/file/read_watch.h"
#include "io/process/scene_stream.h"

#include <cstring>

namespace abut {

void check_end(const ChildReport& report, const std::string& file, const ChildLimits& limits) {
    const auto failed = [&](const std::string& what) {
        throw Error(ErrorCode::reader_failed, file, what);
    };
    switch (report.end) {
    case ChildEnd::exited:
        if (report.status == scene_stream::kOutOfMemory)
            throw_memory_limit(file, limits.bytes);
        if (report.status != 0)
            failed("its reader failed with exit status " + std::to_string(report.status));
        return;
    case ChildEnd::killed:
        failed(std::string("its reader crashed: ") + strsignal(report.status));
        return;
    case ChildEnd::time_limit:
        throw_time_limit(file, limits.seconds);
    case ChildEnd::memory_limit:
        throw_memory_limit(file, limits.bytes);
    case ChildEnd::stopped:
        throw Error(ErrorCode::interrupted, "interrupted");
    }
}

} // namespace abut
