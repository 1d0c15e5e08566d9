#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

namespace abut {

class ReadWatch;

/// A file that any thread can read at any position.
class RandomAccessFile {
public:
    /// In          watch: checked whenever bytes are read; may be null.
    /// Errors      Fault as readable_size.
    explicit RandomAccessFile(const std::string& path,
                              std::shared_ptr<const ReadWatch> watch = nullptr);
    ~RandomAccessFile();
    RandomAccessFile(const RandomAccessFile&) = delete;
    RandomAccessFile& operator=(const RandomAccessFile&) = delete;

    [[nodiscard]] std::uint64_t size() const noexcept { return size_; }

    /// Errors      Fault unreadable, also if the file has become shorter; Error of the watch.
    void read(std::uint64_t at, std::span<std::byte> bytes) const;

    template <typename Value>
    [[nodiscard]] Value value(std::uint64_t at) const {
        Value result{};
        read(at, std::as_writable_bytes(std::span(&result, 1)));
        return result;
    }

private:
    int descriptor_ = -1;
    std::uint64_t size_ = 0;
    std::shared_ptr<const ReadWatch> watch_;
};

} // namespace abut
