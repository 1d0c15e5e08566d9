// abut-reader PARENT MEMORY --read FILE        reads a model with Assimp, writes scene_stream.h to
// descriptor 3 abut-reader PARENT MEMORY --exec PROGRAM …   becomes another reader, under the same
// precautions
//
// Not for users: the library starts it. PARENT is the process that it dies with; MEMORY the bytes
// of address space that it may take, 0 for any.

#include "io/fault.h"
#include "io/reader/read_model.h"
#include "io/reader/stream_writer.h"
#include "io/scene_stream.h"

#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <malloc.h>
#include <new>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

namespace {

constexpr int kBadUsage = 64;
constexpr int kCannotStart = 127;

void set_limit(__rlimit_resource resource, std::uint64_t value) {
    const rlimit limit{value, value};
    setrlimit(resource, &limit);
}

void take_precautions(pid_t parent, std::uint64_t memory) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent)
        _exit(kCannotStart); // The parent died before the line above.
    set_limit(RLIMIT_CORE, 0);
    if (memory > 0) {
        std::signal(SIGXFSZ, SIG_IGN);
        set_limit(RLIMIT_AS, memory);
        set_limit(RLIMIT_FSIZE, memory);
    }
}

/// This process reads one file and ends: memory that is freed soon comes back, so none is given
/// back to the system. Importing takes half the time or less.
void keep_freed_memory() {
    mallopt(M_MMAP_THRESHOLD, 1 << 30);
    mallopt(M_TRIM_THRESHOLD, 1 << 30);
    mallopt(M_TOP_PAD, 4 << 20);
}

[[noreturn]] void end_for_lack_of_memory() {
    _exit(abut::scene_stream::kOutOfMemory);
}

[[noreturn]] void read(const char* file) {
    keep_freed_memory();
    std::set_new_handler(end_for_lack_of_memory);
    abut::StreamWriter writer(abut::scene_stream::kResultFile);
    try {
        abut::read_model(file, writer);
    } catch (const abut::Fault& fault) {
        writer.error(fault.code(), fault.what());
    } catch (const std::bad_alloc&) {
        end_for_lack_of_memory();
    } catch (const std::exception& error) {
        writer.error(abut::ErrorCode::malformed, error.what());
    }
    // Nothing is destroyed: the system takes all of it back at once.
    _exit(0);
}

} // namespace

int main(int count, char** arguments) {
    if (count < 5)
        return kBadUsage;
    take_precautions(static_cast<pid_t>(std::strtol(arguments[1], nullptr, 10)),
                     std::strtoull(arguments[2], nullptr, 10));
    if (std::strcmp(arguments[3], "--read") == 0)
        read(arguments[4]);
    if (std::strcmp(arguments[3], "--exec") == 0) {
        execv(arguments[4], arguments + 4);
        return kCannotStart;
    }
    return kBadUsage;
}
