#include "toolbox/measure.h"

#include <abut/rigid.h>
#include <abut/shape_queries.h>

#include <fmt/format.h>

namespace abut::viewer {

const char* to_string(Measured kind) {
    static constexpr std::array kNames{"points", "point_part", "parts"};
    return kNames.at(static_cast<std::size_t>(kind));
}

void Measure::clear() {
    picks.clear();
    result.clear();
    has_ends = false;
}

void Measure::next() {
    clear();
    if (!on) {
        on = true;
        kind = Measured::parts;
    } else if (kind == Measured::points) {
        on = false;
    } else {
        kind = kind == Measured::parts ? Measured::point_part : Measured::points;
    }
}

void Measure::forget_removed(const Session& session) {
    for (const Pick& pick : picks)
        if (session.is_removed(pick.part) ||
            (pick.part >= session.view.parts().size() && !session.brought.contains(pick.part))) {
            clear();
            return;
        }
}

void Measure::take(Session& session, const Pick& pick) {
    if (picks.size() == 2)
        clear();
    picks.push_back(pick);
    if (picks.size() < 2)
        return;
    const Pick &a = picks[0], &b = picks[1];
    if (kind == Measured::points) {
        ends = {a.point, b.point};
        result = fmt::format("{:.6g} m between the points", length(b.point - a.point));
    } else if (kind == Measured::point_part) {
        const WalkPart part = session.walk_part(b.part);
        const Nearest found =
            nearest(session.walk.model(part), session.walk.world_from_part(part), a.point);
        ends = {a.point, found.point};
        result = fmt::format("{:.6g} m from the point to the part", found.distance);
    } else {
        measure_parts(session, a.part, b.part);
    }
    has_ends = true;
    const Vec3 by = ends[1] - ends[0];
    result += fmt::format(" (along x {:.6g}, y {:.6g}, z {:.6g})", by.x, by.y, by.z);
}

void Measure::measure_parts(Session& session, std::uint32_t a, std::uint32_t b) {
    const WalkPart part_a = session.walk_part(a), part_b = session.walk_part(b);
    Walk& walk = session.walk;
    const Gap gap = distance(walk.model(part_a), walk.world_from_part(part_a), walk.model(part_b),
                             walk.world_from_part(part_b));
    ends = {gap.point_a, gap.point_b};
    result = fmt::format("{:.6g} m between the parts", gap.distance);
    if (gap.distance > 0)
        return;
    for (const WalkGap& each : walk.penetration(part_a).parts)
        if (each.part == part_b) {
            ends = {each.point_part, each.point_probe};
            result = fmt::format("the parts meet, {:.6g} m deep", -each.distance);
        }
}

} // namespace abut::viewer
