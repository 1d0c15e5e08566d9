#include "io/scene/collect_scene.h"

#include <abut/error.h>

#include "core/large_pages.h"
#include "io/file/read_watch.h"
#include "io/scene/part_checks.h"
#include "mesh/equal_positions.h"

#include <algorithm>
#include <span>

namespace abut {

namespace {

class Collector : public MeshSink {
public:
    Collector(Mesh& mesh, const SceneSource::Size& size) : mesh_(mesh) {
        reserve_in_large_pages(mesh.positions, size.vertices);
        reserve_in_large_pages(mesh.triangles, size.triangles);
    }
    void vertices(std::span<const Vec3> positions) override {
        mesh_.positions.insert(mesh_.positions.end(), positions.begin(), positions.end());
    }
    void triangles(std::span<const std::array<std::uint32_t, 3>> indices) override {
        mesh_.triangles.insert(mesh_.triangles.end(), indices.begin(), indices.end());
    }

private:
    Mesh& mesh_;
};

std::uint64_t bytes_of(const SceneSource::Size& size) {
    return size.vertices * sizeof(Vec3) + size.triangles * sizeof(std::array<std::uint32_t, 3>);
}

/// Bytes of all meshes, and of the tables that join the vertices of the largest mesh.
std::uint64_t bytes_in_memory(const SceneSource& source) {
    constexpr std::uint64_t kTableBytes = 20; // a vertex, at most
    std::uint64_t bytes = 0, largest = 0;
    for (std::uint32_t i = 0; i < source.meshes(); ++i) {
        bytes += bytes_of(source.size(i));
        largest = std::max(largest, source.size(i).vertices * kTableBytes);
    }
    return bytes + largest;
}

} // namespace

void join_vertices(Mesh& mesh) {
    const std::size_t vertices = mesh.positions.size();
    const std::vector<std::uint32_t> number_of = join_equal_positions(mesh.positions);
    if (mesh.positions.size() == vertices)
        return;
    mesh.positions.shrink_to_fit();
    for (auto& triangle : mesh.triangles)
        for (std::uint32_t& corner : triangle)
            corner = number_of[corner];
}

Mesh collect_mesh(const SceneSource& source, std::uint32_t number) {
    Mesh mesh;
    Collector collector(mesh, source.size(number));
    source.read(number, collector);
    for (const auto& triangle : mesh.triangles)
        for (const std::uint32_t corner : triangle)
            if (corner >= mesh.positions.size())
                throw Fault(ErrorCode::bad_mesh,
                            "a triangle refers to a vertex that does not exist");
    join_vertices(mesh);
    return mesh;
}

Scene collect_scene(const SceneSource& source, const std::string& file, const ReadWatch& watch) {
    watch.require_memory(bytes_in_memory(source));
    Scene scene;
    scene.file = file;
    scene.unit = source.frame().unit;
    scene.up = source.frame().up;
    scene.notes = source.notes();
    scene.meshes.reserve(source.meshes());
    MeshFaults faults;
    for (std::uint32_t i = 0; i < source.meshes(); ++i) {
        try {
            scene.meshes.push_back(collect_mesh(source, i));
            find_bad_coordinate(scene.meshes.back(), i, faults);
        } catch (const Fault& fault) {
            if (fault.code() != ErrorCode::bad_mesh)
                throw;
            scene.meshes.emplace_back();
            faults.emplace(i, fault.what());
        }
    }
    PartSpool::Cursor cursor(source.parts());
    scene.parts.reserve(source.parts().size());
    SceneSource::PropertyCursor property_cursor(source);
    PropertiesBuilder properties;
    for (std::uint64_t i = 0; i < source.parts().size(); ++i) {
        scene.parts.push_back(cursor.part(i));
        for (const auto& [name, value] : property_cursor.of(i))
            properties.add(name, value);
        properties.next_part();
    }
    scene.properties = properties.finish(scene.parts.size());
    scene.relations = source.facts().relations;
    scene.project = source.facts().project;
    scene.map_from_project = source.facts().map_from_project;
    scene.precision = source.facts().precision;
    check_scene(scene, faults);
    return scene;
}

} // namespace abut
