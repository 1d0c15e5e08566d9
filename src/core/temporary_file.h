#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace abut {

/// In place of a folder: the file is kept in memory.
inline constexpr const char* kInMemory = ":memory:";

/// A file without a name: it is gone with the process that made it, however that ends.
///
/// Reads and writes at any place, from any thread; what is written by one thread and read by
/// another must be ordered by the caller.
class TemporaryFile {
public:
    /// In          folder: where the disk space is taken from, or kInMemory.
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

    /// As many of the bytes as the file has; how many.
    std::size_t read_some(std::uint64_t at, std::span<std::byte> bytes) const;

    [[nodiscard]] const std::string& folder() const noexcept { return folder_; }
    /// To hand the file to another process.
    [[nodiscard]] int descriptor() const noexcept { return descriptor_; }

private:
    std::string folder_;
    int descriptor_ = -1;
};

/// Reads a temporary file through a window: cheap where places follow each other. One thread.
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

/// Writes to the end of a temporary file through a buffer.
class TemporaryWriter {
public:
    explicit TemporaryWriter(TemporaryFile& file, std::uint64_t at = 0,
                             std::size_t buffer_bytes = std::size_t{1} << 16);
    TemporaryWriter(const TemporaryWriter&) = delete;
    TemporaryWriter& operator=(const TemporaryWriter&) = delete;

    /// Errors      as TemporaryFile::write.
    void append(const void* data, std::size_t size);
    /// To be called before the file is read, and at the end.
    void flush();
    /// Where the next byte goes.
    [[nodiscard]] std::uint64_t end() const noexcept { return written_ + used_; }

private:
    TemporaryFile& file_;
    std::vector<std::byte> buffer_;
    std::size_t used_ = 0;
    std::uint64_t written_;
};

} // namespace abut
