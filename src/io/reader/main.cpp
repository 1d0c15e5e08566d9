// abut-reader PARENT MEMORY --read FILE
//     reads a model with Assimp, writes scene_stream.h to descriptor 3
// abut-reader PARENT MEMORY --decode
//     decodes the compressed geometry of decode_request.h on descriptor 3
// abut-reader PARENT MEMORY --exec PROGRAM SCRIPT FILE …
//     becomes another reader, under the same precautions; it may read SCRIPT's folder and FILE
//
// The library starts this program; users do not. PARENT is the process with which it dies. MEMORY
// is the number of bytes of address space that it may use, 0 for no limit.

#include "io/file/fault.h"
#include "io/process/scene_stream.h"
#include "io/reader/confine.h"
#include "io/reader/decode.h"
#include "io/reader/read_model.h"
#include "io/reader/stream_writer.h"

#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
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

/// Keeps freed memory. This process reads one file and ends, and reuses freed memory soon.
/// Importing then takes half the time or less.
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
    abut::confine_reader(file);
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
    // Nothing is destroyed: the system frees all memory at once.
    _exit(0);
}

[[noreturn]] void decode() {
    keep_freed_memory();
    std::set_new_handler(end_for_lack_of_memory);
    abut::confine_reader("");
    try {
        abut::decode_geometry(abut::scene_stream::kResultFile);
    } catch (const std::bad_alloc&) {
        end_for_lack_of_memory();
    } catch (const std::exception&) {
        _exit(kCannotStart);
    }
    _exit(0);
}

/// Becomes another reader. In: arguments, the program, its script, the file …
[[noreturn]] void become(char** arguments) {
    const std::filesystem::path folder = std::filesystem::path(arguments[1]).parent_path();
    // A link may place the modules elsewhere.
    abut::confine_program(arguments[0], {folder, folder / "node_modules", arguments[2]});
    execv(arguments[0], arguments);
    _exit(kCannotStart);
}

} // namespace

int main(int count, char** arguments) {
    if (count < 4)
        return kBadUsage;
    take_precautions(static_cast<pid_t>(std::strtol(arguments[1], nullptr, 10)),
                     std::strtoull(arguments[2], nullptr, 10));
    if (std::strcmp(arguments[3], "--decode") == 0)
        decode();
    if (count > 4 && std::strcmp(arguments[3], "--read") == 0)
        read(arguments[4]);
    if (count > 6 && std::strcmp(arguments[3], "--exec") == 0)
        become(arguments + 4);
    return kBadUsage;
}
