#include "io/file/byte_stream.h"

#include "io/file/fault.h"
#include "io/file/input_file.h"
#include "io/file/read_watch.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <unistd.h>
#include <utility>

namespace abut {

namespace {

constexpr std::size_t kBlock = std::size_t{1} << 18;

} // namespace

/// Owns the descriptor of an open file.
class ByteStream::Descriptor {
public:
    explicit Descriptor(int number) : number_(number) {}
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    ~Descriptor() { close(number_); }

    /// Returns the number of bytes read; 0 at the end.
    std::size_t read_some(char* to, std::size_t most) const {
        ssize_t count = 0;
        do
            count = read(number_, to, most);
        while (count < 0 && errno == EINTR);
        if (count < 0)
            throw Fault(ErrorCode::unreadable,
                        std::string("cannot be read: ") + std::strerror(errno));
        return static_cast<std::size_t>(count);
    }

private:
    int number_;
};

ByteStream ByteStream::open(const std::string& path, std::shared_ptr<const ReadWatch> watch) {
    const OpenFile file = open_readable(path);
    ByteStream stream{std::string_view()};
    stream.file_ = std::make_shared<const Descriptor>(file.descriptor);
    stream.watch_ = std::move(watch);
    stream.unread_ = file.size;
    return stream;
}

bool ByteStream::more() {
    if (file_ == nullptr)
        return false;
    if (watch_ != nullptr)
        watch_->check();
    const std::size_t kept = ahead_.size();
    if (kept > 0)
        std::memmove(buffer_.data(), ahead_.data(), kept);
    if (buffer_.size() < kept + kBlock)
        buffer_.resize(std::max(2 * kept, kept + kBlock));
    const std::size_t count = file_->read_some(buffer_.data() + kept, buffer_.size() - kept);
    ahead_ = {buffer_.data(), kept + count};
    unread_ -= std::min<std::uint64_t>(unread_, count);
    return count > 0;
}

} // namespace abut
