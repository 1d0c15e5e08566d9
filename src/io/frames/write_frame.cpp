#include <abut/error.h>
#include <abut/frame.h>

#include "core/atomic_file.h"
#include "io/file/input_file.h"
#include "io/frames/frame_formats.h"
#include "math/rounding.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

namespace abut {

namespace {

static_assert(std::endian::native == std::endian::little, "values are written as they lie");

template <typename Value>
void append_value(std::string& bytes, const Value& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

bool is_float(double value) {
    return static_cast<double>(to_float(value)) == value;
}

std::string header_of(const Mesh& mesh, const std::string& real) {
    std::string header = "ply\nformat binary_little_endian 1.0\nelement vertex " +
                         std::to_string(mesh.positions.size()) + "\n";
    for (const char axis : {'x', 'y', 'z'})
        header += "property " + real + " " + axis + "\n";
    return header + "element face " + std::to_string(mesh.triangles.size()) +
           "\nproperty list uchar uint vertex_indices\nend_header\n";
}

template <typename Real>
void append_positions(std::string& bytes, const Mesh& mesh) {
    for (const Vec3& p : mesh.positions)
        append_value(bytes, std::array{static_cast<Real>(p.x), static_cast<Real>(p.y),
                                       static_cast<Real>(p.z)});
}

} // namespace

void write_frame(const Mesh& mesh, const std::string& path) {
    if (lower_extension(path) != ".ply")
        throw Error(ErrorCode::unsupported, path, "frames are written to .ply files only");
    require_frame(mesh, path);
    const bool all_floats =
        std::all_of(mesh.positions.begin(), mesh.positions.end(),
                    [](const Vec3& p) { return is_float(p.x) && is_float(p.y) && is_float(p.z); });
    std::string bytes = header_of(mesh, all_floats ? "float" : "double");
    bytes.reserve(bytes.size() +
                  mesh.positions.size() * 3 * (all_floats ? sizeof(float) : sizeof(double)) +
                  mesh.triangles.size() * (1 + sizeof mesh.triangles[0]));
    if (all_floats)
        append_positions<float>(bytes, mesh);
    else
        append_positions<double>(bytes, mesh);
    for (const auto& corners : mesh.triangles) {
        bytes += '\3';
        append_value(bytes, corners);
    }
    write_file_atomically(path, bytes);
}

} // namespace abut
