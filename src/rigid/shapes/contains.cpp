#include <abut/shape_queries.h>

#include "core/parallel.h"
#include "rigid/shapes/shape_arguments.h"
#include "rigid/solid/placed_solid.h"

#include <cmath>

namespace abut {

namespace {

class ContainmentQuery {
public:
    ContainmentQuery(const Model& model, const Transform& world_from_model)
        : placed_(model, model.data().solid(), world_from_model),
          model_from_world_(inverse(placed_.model().world())) {}

    [[nodiscard]] Containment operator()(const Vec3& point) const {
        Containment result;
        const Solid& solid = placed_.solid();
        result.method = solid.closed ? ContainmentMethod::crossings : ContainmentMethod::winding;
        if (placed_.on_surface(point))
            result.side = Side::on_surface;
        else if (solid.closed)
            result.side = placed_.contains_off_surface(point) ? Side::inside : Side::outside;
        if (result.side == Side::outside && (!solid.closed || !solid.open.empty()))
            ask_winding_number(point, result);
        return result;
    }

private:
    /// Asks the winding number of the triangles that bound no solid, or bound one only but for
    /// T-junctions.
    void ask_winding_number(const Vec3& point, Containment& result) const {
        // An affine map moves mesh and point alike; a mirroring one changes the sign of the number.
        const Solid& solid = placed_.solid();
        const Mesh& mesh = placed_.model().data().mesh();
        const Vec3 in_mesh = apply(model_from_world_, point);
        const auto ask = [&](double number, bool is_stored) {
            result.winding_number = placed_.is_mirrored() && is_stored ? -number : number;
            result.side = std::abs(number) >= 0.5 ? Side::inside : Side::outside;
        };
        if (!solid.closed && !solid.weights.empty())
            ask(winding_number(mesh, solid, in_mesh), false);
        else if (solid.open.empty())
            ask(winding_number(mesh, in_mesh), true);
        if (result.side == Side::outside && !solid.open.empty())
            ask(winding_number(mesh, solid.open, in_mesh), true);
        result.method = ContainmentMethod::winding;
    }

    PlacedSolid placed_;
    Transform model_from_world_;
};

} // namespace

Containment contains(const Model& model, const Transform& world_from_model, const Vec3& point,
                     const Progress& progress) {
    require_point(point, "point");
    const StopScope stopping(progress);
    return ContainmentQuery(model, world_from_model)(point);
}

std::vector<Containment> contains(const Model& model, const Transform& world_from_model,
                                  std::span<const Vec3> points, const Progress& progress) {
    for (const Vec3& point : points)
        require_point(point, "point");
    const StopScope stopping(progress);
    const ContainmentQuery query(model, world_from_model);
    std::vector<Containment> results(points.size());
    parallel_for(points.size(), 8, [&](std::size_t i) { results[i] = query(points[i]); });
    return results;
}

} // namespace abut
