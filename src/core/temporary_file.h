#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace abut {

/// Used instead of a folder to keep the file in memory.
inline constexpr const char* kInMemory = ":memory:";

/// A file without a name. It disappears with the process that made it, however that ends.
///
/// Any thread may read and write at any place. If one thread writes what another reads, the caller
/// must synchronise them.
class TemporaryFile {
public:
    /// In          folder: where the disk space is used, or kInMemory.
    /// Errors      Error{cannot_write}, naming the folder.
    explicit TemporaryFile(const std::string& folder);
    ~TemporaryFile();
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;

    /// Errors      Error{cannot_write}, naming the folder, if the disk is full.
    void write(std::uint64_t at, std::span<const std::byte> bytes);

    /// In          bytes that were written before.
    /// Errors      Error{unreadable}, naming the folder.
    void read(std::uint64_t at, std::span<std::byte> bytes) const;

    /// Reads as many of the bytes as the file has. Returns their number.
    std::size_t read_some(std::uint64_t at, std::span<std::byte> bytes) const;

    [[nodiscard]] const std::string& folder() const noexcept { return folder_; }
    /// The file descriptor, to pass the file to another process.
    [[nodiscard]] int descriptor() const noexcept { return descriptor_; }

private:
    std::string folder_;
    int descriptor_ = -1;
};

/// Reads a temporary file through a window, which makes consecutive reads cheap. For one thread.
class TemporaryReader {
public:
    explicit TemporaryReader(const TemporaryFile& file) : file_(file) {}

    /// Errors      as TemporaryFile::read.
    void read(std::uint64_t at, std::span<std::byte> bytes);

private:
    static constexpr std::size_t kWindowBytes = std::size_t{1} << 16;

    const TemporaryFile& file_;
    std::vector<std::byte> window_;
    std::uint64_t start_ = 0;
};

/// Appends to a temporary file through a buffer.
class TemporaryWriter {
public:
    explicit TemporaryWriter(TemporaryFile& file, std::uint64_t at = 0,
                             std::size_t buffer_bytes = std::size_t{1} << 16);
    TemporaryWriter(const TemporaryWriter&) = delete;
    TemporaryWriter& operator=(const TemporaryWriter&) = delete;

    /// Errors      as TemporaryFile::write.
    void append(const void* data, std::size_t size);
    /// Call it before the file is read, and at the end.
    void flush();
    /// Offset of the next byte to be written.
    [[nodiscard]] std::uint64_t end() const noexcept { return written_ + used_; }

private:
    TemporaryFile& file_;
    std::vector<std::byte> buffer_;
    std::size_t used_ = 0;
    std::uint64_t written_;
};

} // namespace abut
