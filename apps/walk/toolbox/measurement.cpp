#include "toolbox/measurement.h"

#include <abut/rigid.h>
#include <abut/shape_queries.h>

#include "vec.h"

#include <fmt/format.h>

namespace abut::viewer {

namespace {

Measurement between_parts(Walk& walk, WalkPart a, WalkPart b) {
    const Gap gap =
        distance(walk.model(a), walk.world_from_part(a), walk.model(b), walk.world_from_part(b));
    Measurement measured{fmt::format("{:.6g} m between the parts", gap.distance),
                         {gap.point_a, gap.point_b}};
    if (gap.distance > 0)
        return measured;
    for (const WalkGap& each : walk.penetration(a).parts)
        if (each.part == b)
            measured = {fmt::format("the parts meet, {:.6g} m deep", -each.distance),
                        {each.point_part, each.point_probe}};
    return measured;
}

} // namespace

const char* to_string(Measured kind) {
    static constexpr std::array kNames{"points", "point_part", "parts"};
    return kNames.at(static_cast<std::size_t>(kind));
}

Measurement measure(Walk& walk, Measured kind, const PartPoint& a, const PartPoint& b) {
    Measurement measured;
    if (kind == Measured::points) {
        measured = {fmt::format("{:.6g} m between the points", length(b.point - a.point)),
                    {a.point, b.point}};
    } else if (kind == Measured::point_part) {
        const Nearest found = nearest(walk.model(b.part), walk.world_from_part(b.part), a.point);
        measured = {fmt::format("{:.6g} m from the point to the part", found.distance),
                    {a.point, found.point}};
    } else {
        measured = between_parts(walk, a.part, b.part);
    }
    const Vec3 by = measured.ends[1] - measured.ends[0];
    measured.text += fmt::format(" (along x {:.6g}, y {:.6g}, z {:.6g})", by.x, by.y, by.z);
    return measured;
}

} // namespace abut::viewer
