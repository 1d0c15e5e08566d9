#include "made_building.h"

#include <cmath>
#include <fmt/format.h>

namespace {

using abut::Mesh;
using abut::Part;
using abut::Scene;
using abut::Transform;

/// A closed prism about the z axis, one metre high and one metre wide.
Mesh make_prism(std::uint32_t sides) {
    Mesh mesh;
    for (std::uint32_t k = 0; k < sides; ++k) {
        const double angle = 2 * 3.14159265358979 * (k + 0.5) / sides;
        for (const double z : {0.0, 1.0})
            mesh.positions.push_back({0.5 * std::cos(angle), 0.5 * std::sin(angle), z});
    }
    mesh.positions.push_back({0, 0, 0});
    mesh.positions.push_back({0, 0, 1});
    for (std::uint32_t k = 0; k < sides; ++k) {
        const std::uint32_t a = 2 * k, b = 2 * ((k + 1) % sides);
        mesh.triangles.push_back({a, b, b + 1});
        mesh.triangles.push_back({a, b + 1, a + 1});
        mesh.triangles.push_back({2 * sides, b, a});
        mesh.triangles.push_back({2 * sides + 1, a + 1, b + 1});
    }
    return mesh;
}

Part make_part(std::string id, std::string name, std::string type, abut::Vec3 size,
               abut::Vec3 place) {
    Part part;
    part.id = std::move(id);
    part.name = std::move(name);
    part.type = std::move(type);
    part.world_from_mesh =
        Transform({size.x, 0, 0, 0, size.y, 0, 0, 0, size.z, place.x, place.y, place.z});
    return part;
}

} // namespace

MadeBuilding::MadeBuilding(std::size_t wanted, const std::vector<std::string>& names) {
    const auto across = static_cast<std::size_t>(
        std::ceil(std::sqrt(static_cast<double>(wanted) / static_cast<double>(kSlabs))));
    const double width = 2.0 * static_cast<double>(across + 1);
    Scene slabs, pipes;
    slabs.file = "models/slabs.ifc";
    pipes.file = "models/pipes.ifc";
    slabs.up = pipes.up = abut::UpAxis::z;
    slabs.meshes = {make_prism(4)};
    pipes.meshes = {make_prism(16)};
    for (std::size_t s = 0; s < kSlabs; ++s)
        slabs.parts.push_back(make_part(fmt::format("slab-{}", s), fmt::format("Floor {}", s),
                                        "IfcSlab", {1.5 * width, 1.5 * width, 0.3},
                                        {0, 0, kStorey * static_cast<double>(s)}));
    for (std::size_t p = 0; p < across * across; ++p) {
        const double x = 2.0 * static_cast<double>(p % across + 1) - width / 2,
                     y = 2.0 * static_cast<double>(p / across + 1) - width / 2;
        pipes.parts.push_back(make_part(
            fmt::format("pipe-{}", p), p < names.size() ? names[p] : fmt::format("Pipe {}", p),
            "IfcPipeSegment", {0.2, 0.2, kStorey * kSlabs}, {x, y, -1}));
    }
    clashes = pipes.parts.size() * kSlabs;
    models = {std::move(slabs), std::move(pipes)};
}
