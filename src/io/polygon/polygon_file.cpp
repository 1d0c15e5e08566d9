#include "io/polygon/polygon_file.h"

#include "io/file/fault.h"
#include "io/file/input_file.h"
#include "io/polygon/obj_colours.h"
#include "io/polygon/obj_scan.h"
#include "io/polygon/off_scan.h"
#include "io/polygon/ply_body.h"
#include "io/polygon/ply_scan.h"
#include "io/polygon/polygon_scene.h"
#include "io/polygon/stl_scan.h"

#include <array>

namespace abut {

namespace {

/// Returns the id of a part without a name: its number in the node tree of other formats, where the
/// root is node 0.
std::string node(std::uint64_t number) {
    return "node " + std::to_string(number);
}

Scene read_obj(ByteStream& content, PolygonScene& scene, ObjColours colours) {
    ObjParts parts;
    std::size_t added = 0;
    scan_obj(
        content, [&](const Vec3& position) { scene.vertex(position); },
        [&](auto corners) {
            const std::size_t part = parts.of_face();
            for (; added <= part; ++added)
                (void)scene.add_part(parts.ids()[added]);
            scene.face(part, corners);
            colours.add(part, corners.size() - 2);
        },
        [&](std::string_view statement, std::string_view name) {
            colours.statement(statement, name);
            parts.name(statement, name);
        });
    Scene result = scene.finish(PolygonScene::Vertices::used);
    for (std::size_t i = 0; i < result.parts.size(); ++i)
        result.parts[i].colour = colours.of_part(i); // every part has a face
    return result;
}

Scene read_off(ByteStream& content, PolygonScene& scene) {
    const std::size_t part = scene.add_part(node(0));
    scan_off(
        content, [&](const Vec3& position) { scene.vertex(position); },
        [&](auto corners) { scene.face(part, corners); });
    return scene.finish(PolygonScene::Vertices::all);
}

Scene read_ply(ByteStream& content, PolygonScene& scene) {
    const std::size_t part = scene.add_part(node(0));
    scan_ply(
        content, [&](const Vec3& position) { scene.vertex(position); },
        [&](auto corners) { scene.face(part, corners); });
    return scene.finish(PolygonScene::Vertices::all);
}

Scene read_text_stl(ByteStream& content, PolygonScene& scene) {
    std::size_t part = 0;
    std::uint64_t solids = 0;
    scan_text_stl(
        content,
        [&](std::string_view name) {
            ++solids;
            part = scene.add_part(name.empty() ? node(solids) : std::string(name));
        },
        [&](const Vec3& position) {
            scene.vertex(position);
            const std::uint64_t count = scene.vertices();
            if (count % 3 == 0)
                scene.face(part, std::array{count - 3, count - 2, count - 1});
        });
    return scene.finish(PolygonScene::Vertices::used);
}

} // namespace

std::optional<Scene> read_polygon_file(const std::string& path, bool allow_outside,
                                       const std::shared_ptr<const ReadWatch>& watch) {
    const std::string extension = lower_extension(path);
    const bool is_obj = extension == ".obj";
    const bool is_stl = extension == ".stl";
    const auto read = extension == ".off"   ? read_off
                      : extension == ".ply" ? read_ply
                      : is_stl              ? read_text_stl
                                            : nullptr;
    if ((read == nullptr && !is_obj) || (is_stl && !is_text_stl(path)))
        return std::nullopt;
    ByteStream content = ByteStream::open(path, watch);
    PolygonScene scene(*watch);
    return is_obj ? read_obj(content, scene, ObjColours(path, allow_outside, watch))
                  : read(content, scene);
}

} // namespace abut
