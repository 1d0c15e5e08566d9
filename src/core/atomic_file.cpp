#include "core/atomic_file.h"

#include <abut/error.h>

#include <atomic>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <unistd.h>

namespace abut {

namespace {

[[noreturn]] void fail(const std::string& path, const std::string& temporary, int fault) {
    unlink(temporary.c_str());
    throw Error(ErrorCode::cannot_write, path,
                std::string("cannot be written: ") + std::strerror(fault));
}

} // namespace

void write_file_atomically(const std::string& path, std::string_view content) {
    // O_EXCL makes a new file, so that no other writer's temporary file is overwritten or removed.
    // The other writer may be a thread, or a process with the same id on another machine.
    static std::atomic<std::uint64_t> writers{0};
    std::string temporary;
    int file = -1;
    do {
        temporary = path + ".part" + std::to_string(getpid()) + "-" + std::to_string(writers++);
        file = open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    } while (file < 0 && errno == EEXIST);
    if (file < 0)
        throw Error(ErrorCode::cannot_write, path,
                    std::string("cannot be written: ") + std::strerror(errno));
    while (!content.empty()) {
        const ssize_t written = write(file, content.data(), content.size());
        if (written < 0 && errno == EINTR)
            continue;
        if (written < 0) {
            const int fault = errno;
            close(file);
            fail(path, temporary, fault);
        }
        content.remove_prefix(static_cast<std::size_t>(written));
    }
    if (close(file) != 0 || std::rename(temporary.c_str(), path.c_str()) != 0)
        fail(path, temporary, errno);
}

} // namespace abut
