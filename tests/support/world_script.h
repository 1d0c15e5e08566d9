#pragma once

#include <abut/deformable.h>
#include <abut/error.h>
#include <abut/world.h>

#include "math/transform.h"
#include "math/vector.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <map>
#include <memory>
#include <stdexcept>
#include <utility>
#include <variant>
#include <vector>

/// Scripts of operations on a world, and what the world must answer. The property test draws their
/// choices at random, and the fuzzer reads them from bytes.
namespace abut::test {

inline Mesh tetrahedron(double size) {
    return {{{0, 0, 0}, {size, 0, 0}, {0, size, 0}, {0, 0, size}},
            {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
}

/// A deformable surface with its step.
struct MovingSurface {
    Mesh mesh; ///< at the start
    std::vector<Vec3> end;
    Deformable surface;

    explicit MovingSurface(const Mesh& start) : mesh(start), end(start.positions), surface(start) {}
    void set_step(std::vector<Vec3> from, std::vector<Vec3> to) {
        mesh.positions = std::move(from), end = std::move(to);
        surface.set_motion(mesh.positions, end);
    }
};

/// The test's own record of a body.
struct Known {
    std::variant<Model, Convex, Sphere, Capsule, Box3, std::shared_ptr<MovingSurface>> shape;
    Pose pose;
    BodyOptions options;
};

inline bool is_apart(const Box3& a, const Box3& b) {
    return a.upper.x < b.lower.x || b.upper.x < a.lower.x || a.upper.y < b.lower.y ||
           b.upper.y < a.lower.y || a.upper.z < b.lower.z || b.upper.z < a.lower.z;
}
inline bool may_meet(const BodyOptions& a, const BodyOptions& b) {
    return !(a.is_static && b.is_static) && (a.groups & b.mask) != 0 && (b.groups & a.mask) != 0;
}

using BodyPairs = std::vector<BodyPair>;

inline BodyPairs without(const BodyPairs& a, const BodyPairs& b) {
    BodyPairs rest;
    std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(rest));
    return rest;
}
inline bool holds(const BodyPairs& pairs, BodyPair pair) {
    return std::binary_search(pairs.begin(), pairs.end(), pair);
}

struct ScriptOptions {
    double offset = 0; ///< added to all positions, on all axes
    bool deformables = false;
};

/// Choices has uniform(low, high), integer(low, high) with both bounds included, and chance(p).
template <typename Choices>
class WorldScript {
public:
    WorldScript(Choices& choices, World& world, const ScriptOptions& options = {})
        : choices_(choices), world_(world), options_(options), model_(tetrahedron(0.3)) {}

    [[nodiscard]] const std::map<BodyId, Known>& bodies() const { return bodies_; }
    [[nodiscard]] const std::vector<BodyId>& removed() const { return removed_; }

    void step() {
        for (int count = choices_.integer(0, 12); count > 0; --count) {
            const double choice = choices_.uniform(0, 1);
            if (bodies_.size() < 10 || choice < 0.35)
                add();
            else if (choice < 0.8)
                move(choice < 0.5 ? 2 : 0.05);
            else if (choice < 0.93)
                remove(any()->first);
            else if (choice < 0.98)
                change_options();
            else
                move_badly();
        }
    }
    void add() {
        Known body{sphere(), pose(), body_options()};
        switch (choices_.integer(0, options_.deformables ? 5 : 4)) {
        case 0:
            body.shape = model_;
            break;
        case 1:
            body.shape = Capsule{{in_cube(0.2), in_cube(0.2)}, radius()};
            break;
        case 2: {
            const Vec3 half = 0.2 * (in_cube(1) + Vec3{1.1, 1.1, 1.1});
            body.shape = choices_.chance(0.1) ? Box3{{}, {}} : Box3{-half, half};
            break;
        }
        case 3: {
            std::vector<Vec3> points(static_cast<std::size_t>(choices_.integer(1, 20)));
            for (Vec3& p : points)
                p = in_cube(0.25);
            body.shape = Convex(points);
            break;
        }
        case 5:
            body = deformable();
            break;
        default:
            break;
        }
        if (!bodies_.empty() && choices_.chance(0.1)) // bodies may coincide
            body = any()->second;
        const BodyId id =
            std::visit([&](const auto& shape) { return add_shape(shape, body); }, body.shape);
        if (!bodies_.emplace(id, body).second)
            throw std::logic_error("an id was given twice");
    }
    void remove(BodyId id) {
        world_.remove(id);
        removed_.push_back(id);
        bodies_.erase(id);
    }

    /// Motions of some bodies from their current poses. Deformables are left out.
    std::vector<BodyMotion> motions(double share) {
        std::vector<BodyMotion> result;
        for (const auto& [id, body] : bodies_)
            if (!std::holds_alternative<std::shared_ptr<MovingSurface>>(body.shape) &&
                choices_.chance(share))
                result.push_back(
                    {id,
                     {body.pose, body.pose.translation + in_cube(0.1), in_cube(2), in_cube(3)}});
        return result;
    }

    Vec3 in_cube(double half) {
        const double x = choices_.uniform(-half, half), y = choices_.uniform(-half, half),
                     z = choices_.uniform(-half, half);
        return {x, y, z};
    }

private:
    template <typename Shape>
    BodyId add_shape(const Shape& shape, const Known& body) {
        return world_.add(shape, body.pose, body.options);
    }
    BodyId add_shape(const std::shared_ptr<MovingSurface>& shape, const Known& body) {
        return world_.add(shape->surface, body.options);
    }

    double radius() { return choices_.chance(0.2) ? 0 : choices_.uniform(0, 0.2); }
    Sphere sphere() {
        if (choices_.chance(0.02))
            return {{}, 1e3}; // large enough to span the world
        return {in_cube(0.1), radius()};
    }
    Vec3 offset() const { return {options_.offset, -options_.offset, options_.offset}; }
    Pose pose() {
        const Vec3 axis = in_cube(1);
        return {in_cube(1) + offset(), {choices_.uniform(0.1, 1), axis.x, axis.y, axis.z}};
    }
    BodyOptions body_options() {
        BodyOptions options;
        options.is_static = choices_.chance(0.2);
        options.groups = std::uint32_t(choices_.integer(1, 3));
        options.mask = choices_.chance(0.8) ? ~0U : std::uint32_t(choices_.integer(0, 3));
        return options;
    }
    /// A deformable body. It has no pose of its own.
    Known deformable() {
        auto moving = std::make_shared<MovingSurface>(placed(tetrahedron(0.3), pose()));
        set_step(*moving, 0.2);
        return {moving, {}, body_options()};
    }
    static Mesh placed(Mesh mesh, const Pose& pose) {
        for (Vec3& p : mesh.positions)
            p = apply(Transform(pose), p);
        return mesh;
    }
    /// Sets a step from the surface's current place: a common translation, and a random one for
    /// each vertex.
    void set_step(MovingSurface& moving, double by) {
        std::vector<Vec3> end = moving.end;
        const Vec3 way = in_cube(by);
        for (Vec3& p : end)
            p = p + way + in_cube(0.5 * by);
        moving.set_step(moving.end, std::move(end));
    }
    std::map<BodyId, Known>::iterator any() {
        return std::next(bodies_.begin(), choices_.integer(0, int(bodies_.size()) - 1));
    }
    void move(double by) {
        auto& [id, body] = *any();
        if (const auto* moving = std::get_if<std::shared_ptr<MovingSurface>>(&body.shape)) {
            set_step(**moving, by);
            for (const auto& [other, known] : bodies_) { // coincident bodies share the surface
                const auto* shared = std::get_if<std::shared_ptr<MovingSurface>>(&known.shape);
                if (shared != nullptr && *shared == *moving)
                    world_.refresh(other);
            }
            return;
        }
        Pose next = pose();
        if (by < 1) {
            next = body.pose;
            next.translation = next.translation + by * in_cube(1);
        }
        world_.move(id, next);
        body.pose = next;
    }
    /// Moves a body to an invalid pose. The world must refuse it and stay unchanged.
    void move_badly() {
        const BodyId id = any()->first;
        Pose bad = pose();
        bad.translation.y = choices_.chance(0.5) ? std::numeric_limits<double>::quiet_NaN() : 1e300;
        try {
            world_.move(id, bad);
        } catch (const Error&) {
            return;
        }
        throw std::logic_error("a bad pose was taken");
    }
    void change_options() {
        auto& [id, body] = *any();
        body.options = body_options();
        world_.set_options(id, body.options);
    }

    Choices& choices_;
    World& world_;
    ScriptOptions options_;
    Model model_;
    std::map<BodyId, Known> bodies_;
    std::vector<BodyId> removed_;
};

/// The pairs of bodies that may meet and for which holds(a, b).
template <typename Script, typename Holds>
BodyPairs pairs_where(const Script& script, const Holds& holds) {
    BodyPairs pairs;
    for (const auto& [a, body_a] : script.bodies())
        for (const auto& [b, body_b] : script.bodies())
            if (a.index < b.index && may_meet(body_a.options, body_b.options) && holds(a, b))
                pairs.push_back({a, b});
    return pairs;
}

/// The pairs of bodies whose boxes overlap.
template <typename Script>
BodyPairs pairs_of_boxes(const Script& script, const World& world) {
    return pairs_where(script,
                       [&](BodyId a, BodyId b) { return !is_apart(world.box(a), world.box(b)); });
}

} // namespace abut::test
