#include "io/decode_scene.h"

#include <abut/error.h>

#include "io/part_checks.h"
#include "io/scene_stream.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <unordered_map>
#include <unordered_set>

namespace abut {

namespace {

constexpr std::uint32_t kTriangleBytes = 12;
constexpr std::uint32_t kMeshHeaderBytes = 12;
constexpr std::uint32_t kPartHeaderBytes = 112;

[[noreturn]] void not_sound(const std::string& file) {
    throw Error(ErrorCode::reader_failed, file, "its reader gave a damaged result");
}

class Cursor {
public:
    Cursor(std::span<const std::byte> rest, const std::string& file) : rest_(rest), file_(file) {}

    std::span<const std::byte> take(std::uint64_t size) {
        if (size > rest_.size())
            not_sound(file_);
        const auto taken = rest_.first(size);
        rest_ = rest_.subspan(size);
        return taken;
    }
    template <typename Value>
    Value value() {
        Value result{};
        std::memcpy(&result, take(sizeof(Value)).data(), sizeof(Value));
        return result;
    }
    std::string text(std::uint32_t size) {
        const auto bytes = take(size);
        return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
    }
    [[noreturn]] void fail() const { not_sound(file_); }
    [[nodiscard]] std::size_t left() const noexcept { return rest_.size(); }

private:
    std::span<const std::byte> rest_;
    const std::string& file_;
};

/// What is wrong with a mesh, by its number; reported with the name of the first part that uses it.
using MeshFaults = std::unordered_map<std::uint64_t, std::string>;

/// Positions of a mesh, and the first one that is not finite (or would not be a finite float).
template <typename Real>
std::uint64_t decode_positions(std::span<const std::byte> bytes, std::vector<Vec3>& positions) {
    constexpr double kLargest = std::numeric_limits<float>::max();
    const auto in_range = [](double value) { return std::fabs(value) <= kLargest; };
    std::uint64_t first_bad = positions.size();
    for (std::size_t i = positions.size(); i-- > 0;) {
        Real xyz[3];
        std::memcpy(xyz, bytes.data() + i * sizeof xyz, sizeof xyz);
        positions[i] = {xyz[0], xyz[1], xyz[2]};
        if (!(in_range(xyz[0]) && in_range(xyz[1]) && in_range(xyz[2])))
            first_bad = i;
    }
    return first_bad;
}

Mesh decode_mesh(Cursor& cursor, std::uint64_t number, MeshFaults& faults) {
    const auto vertices = cursor.value<std::uint32_t>();
    const auto triangles = cursor.value<std::uint32_t>();
    const auto real_bytes = cursor.value<std::uint32_t>();
    if (real_bytes != sizeof(float) && real_bytes != sizeof(double))
        cursor.fail();
    const auto positions = cursor.take(std::uint64_t{vertices} * 3 * real_bytes);
    const auto indices = cursor.take(std::uint64_t{triangles} * kTriangleBytes);

    Mesh mesh;
    mesh.positions.resize(vertices);
    const std::uint64_t bad = real_bytes == sizeof(float)
                                  ? decode_positions<float>(positions, mesh.positions)
                                  : decode_positions<double>(positions, mesh.positions);
    if (bad != vertices)
        faults.emplace(number, "vertex " + std::to_string(bad) +
                                   " has a coordinate that is not a finite number");

    mesh.triangles.resize(triangles);
    if (triangles > 0)
        std::memcpy(mesh.triangles.data(), indices.data(), indices.size());
    for (std::uint32_t i = 0; i < triangles; ++i) {
        const auto& [a, b, c] = mesh.triangles[i];
        if (a >= vertices || b >= vertices || c >= vertices) {
            faults.emplace(number, "triangle " + std::to_string(i) +
                                       " refers to a vertex that does not exist");
            break;
        }
    }
    return mesh;
}

Part decode_part(Cursor& cursor, std::size_t meshes, const std::string& file) {
    Part part;
    part.world_from_mesh = Transform(cursor.value<std::array<double, 12>>());
    part.mesh = cursor.value<std::uint32_t>();
    if (part.mesh >= meshes)
        not_sound(file);
    const auto id_size = cursor.value<std::uint32_t>();
    const auto name_size = cursor.value<std::uint32_t>();
    const auto type_size = cursor.value<std::uint32_t>();
    part.id = cursor.text(id_size);
    part.name = cursor.text(name_size);
    part.type = cursor.text(type_size);
    return part;
}

/// Whether one triangle at least, in world coordinates, is not exactly degenerate. In any usual
/// file the first one is.
bool any_triangle_has_area(const Scene& scene) {
    return std::any_of(scene.parts.begin(), scene.parts.end(), [&](const Part& part) {
        return has_area(scene.meshes[part.mesh], part.world_from_mesh);
    });
}

void make_ids_unique(std::vector<Part>& parts) {
    std::unordered_set<std::string> given;
    for (const Part& part : parts)
        given.insert(part.id);
    std::unordered_set<std::string> used;
    std::unordered_map<std::string, std::uint64_t> repeats;
    for (Part& part : parts) {
        if (!used.insert(part.id).second) {
            std::uint64_t& repeat = repeats.try_emplace(part.id, 1).first->second;
            std::string id;
            do
                id = part.id + "#" + std::to_string(++repeat);
            while (given.contains(id) || !used.insert(id).second);
            part.id = std::move(id);
        }
        if (part.name.empty())
            part.name = part.id;
    }
}

void throw_sent_error(Cursor& cursor, const scene_stream::Header& header, const std::string& file) {
    const std::uint32_t code = header.status - 1;
    if (code < static_cast<std::uint32_t>(ErrorCode::file_not_found) ||
        code > static_cast<std::uint32_t>(ErrorCode::reader_failed))
        not_sound(file);
    std::string text = cursor.text(header.text_size);
    for (char& c : text)
        if (static_cast<unsigned char>(c) < ' ')
            c = ' ';
    throw Error(static_cast<ErrorCode>(code), file, text);
}

} // namespace

Scene decode_scene(std::span<const std::byte> stream, const std::string& file, double unit) {
    if (stream.empty())
        throw Error(ErrorCode::reader_failed, file, "its reader gave no result");
    Cursor cursor(stream, file);
    const auto header = cursor.value<scene_stream::Header>();
    if (std::memcmp(header.magic, scene_stream::kMagic, sizeof header.magic) != 0)
        not_sound(file);
    if (header.status != 0)
        throw_sent_error(cursor, header, file);
    if (header.meshes > cursor.left() / kMeshHeaderBytes ||
        header.parts > cursor.left() / kPartHeaderBytes)
        not_sound(file);

    Scene scene;
    scene.file = file;
    MeshFaults faults;
    scene.meshes.reserve(header.meshes);
    for (std::uint64_t i = 0; i < header.meshes; ++i)
        scene.meshes.push_back(decode_mesh(cursor, i, faults));
    scene.parts.reserve(header.parts);
    for (std::uint64_t i = 0; i < header.parts; ++i)
        scene.parts.push_back(decode_part(cursor, scene.meshes.size(), file));
    if (std::memcmp(cursor.take(sizeof scene_stream::kEnd).data(), scene_stream::kEnd,
                    sizeof scene_stream::kEnd) != 0 ||
        cursor.left() != 0)
        not_sound(file);
    make_ids_unique(scene.parts);

    bool any_triangle = false;
    for (Part& part : scene.parts) {
        const auto fault = faults.find(part.mesh);
        if (fault != faults.end())
            throw Error(ErrorCode::bad_mesh, file, "part " + part.id + ": " + fault->second);
        any_triangle = any_triangle || !scene.meshes[part.mesh].triangles.empty();
        if (unit != 1)
            for (double& value : part.world_from_mesh.m)
                value *= unit;
        if (!stays_finite(part.world_from_mesh))
            throw Error(ErrorCode::bad_mesh, file,
                        "part " + part.id + ": its transform is not finite or too large");
    }
    if (!faults.empty())
        not_sound(file); // a mesh that no part uses
    if (!any_triangle)
        throw Error(ErrorCode::bad_mesh, file, "holds no triangles");
    if (!any_triangle_has_area(scene))
        throw Error(ErrorCode::bad_mesh, file, "holds only degenerate triangles");
    return scene;
}

} // namespace abut
