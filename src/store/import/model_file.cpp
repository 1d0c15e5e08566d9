#include "store/import/model_file.h"

#include <abut/error.h>

#include "core/progress.h"
#include "io/file/fault.h"
#include "io/file/input_file.h"
#include "io/file/random_access_file.h"

#include <algorithm>
#include <filesystem>
#include <span>
#include <sys/stat.h>
#include <vector>

namespace abut {

std::string absolute_path(const std::string& file) {
    std::error_code ignored;
    const std::string path = std::filesystem::weakly_canonical(file, ignored).string();
    return path.empty() ? file : path;
}

ModelFile look_at(const std::string& file) {
    ModelFile result;
    try {
        result.bytes = readable_size(file);
    } catch (const Fault& fault) {
        throw Error(fault.code(), file, fault.what());
    }
    result.path = absolute_path(file);
    struct stat status {};
    if (stat(file.c_str(), &status) == 0)
        result.modified =
            std::int64_t{status.st_mtim.tv_sec} * 1'000'000'000 + status.st_mtim.tv_nsec;
    return result;
}

Hash128 content_hash(const std::string& file, const Progress& progress) {
    try {
        const RandomAccessFile content(file);
        Hasher hasher;
        std::vector<std::byte> buffer;
        for (std::uint64_t at = 0; at < content.size(); at += buffer.size()) {
            check_stop(progress);
            buffer.resize(std::min<std::uint64_t>(std::uint64_t{1} << 20, content.size() - at));
            content.read(at, buffer);
            hasher.add(buffer);
        }
        return hasher.value();
    } catch (const Fault& fault) {
        throw Error(fault.code(), file, fault.what());
    }
}

} // namespace abut
