#include "scenes/plant/plant_builder.h"

#include "scenes/plant/plant_colours.h"

#include <algorithm>

namespace abut::scenes {
namespace {

/// 22 characters of the alphabet of IFC's GlobalIds. The mixed index makes ids within a plant
/// distinct; the seed makes ids of two plants different.
std::string global_id(std::uint64_t seed, std::uint64_t index) {
    constexpr std::string_view kAlphabet =
        "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_$";
    std::uint64_t high = mix(seed ^ mix(index + 0x51ed270b)), low = mix(index + 1);
    std::string id(22, '0');
    for (std::size_t k = 22; k-- > 0;) {
        id[k] = kAlphabet[low & 63];
        low = low >> 6 | (high & 63) << 58;
        high >>= 6;
    }
    return id;
}

} // namespace

PlantBuilder::PlantBuilder(const PlantOptions& plant_options, int plant_sides)
    : options(plant_options), gap(on_grid_above(plant_options.clearance + 10 * kGrid)),
      sides(plant_sides), random(mix(plant_options.seed + 1)), space_(gap) {}

bool PlantBuilder::free(ShapeId id, const Transform& pose, std::uint32_t except) const {
    return std::ranges::all_of(shapes_[id].cover, [&](const Box3& cover) {
        return space_.free(moved(pose, cover), except);
    });
}

bool PlantBuilder::place(ShapeId id, const Transform& pose, std::string_view type,
                         std::string name) {
    if (!free(id, pose)) {
        return false;
    }
    plant(id, pose, type, std::move(name));
    return true;
}

std::uint32_t PlantBuilder::plant(ShapeId id, const Transform& pose, std::string_view type,
                                  std::string name) {
    const auto index = static_cast<std::uint32_t>(parts_.size());
    for (const Box3& cover : shapes_[id].cover) {
        space_.reserve(moved(pose, cover), index);
    }
    triangles_ += shapes_[id].mesh.triangles.size();
    const std::optional<Colour> colour = colour_of_plant_part(type, name);
    parts_.push_back({"", std::move(name), std::string(type), id, pose, colour});
    return index;
}

void PlantBuilder::record(ClashKind kind, std::uint32_t a, std::uint32_t b,
                          std::optional<double> distance, std::string what) {
    truth_.push_back({kind, a, b, distance, std::move(what)});
}

void PlantBuilder::go_back(const Mark& mark) {
    parts_.resize(mark.parts);
    space_.release_to(mark.boxes);
    triangles_ = mark.triangles;
}

Box3 PlantBuilder::bounds() const {
    Box3 result;
    for (const Part& part : parts_) {
        for (const Box3& cover : shapes_[part.mesh].cover) {
            const Box3 box = moved(part.world_from_mesh, cover);
            extend(result, box.lower);
            extend(result, box.upper);
        }
    }
    return result;
}

Plant PlantBuilder::finish() {
    Plant plant;
    plant.options = options;
    plant.triangles = triangles_;
    plant.separation = options.clearance + 9 * kGrid; // coordinates are rounded to floats
    plant.scene.file = "plant";
    constexpr std::uint32_t kUnused = ~std::uint32_t{0};
    std::vector<std::uint32_t> mesh_of_shape(shapes_.size(), kUnused);
    for (std::size_t i = 0; i < parts_.size(); ++i) {
        Part& part = parts_[i];
        std::uint32_t& mesh = mesh_of_shape[part.mesh];
        if (mesh == kUnused) {
            mesh = static_cast<std::uint32_t>(plant.scene.meshes.size());
            plant.mesh_closed.push_back(shapes_[part.mesh].closed);
            plant.scene.meshes.push_back(std::move(shapes_[part.mesh].mesh));
        }
        part.mesh = mesh;
        part.id = global_id(options.seed, i);
    }
    for (Pair& pair : truth_) {
        plant.truth.push_back(
            {pair.kind, parts_[pair.a].id, parts_[pair.b].id, pair.distance, std::move(pair.what)});
    }
    plant.scene.parts = std::move(parts_);
    return plant;
}

} // namespace abut::scenes
