#include "io/process/decode_scene.h"

#include <abut/error.h>

#include "io/process/decode_knowledge.h"
#include "io/process/scene_stream.h"
#include "io/process/stream_cursor.h"
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

template <typename Real>
void decode_positions(std::span<const std::byte> bytes, std::vector<Vec3>& positions) {
    for (std::size_t i = 0; i < positions.size(); ++i) {
        Real xyz[3];
        std::memcpy(xyz, bytes.data() + i * sizeof xyz, sizeof xyz);
        positions[i] = {xyz[0], xyz[1], xyz[2]};
    }
}

Mesh decode_mesh(StreamCursor& cursor, std::uint64_t number, MeshFaults& faults) {
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

Part decode_part(StreamCursor& cursor, std::size_t meshes) {
    Part part;
    part.world_from_mesh = Transform(cursor.value<std::array<double, 12>>());
    part.mesh = cursor.value<std::uint32_t>();
    if (part.mesh >= meshes)
        cursor.fail();
    const auto id_size = cursor.value<std::uint32_t>();
    const auto name_size = cursor.value<std::uint32_t>();
    const auto type_size = cursor.value<std::uint32_t>();
    const auto has_colour = cursor.value<std::uint32_t>();
    const auto colour = cursor.value<Colour>();
    if (has_colour > 1)
        cursor.fail();
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

SceneNote decode_note(StreamCursor& cursor) {
    const auto kind = cursor.value<std::uint32_t>();
    if (kind > static_cast<std::uint32_t>(NoteKind::open))
        cursor.fail();
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

FormatFrame format_frame(const StreamCursor& cursor, const scene_stream::Header& header) {
    const auto is_good = [](double unit) { return std::isfinite(unit) && unit > 0; };
    if (header.up > 1 + static_cast<std::uint32_t>(UpAxis::z) || !is_good(header.applied) ||
        (header.unit != 0 && !is_good(header.unit)))
        cursor.fail();
    FormatFrame format{header.unit, std::nullopt};
    if (header.up > 0)
        format.up = static_cast<UpAxis>(header.up - 1);
    return format;
}

void throw_sent_error(StreamCursor& cursor, const scene_stream::Header& header,
                      const std::string& file) {
    const std::uint32_t code = header.status - 1;
    if (code < static_cast<std::uint32_t>(ErrorCode::file_not_found) ||
        code > static_cast<std::uint32_t>(ErrorCode::reader_failed))
        cursor.fail();
    throw Error(static_cast<ErrorCode>(code), file, one_line(cursor.text(header.text_size)));
}

} // namespace

Scene decode_scene(std::span<const std::byte> stream, const ModelPath& path,
                   const ReadOptions& options) {
    const std::string& file = path.path;
    if (stream.empty())
        throw Error(ErrorCode::reader_failed, file, "its reader returned no result");
    StreamCursor cursor(stream, file);
    const auto header = cursor.value<scene_stream::Header>();
    if (std::memcmp(header.magic, scene_stream::kMagic, sizeof header.magic) != 0)
        cursor.fail();
    if (header.status != 0)
        throw_sent_error(cursor, header, file);
    if (header.meshes > cursor.left() / kMeshHeaderBytes ||
        header.parts > cursor.left() / kPartHeaderBytes ||
        header.notes > cursor.left() / kNoteHeaderBytes)
        cursor.fail();
    const FormatFrame format = format_frame(cursor, header);
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
        scene.parts.push_back(decode_part(cursor, scene.meshes.size()));
    for (std::uint32_t i = 0; i < header.notes; ++i)
        scene.notes.push_back(decode_note(cursor));
    decode_knowledge(cursor, scene);
    if (std::memcmp(cursor.take(sizeof scene_stream::kEnd).data(), scene_stream::kEnd,
                    sizeof scene_stream::kEnd) != 0 ||
        cursor.left() != 0)
        cursor.fail();
    make_ids_unique(scene.parts);

    for (Part& part : scene.parts)
        scale(part.world_from_mesh, factor);
    scene.precision.stated *= factor;
    // The map's offset is in metres of the project; a unit that was given instead changes both.
    for (std::size_t i = 9; i < 12; ++i)
        scene.map_from_project.m[i] *= factor;
    check_scene(scene, faults);
    if (!faults.empty())
        cursor.fail(); // a mesh that no part uses
    return scene;
}

} // namespace abut
