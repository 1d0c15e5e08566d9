#include "io/process/decode_scene.h"

#include <abut/error.h>

#include "io/process/scene_stream.h"
#include "io/scene/model_frame.h"
#include "io/scene/part_checks.h"

#include <array>
#include <cmath>
#include <cstring>

namespace abut {

namespace {

constexpr std::uint32_t kTriangleBytes = 12;
constexpr std::uint32_t kMeshHeaderBytes = 12;
constexpr std::uint32_t kPartHeaderBytes = 120;
constexpr std::uint32_t kNoteHeaderBytes = 20;
static_assert(sizeof(Colour) == 4);

[[noreturn]] void not_sound(const std::string& file) {
    throw Error(ErrorCode::reader_failed, file, "its reader returned a damaged result");
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

template <typename Real>
void decode_positions(std::span<const std::byte> bytes, std::vector<Vec3>& positions) {
    for (std::size_t i = 0; i < positions.size(); ++i) {
        Real xyz[3];
        std::memcpy(xyz, bytes.data() + i * sizeof xyz, sizeof xyz);
        positions[i] = {xyz[0], xyz[1], xyz[2]};
    }
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
    if (real_bytes == sizeof(float))
        decode_positions<float>(positions, mesh.positions);
    else
        decode_positions<double>(positions, mesh.positions);
    find_bad_coordinate(mesh, number, faults);

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
    const auto has_colour = cursor.value<std::uint32_t>();
    const auto colour = cursor.value<Colour>();
    if (has_colour > 1)
        not_sound(file);
    if (has_colour == 1)
        part.colour = colour;
    part.id = cursor.text(id_size);
    part.name = cursor.text(name_size);
    part.type = cursor.text(type_size);
    return part;
}

/// Puts a reader's text on one line.
std::string one_line(std::string text) {
    for (char& c : text)
        if (static_cast<unsigned char>(c) < ' ')
            c = ' ';
    return text;
}

SceneNote decode_note(Cursor& cursor, const std::string& file) {
    const auto kind = cursor.value<std::uint32_t>();
    if (kind > static_cast<std::uint32_t>(NoteKind::open))
        not_sound(file);
    const auto sizes = cursor.value<std::array<std::uint32_t, 4>>();
    SceneNote note;
    note.kind = static_cast<NoteKind>(kind);
    note.id = cursor.text(sizes[0]);
    note.name = cursor.text(sizes[1]);
    note.type = cursor.text(sizes[2]);
    note.text = one_line(cursor.text(sizes[3]));
    if (note.name.empty())
        note.name = note.id;
    return note;
}

FormatFrame format_frame(const scene_stream::Header& header, const std::string& file) {
    const auto is_good = [](double unit) { return std::isfinite(unit) && unit > 0; };
    if (header.up > 1 + static_cast<std::uint32_t>(UpAxis::z) || !is_good(header.applied) ||
        (header.unit != 0 && !is_good(header.unit)))
        not_sound(file);
    FormatFrame format{header.unit, std::nullopt};
    if (header.up > 0)
        format.up = static_cast<UpAxis>(header.up - 1);
    return format;
}

void throw_sent_error(Cursor& cursor, const scene_stream::Header& header, const std::string& file) {
    const std::uint32_t code = header.status - 1;
    if (code < static_cast<std::uint32_t>(ErrorCode::file_not_found) ||
        code > static_cast<std::uint32_t>(ErrorCode::reader_failed))
        not_sound(file);
    throw Error(static_cast<ErrorCode>(code), file, one_line(cursor.text(header.text_size)));
}

} // namespace

Scene decode_scene(std::span<const std::byte> stream, const ModelPath& path,
                   const ReadOptions& options) {
    const std::string& file = path.path;
    if (stream.empty())
        throw Error(ErrorCode::reader_failed, file, "its reader returned no result");
    Cursor cursor(stream, file);
    const auto header = cursor.value<scene_stream::Header>();
    if (std::memcmp(header.magic, scene_stream::kMagic, sizeof header.magic) != 0)
        not_sound(file);
    if (header.status != 0)
        throw_sent_error(cursor, header, file);
    if (header.meshes > cursor.left() / kMeshHeaderBytes ||
        header.parts > cursor.left() / kPartHeaderBytes ||
        header.notes > cursor.left() / kNoteHeaderBytes)
        not_sound(file);
    const FormatFrame format = format_frame(header, file);
    const ModelFrame frame = model_frame(format, path, options);
    const double factor = scale_of(format, header.applied, frame);

    Scene scene;
    scene.file = file;
    scene.unit = frame.unit;
    scene.up = frame.up;
    MeshFaults faults;
    scene.meshes.reserve(header.meshes);
    for (std::uint64_t i = 0; i < header.meshes; ++i)
        scene.meshes.push_back(decode_mesh(cursor, i, faults));
    scene.parts.reserve(header.parts);
    for (std::uint64_t i = 0; i < header.parts; ++i)
        scene.parts.push_back(decode_part(cursor, scene.meshes.size(), file));
    for (std::uint32_t i = 0; i < header.notes; ++i)
        scene.notes.push_back(decode_note(cursor, file));
    if (std::memcmp(cursor.take(sizeof scene_stream::kEnd).data(), scene_stream::kEnd,
                    sizeof scene_stream::kEnd) != 0 ||
        cursor.left() != 0)
        not_sound(file);
    make_ids_unique(scene.parts);

    for (Part& part : scene.parts)
        scale(part.world_from_mesh, factor);
    check_scene(scene, faults);
    if (!faults.empty())
        not_sound(file); // a mesh that no part uses
    return scene;
}

} // namespace abut
