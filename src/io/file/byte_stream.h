#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace abut {

class ReadWatch;

/// The bytes of a text, or of a file of any size, in their order; of a file, some at a time are in
/// memory.
class ByteStream {
public:
    /// In          whole: must outlive the stream.
    explicit ByteStream(std::string_view whole) : ahead_(whole) {}

    /// In          watch: is asked whenever bytes are read; null: nobody is.
    /// Errors      as readable_size.
    static ByteStream open(const std::string& path,
                           std::shared_ptr<const ReadWatch> watch = nullptr);

    /// The next bytes, as many as are in memory. They stay where they are until `more` or `has`.
    [[nodiscard]] std::string_view ahead() const noexcept { return ahead_; }

    /// In          bytes: no more than are ahead.
    void take(std::size_t bytes) { ahead_.remove_prefix(bytes); }

    /// Brings more bytes into memory. False at the end.
    ///
    /// Errors      Fault unreadable; Error of the watch.
    /// Cost        no more than twice the bytes ahead are held, or some 512 KiB.
    bool more();

    /// Whether so many bytes follow; they are ahead then. Errors as more.
    bool has(std::size_t bytes) {
        while (ahead_.size() < bytes)
            if (!more())
                return false;
        return true;
    }

    /// How many bytes follow; of a file that is not being written to.
    [[nodiscard]] std::uint64_t left() const noexcept { return ahead_.size() + unread_; }

private:
    class Descriptor;

    std::string_view ahead_;
    std::shared_ptr<const Descriptor> file_; ///< none: all there is, is ahead
    std::shared_ptr<const ReadWatch> watch_;
    std::vector<char> buffer_;
    std::uint64_t unread_ = 0; ///< bytes of the file
};

} // namespace abut
