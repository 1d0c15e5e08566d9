#include "io/reader/zip_archive.h"

#include "io/file/fault.h"
#include "io/file/input_file.h"

#include <algorithm>
#include <cctype>
#include <limits>
#include <zlib.h>

namespace abut {

namespace {

constexpr std::uint64_t kEndBytes = 22, kRecordBytes = 46, kLocalBytes = 30;
constexpr std::uint32_t kRecordMark = 0x02014b50, kLocalMark = 0x04034b50;
constexpr std::uint16_t kStored = 0, kDeflated = 8;
// The text of models is compressed by a factor of 4 to 30.
constexpr std::uint64_t kLargestRatio = 200, kSmallestBound = std::uint64_t{1} << 26;

std::string in_lower_case(std::string_view text) {
    std::string result(text);
    std::transform(result.begin(), result.end(), result.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return result;
}

std::string inflated(std::string_view packed, std::uint32_t size) {
    std::string content(size, '\0');
    z_stream stream{};
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data())); // NOLINT: zlib
    stream.avail_in = static_cast<uInt>(packed.size());
    stream.next_out = reinterpret_cast<Bytef*>(content.data());
    stream.avail_out = size;
    if (inflateInit2(&stream, -MAX_WBITS) != Z_OK)
        throw std::bad_alloc();
    const int end = inflate(&stream, Z_FINISH);
    inflateEnd(&stream);
    if (end != Z_STREAM_END || stream.total_out != size)
        malformed("has a damaged entry");
    return content;
}

} // namespace

ZipArchive::ZipArchive(const std::string& path) : bytes_(read_file(path)) {
    const std::size_t end = bytes_.rfind("PK\x05\x06");
    if (end == std::string::npos || end + kEndBytes > bytes_.size())
        malformed("is not a ZIP archive, or is truncated");
    const std::uint32_t count = number(end + 10, 2), start = number(end + 16, 4);
    if (count == 0xffff || start == std::numeric_limits<std::uint32_t>::max())
        throw Fault(ErrorCode::unsupported, "is a ZIP64 archive");
    std::uint64_t promised = 0;
    for (std::uint64_t i = 0, at = start; i < count; ++i) {
        if (number(at, 4) != kRecordMark)
            malformed("has a damaged directory");
        const std::uint32_t name = number(at + 28, 2);
        if (at + kRecordBytes + name > bytes_.size())
            malformed("has a damaged directory");
        Entry entry;
        entry.name = in_lower_case(std::string_view(bytes_).substr(at + kRecordBytes, name));
        entry.method = static_cast<std::uint16_t>(number(at + 10, 2));
        entry.packed = number(at + 20, 4);
        entry.size = number(at + 24, 4);
        entry.at = number(at + 42, 4);
        promised += entry.size;
        at += kRecordBytes + name + number(at + 30, 2) + number(at + 32, 2);
        entries_.push_back(std::move(entry));
    }
    if (promised > std::max(kSmallestBound, kLargestRatio * bytes_.size()))
        malformed("claims " + std::to_string(promised) + " bytes from " +
                  std::to_string(bytes_.size()) + ", more than a model can be compressed");
}

std::uint32_t ZipArchive::number(std::uint64_t at, std::size_t bytes) const {
    if (at + bytes > bytes_.size())
        malformed("is truncated");
    std::uint32_t value = 0;
    for (std::size_t i = bytes; i-- > 0;)
        value = value << 8 | static_cast<unsigned char>(bytes_[at + i]);
    return value;
}

std::string ZipArchive::content(std::string_view name) const {
    const std::string asked = in_lower_case(name);
    const auto entry = std::find_if(entries_.begin(), entries_.end(),
                                    [&](const Entry& e) { return e.name == asked; });
    if (entry == entries_.end())
        malformed("lacks the entry " + std::string(name.substr(0, 100)));
    if (number(entry->at, 4) != kLocalMark)
        malformed("has a damaged directory");
    const std::uint64_t from = std::uint64_t{entry->at} + kLocalBytes +
                               number(entry->at + std::uint64_t{26}, 2) +
                               number(entry->at + std::uint64_t{28}, 2);
    if (from + entry->packed > bytes_.size())
        malformed("is truncated");
    const std::string_view packed = std::string_view(bytes_).substr(from, entry->packed);
    if (entry->method == kDeflated)
        return inflated(packed, entry->size);
    if (entry->method != kStored || entry->packed != entry->size)
        throw Fault(ErrorCode::unsupported, "has an entry with an unsupported compression");
    return std::string(packed);
}

} // namespace abut
