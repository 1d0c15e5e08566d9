#include "core/atomic_file.h"

#include <abut/error.h>

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <mutex>

namespace abut {

namespace {

// One file is written at a time, so a handler has one name to remove.
std::mutex g_writing;
std::array<char, 4096> g_pending{};
std::atomic<bool> g_has_pending{false};

[[noreturn]] void fail(const std::string& path, const std::string& temporary, int fault) {
    if (!temporary.empty())
        unlink(temporary.c_str());
    g_has_pending = false;
    throw Error(ErrorCode::cannot_write, path, std::string("cannot be written: ") + std::strerror(fault));
}

} // namespace

void write_file_atomically(const std::string& path, std::string_view content) {
    const std::scoped_lock lock(g_writing);
    const std::string temporary = path + ".part" + std::to_string(getpid());
    if (temporary.size() + 1 > g_pending.size())
        fail(path, "", ENAMETOOLONG);
    std::memcpy(g_pending.data(), temporary.c_str(), temporary.size() + 1);

    const int file = open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (file < 0)
        fail(path, "", errno);
    g_has_pending = true;
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
    g_has_pending = false;
}

void remove_pending_files() noexcept {
    if (g_has_pending)
        unlink(g_pending.data());
}

} // namespace abut
