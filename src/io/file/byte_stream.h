#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace abut {

class ReadWatch;

/// The bytes of a text, or of a file of any size, in order. Only some bytes of a file are in memory
/// at a time.
class ByteStream {
public:
    /// In          whole: must outlive the stream.
    explicit ByteStream(std::string_view whole) : ahead_(whole) {}

    /// In          watch: checked whenever bytes are read; may be null.
    /// Errors      as readable_size.
    static ByteStream open(const std::string& path,
                           std::shared_ptr<const ReadWatch> watch = nullptr);

    /// Returns the next bytes that are in memory. They stay valid until `more` or `has` is called.
    [[nodiscard]] std::string_view ahead() const noexcept { return ahead_; }

    /// Skips bytes. In: no more than `ahead` holds.
    void take(std::size_t bytes) { ahead_.remove_prefix(bytes); }

    /// Reads more bytes into memory. False at the end.
    ///
    /// Errors      Fault unreadable; Error of the watch.
    /// Cost        memory of at most twice the bytes ahead, or about 512 KiB.
    bool more();

    /// Returns whether this many bytes follow, and reads them into memory. Errors as `more`.
    bool has(std::size_t bytes) {
        while (ahead_.size() < bytes)
            if (!more())
                return false;
        return true;
    }

    /// Number of bytes that follow; for a file, only if nobody is writing to it.
    [[nodiscard]] std::uint64_t left() const noexcept { return ahead_.size() + unread_; }

private:
    class Descriptor;

    std::string_view ahead_;
    std::shared_ptr<const Descriptor> file_; ///< null if all bytes are in memory
    std::shared_ptr<const ReadWatch> watch_;
    std::vector<char> buffer_;
    std::uint64_t unread_ = 0; ///< bytes of the file that are not yet in memory
};

} // namespace abut
