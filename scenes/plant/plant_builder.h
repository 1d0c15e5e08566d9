#pragma once

#include "scenes/deforming/frame.h"
#include "scenes/plant/plant.h"
#include "scenes/random.h"
#include "scenes/shapes.h"
#include "scenes/space.h"

#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

namespace abut::scenes {

/// The index of a shared shape.
using ShapeId = std::uint32_t;

/// Places parts where there is room for them, and counts their triangles. Every part of a plant is
/// added by `place` or `plant`. This keeps the plant free of clashes other than the planted ones.
class PlantBuilder {
public:
    PlantBuilder(const PlantOptions& options, int sides);

    /// The shape with this key. It is created at its first use.
    template <class Make>
    ShapeId shape(const std::string& key, Make make) {
        const auto [entry, is_new] =
            shape_of_key_.try_emplace(key, static_cast<ShapeId>(shapes_.size()));
        if (is_new) {
            shapes_.push_back(make());
        }
        return entry->second;
    }
    [[nodiscard]] const Shape& shape(ShapeId id) const { return shapes_[id]; }

    /// Whether the shape keeps the gap to all parts other than `except`.
    [[nodiscard]] bool free(ShapeId id, const Transform& pose,
                            std::uint32_t except = Space::kNobody) const;
    /// Adds a part if there is room for it. Returns whether there was.
    bool place(ShapeId id, const Transform& pose, std::string_view type, std::string name);
    /// Adds a part of a planted clash, for which the caller has checked the room. Returns its
    /// index.
    std::uint32_t plant(ShapeId id, const Transform& pose, std::string_view type, std::string name);
    /// Records a planted pair.
    void record(ClashKind kind, std::uint32_t a, std::uint32_t b, std::optional<double> distance,
                std::string what);

    /// A state to which go_back() can return after an unsuccessful attempt.
    struct Mark {
        std::size_t parts, boxes;
        std::uint64_t triangles;
    };
    [[nodiscard]] Mark mark() const { return {parts_.size(), space_.size(), triangles_}; }
    void go_back(const Mark& mark);

    [[nodiscard]] std::uint64_t triangles() const { return triangles_; }
    [[nodiscard]] const std::vector<Part>& parts() const { return parts_; }
    /// The box of all parts.
    [[nodiscard]] Box3 bounds() const;

    /// Returns the plant: parts get their ids, unused meshes are dropped.
    Plant finish();

    const PlantOptions options;
    const double gap; ///< between parts: larger than the clearance, on the grid
    const int sides;  ///< of round shapes; 8, 12, 16, ...
    Random random;

private:
    std::vector<Shape> shapes_;
    std::unordered_map<std::string, ShapeId> shape_of_key_;
    std::vector<Part> parts_; // Part::mesh is a ShapeId until `finish`
    struct Pair {
        ClashKind kind;
        std::uint32_t a, b;
        std::optional<double> distance;
        std::string what;
    };
    std::vector<Pair> truth_;
    Space space_;
    std::uint64_t triangles_ = 0;
};

} // namespace abut::scenes
