#include "arguments/impact_file.h"

#include <abut/error.h>

#include "arguments/common.h"
#include "arguments/elementary_arguments.h"
#include "arguments/interrupt.h"

#include <array>
#include <bit>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <string_view>
#include <sys/file.h>
#include <sys/stat.h>
#include <type_traits>
#include <unistd.h>
#include <utility>

namespace abut::command {

namespace {

constexpr std::size_t kFlushBytes = 1U << 16U;

constexpr std::string_view kCsvHeader = "step,kind,a,b,time,u,v,w,nx,ny,nz,status\n";

constexpr std::string_view kMagic = "ABUTCCD\n";
constexpr std::uint32_t kVersion = 1;
constexpr std::uint32_t kRecordBytes = 72;

void append_row(fmt::memory_buffer& out, std::size_t step, const FeatureImpact& impact) {
    const auto& [u, v, w] = impact.barycentric;
    fmt::format_to(fmt::appender(out),
                   "{},{},{},{},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{}\n", step,
                   to_string(impact.kind), impact.a, impact.b, impact.time, u, v, w,
                   impact.normal.x, impact.normal.y, impact.normal.z, to_string(impact.status));
}

/// Appends an integer with the least significant byte first.
template <typename Unsigned>
void append_word(fmt::memory_buffer& out, Unsigned value) {
    static_assert(std::is_unsigned_v<Unsigned>);
    for (std::size_t byte = 0; byte < sizeof value; ++byte)
        out.push_back(static_cast<char>(value >> (8 * byte)));
}

void append_real(fmt::memory_buffer& out, double value) {
    append_word(out, std::bit_cast<std::uint64_t>(value));
}

/// Appends a record with the following layout:
/// byte  0 step | 4 kind | 5 status | 6 zero | 8 a | 12 b | 16 time | 24 u v w | 48 normal | 72
void append_record(fmt::memory_buffer& out, std::size_t step, const FeatureImpact& impact) {
    append_word(out, static_cast<std::uint32_t>(step));
    append_word(out, static_cast<std::uint8_t>(impact.kind));
    append_word(out, static_cast<std::uint8_t>(impact.status));
    append_word(out, std::uint16_t{0});
    append_word(out, impact.a);
    append_word(out, impact.b);
    append_real(out, impact.time);
    for (const double weight : impact.barycentric)
        append_real(out, weight);
    for (const double x : {impact.normal.x, impact.normal.y, impact.normal.z})
        append_real(out, x);
}

[[noreturn]] void fail(const std::string& path) {
    throw Error(ErrorCode::cannot_write, path,
                std::string("cannot be written: ") + std::strerror(errno));
}

/// Opens a file for writing and empties it. If another process is writing it, throws and leaves its
/// content.
std::FILE* open_alone(const std::string& path) {
    const int descriptor = open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
    if (descriptor < 0)
        fail(path);
    // Devices and some network file systems have no locks: other errors of flock() are ignored.
    if (flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
        close(descriptor);
        throw Error(ErrorCode::cannot_write, path,
                    "cannot be written: it is in use by another process");
    }
    struct stat status {};
    const bool empties = fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode);
    if (empties && ftruncate(descriptor, 0) != 0)
        fail(path);
    std::FILE* const file = fdopen(descriptor, "wb");
    if (file == nullptr)
        fail(path);
    return file;
}

} // namespace

ImpactFile::ImpactFile(std::string path)
    : path_(std::move(path)), binary_(path_.ends_with(".bin")), file_(open_alone(path_)) {
    std::setvbuf(file_.get(), nullptr, _IONBF, 0); // so fclose() has nothing to write
    if (binary_) {
        buffer_.append(kMagic);
        append_word(buffer_, kVersion);
        append_word(buffer_, kRecordBytes);
    } else {
        buffer_.append(kCsvHeader);
    }
    const InterruptScope scope(OnInterrupt::defer);
    finish_step();
}

void ImpactFile::add(std::size_t step, std::span<const FeatureImpact> impacts) {
    const InterruptScope scope(OnInterrupt::defer);
    for (const FeatureImpact& impact : impacts) {
        (binary_ ? append_record : append_row)(buffer_, step, impact);
        if (buffer_.size() > kFlushBytes)
            write();
    }
    finish_step();
}

void ImpactFile::finish_step() {
    write();
    bytes_ = std::ftell(file_.get());
    throw_if_interrupted();
}

void ImpactFile::write() {
    if (std::fwrite(buffer_.data(), 1, buffer_.size(), file_.get()) != buffer_.size()) {
        const int fault = errno;
        // A device or a pipe cannot be truncated, and keeps what was written.
        static_cast<void>(ftruncate(fileno(file_.get()), bytes_));
        throw Error(ErrorCode::cannot_write, path_,
                    std::string("cannot be written: ") + std::strerror(fault));
    }
    buffer_.clear();
}

} // namespace abut::command
