#include "io/reader/decode.h"

#include "io/process/decode_request.h"

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <draco/compression/decode.h>
#include <memory>
#include <meshoptimizer.h>
#include <span>
#include <stdexcept>
#include <unistd.h>
#include <vector>

namespace abut {

namespace {

using decode_request::Filter;
using decode_request::Job;
using decode_request::Kind;
using decode_request::RequestHeader;

class File {
public:
    explicit File(int descriptor) : descriptor_(descriptor) {}

    void read(std::uint64_t at, std::span<std::byte> bytes) const { transfer(at, bytes, pread); }
    void write(std::uint64_t at, std::span<const std::byte> bytes) const {
        transfer(at, bytes, pwrite);
    }

private:
    template <typename Byte, typename Call>
    void transfer(std::uint64_t at, std::span<Byte> bytes, const Call& call) const {
        while (!bytes.empty()) {
            const ssize_t count =
                call(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(at));
            if (count < 0 && errno == EINTR)
                continue;
            if (count <= 0)
                throw std::runtime_error("the file of requests cannot be read or written");
            at += static_cast<std::uint64_t>(count);
            bytes = bytes.subspan(static_cast<std::size_t>(count));
        }
    }

    int descriptor_;
};

/// Uninitialised bytes: a count that a file states touches no memory before it is checked.
class Bytes {
public:
    explicit Bytes(std::uint64_t size)
        : bytes_(std::make_unique_for_overwrite<std::byte[]>(size)), size_(size) {}
    [[nodiscard]] std::byte* data() const { return bytes_.get(); }
    [[nodiscard]] std::span<std::byte> span() const { return {bytes_.get(), size_}; }

private:
    std::unique_ptr<std::byte[]> bytes_; // NOLINT: without initialisation
    std::uint64_t size_;
};

bool decode_meshopt(const Job& job, std::span<const std::byte> input, const File& file) {
    const Bytes output(job.count * job.stride);
    const auto* const from = reinterpret_cast<const unsigned char*>(input.data());
    int fault = 0;
    if (job.kind == Kind::meshopt_attributes)
        fault =
            meshopt_decodeVertexBuffer(output.data(), job.count, job.stride, from, input.size());
    else if (job.kind == Kind::meshopt_triangles)
        fault = meshopt_decodeIndexBuffer(output.data(), job.count, job.stride, from, input.size());
    else
        fault =
            meshopt_decodeIndexSequence(output.data(), job.count, job.stride, from, input.size());
    if (fault != 0)
        return false;
    if (job.filter == Filter::octahedral)
        meshopt_decodeFilterOct(output.data(), job.count, job.stride);
    else if (job.filter == Filter::quaternion)
        meshopt_decodeFilterQuat(output.data(), job.count, job.stride);
    else if (job.filter == Filter::exponential)
        meshopt_decodeFilterExp(output.data(), job.count, job.stride);
    file.write(job.output, output.span());
    return true;
}

template <typename Component>
bool write_positions(const draco::Mesh& mesh, const draco::PointAttribute& attribute,
                     const Job& job, const File& file) {
    std::vector<std::array<Component, 3>> piece;
    constexpr std::uint64_t kPiece = 16384;
    for (std::uint64_t first = 0; first < job.count; first += kPiece) {
        piece.resize(std::min(kPiece, job.count - first));
        for (std::size_t i = 0; i < piece.size(); ++i) {
            const draco::PointIndex point(static_cast<std::uint32_t>(first + i));
            const draco::AttributeValueIndex value = attribute.mapped_index(point);
            if (value.value() >= attribute.size() ||
                !attribute.ConvertValue<Component, 3>(value, piece[i].data()))
                return false;
        }
        file.write(job.output + first * sizeof piece[0], std::as_bytes(std::span(piece)));
    }
    return mesh.num_points() == job.count;
}

bool write_positions_of_type(const draco::Mesh& mesh, const draco::PointAttribute& attribute,
                             const Job& job, const File& file) {
    switch (job.component) { // as glTF numbers them
    case 5120:
        return write_positions<std::int8_t>(mesh, attribute, job, file);
    case 5121:
        return write_positions<std::uint8_t>(mesh, attribute, job, file);
    case 5122:
        return write_positions<std::int16_t>(mesh, attribute, job, file);
    case 5123:
        return write_positions<std::uint16_t>(mesh, attribute, job, file);
    case 5126:
        return write_positions<float>(mesh, attribute, job, file);
    default:
        return false;
    }
}

bool decode_draco(const Job& job, std::span<const std::byte> input, const File& file) {
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(input.data()), input.size());
    draco::Decoder decoder;
    const auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
    if (!decoded.ok())
        return false;
    const draco::Mesh& mesh = *decoded.value();
    const draco::PointAttribute* const attribute = mesh.GetAttributeByUniqueId(job.attribute);
    if (attribute == nullptr || attribute->num_components() != 3 ||
        mesh.num_points() != job.count || std::uint64_t{mesh.num_faces()} * 3 != job.corners)
        return false;
    std::vector<std::array<std::uint32_t, 3>> faces(mesh.num_faces());
    for (std::size_t i = 0; i < faces.size(); ++i) {
        const auto& face = mesh.face(draco::FaceIndex(static_cast<std::uint32_t>(i)));
        faces[i] = {face[0].value(), face[1].value(), face[2].value()};
    }
    file.write(job.corners_output, std::as_bytes(std::span(faces)));
    return write_positions_of_type(mesh, *attribute, job, file);
}

} // namespace

void decode_geometry(int descriptor) {
    const File file(descriptor);
    RequestHeader header{};
    file.read(0, std::as_writable_bytes(std::span(&header, 1)));
    if (std::memcmp(header.magic, decode_request::kMagic, sizeof header.magic) != 0)
        throw std::runtime_error("is not a file of requests");
    std::vector<Job> jobs(header.jobs);
    file.read(sizeof header, std::as_writable_bytes(std::span(jobs)));
    for (const Job& job : jobs) {
        const Bytes input(job.input_bytes);
        file.read(job.input, input.span());
        if (!(job.kind == Kind::draco ? decode_draco : decode_meshopt)(job, input.span(), file))
            break;
        ++header.done;
    }
    file.write(0, std::as_bytes(std::span(&header, 1)));
}

} // namespace abut
