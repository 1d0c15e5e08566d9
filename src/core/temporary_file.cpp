#include "core/temporary_file.h"

#include <abut/error.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

namespace abut {

namespace {

int open_without_name(const std::string& folder) {
    if (folder == kInMemory)
        return memfd_create("abut-temporary", MFD_CLOEXEC);
    const int file = open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
    if (file >= 0 || (errno != EOPNOTSUPP && errno != EISDIR && errno != EINVAL))
        return file;
    // Some file systems, such as network ones, cannot create a file without a name. The file is
    // then created with a name, which is removed at once.
    std::string name = folder + "/.abut-XXXXXX";
    const int named = mkostemp(name.data(), O_CLOEXEC);
    if (named >= 0)
        unlink(name.c_str());
    return named;
}

} // namespace

TemporaryFile::TemporaryFile(const std::string& folder)
    : folder_(folder.empty() ? std::string(1, '.') : folder) {
    descriptor_ = open_without_name(folder_);
    if (descriptor_ < 0)
        throw Error(ErrorCode::cannot_write, folder_,
                    std::string("holds no temporary file: ") + std::strerror(errno));
}

TemporaryFile::~TemporaryFile() {
    close(descriptor_);
}

void TemporaryFile::write(std::uint64_t at, std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const ssize_t count =
            pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(at));
        if (count < 0 && errno == EINTR)
            continue;
        if (count <= 0)
            throw Error(ErrorCode::cannot_write, folder_,
                        std::string("a temporary file cannot be written: ") + std::strerror(errno));
        at += static_cast<std::uint64_t>(count);
        bytes = bytes.subspan(static_cast<std::size_t>(count));
    }
}

void TemporaryFile::read(std::uint64_t at, std::span<std::byte> bytes) const {
    if (read_some(at, bytes) != bytes.size())
        throw Error(ErrorCode::unreadable, folder_, "a temporary file cannot be read");
}

std::size_t TemporaryFile::read_some(std::uint64_t at, std::span<std::byte> bytes) const {
    std::size_t done = 0;
    while (done < bytes.size()) {
        const ssize_t count = pread(descriptor_, bytes.data() + done, bytes.size() - done,
                                    static_cast<off_t>(at + done));
        if (count < 0 && errno == EINTR)
            continue;
        if (count <= 0)
            break;
        done += static_cast<std::size_t>(count);
    }
    return done;
}

void TemporaryReader::read(std::uint64_t at, std::span<std::byte> bytes) {
    if (bytes.size() > kWindowBytes) {
        file_.read(at, bytes);
        return;
    }
    if (at < start_ || at + bytes.size() > start_ + window_.size()) {
        window_.resize(kWindowBytes);
        window_.resize(file_.read_some(at, window_));
        start_ = at;
        if (bytes.size() > window_.size())
            throw Error(ErrorCode::unreadable, file_.folder(), "a temporary file cannot be read");
    }
    std::copy_n(window_.begin() + static_cast<std::ptrdiff_t>(at - start_), bytes.size(),
                bytes.begin());
}

TemporaryWriter::TemporaryWriter(TemporaryFile& file, std::uint64_t at, std::size_t buffer_bytes)
    : file_(file), buffer_(buffer_bytes), written_(at) {}

void TemporaryWriter::append(const void* data, std::size_t size) {
    const auto* bytes = static_cast<const std::byte*>(data);
    while (size > 0) {
        if (used_ == buffer_.size())
            flush();
        const std::size_t count = std::min(size, buffer_.size() - used_);
        std::memcpy(buffer_.data() + used_, bytes, count);
        used_ += count;
        bytes += count;
        size -= count;
    }
}

void TemporaryWriter::flush() {
    file_.write(written_, std::span(buffer_).first(used_));
    written_ += used_;
    used_ = 0;
}

} // namespace abut
