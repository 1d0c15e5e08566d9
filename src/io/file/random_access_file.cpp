#include "io/file/random_access_file.h"

#include "io/file/fault.h"
#include "io/file/input_file.h"
#include "io/file/read_watch.h"

#include <cerrno>
#include <cstring>
#include <unistd.h>
#include <utility>

namespace abut {

RandomAccessFile::RandomAccessFile(const std::string& path, std::shared_ptr<const ReadWatch> watch)
    : watch_(std::move(watch)) {
    const OpenFile file = open_readable(path);
    descriptor_ = file.descriptor;
    size_ = file.size;
}

RandomAccessFile::~RandomAccessFile() {
    close(descriptor_);
}

void RandomAccessFile::read(std::uint64_t at, std::span<std::byte> bytes) const {
    if (watch_ != nullptr)
        watch_->check();
    while (!bytes.empty()) {
        const ssize_t count =
            pread(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(at));
        if (count < 0 && errno == EINTR)
            continue;
        if (count < 0)
            throw Fault(ErrorCode::unreadable,
                        std::string("cannot be read: ") + std::strerror(errno));
        if (count == 0)
            throw Fault(ErrorCode::unreadable, "became shorter while it was read");
        at += static_cast<std::uint64_t>(count);
        bytes = bytes.subspan(static_cast<std::size_t>(count));
    }
}

} // namespace abut
