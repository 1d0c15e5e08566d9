#include "io/random_access_file.h"

#include "io/fault.h"
#include "io/input_file.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <unistd.h>

namespace abut {

RandomAccessFile::RandomAccessFile(const std::string& path) : size_(readable_size(path)) {
    descriptor_ = open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor_ < 0)
        throw Fault(ErrorCode::unreadable, std::string("cannot be read: ") + std::strerror(errno));
}

RandomAccessFile::~RandomAccessFile() {
    close(descriptor_);
}

void RandomAccessFile::read(std::uint64_t at, std::span<std::byte> bytes) const {
    while (!bytes.empty()) {
        const ssize_t count =
            pread(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(at));
        if (count < 0 && errno == EINTR)
            continue;
        if (count < 0)
            throw Fault(ErrorCode::unreadable,
                        std::string("cannot be read: ") + std::strerror(errno));
        if (count == 0)
            throw Fault(ErrorCode::unreadable, "has become shorter while it was read");
        at += static_cast<std::uint64_t>(count);
        bytes = bytes.subspan(static_cast<std::size_t>(count));
    }
}

} // namespace abut
