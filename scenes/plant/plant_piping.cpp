#include "scenes/plant/plant_unit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <fmt/format.h>

namespace abut::scenes {
namespace {

struct Bore {
    int dn;        ///< nominal diameter, mm
    double radius; ///< outer radius
    double flange; ///< radius of its flanges
};
constexpr std::array kBores{Bore{50, 0.03125, 0.078125},    Bore{80, 0.046875, 0.1015625},
                            Bore{100, 0.0546875, 0.109375}, Bore{150, 0.0859375, 0.140625},
                            Bore{200, 0.109375, 0.171875},  Bore{300, 0.1640625, 0.2265625}};

/// Lays a pipe run leg by leg. Each piece is placed as soon as there is room for it.
class Run {
public:
    Run(PlantBuilder& builder, const Unit& unit, int number, std::uint64_t limit)
        : b_(builder), bore_(b_.random.pick(kBores)), limit_(limit),
          low_(add(unit.origin, {-2, 0.25, -3})),
          high_(add(unit.origin, {unit.bays_x * kBay + 3, unit.floors * kStorey + 1.5,
                                  unit.bays_z * kBay - 0.25})),
          name_(fmt::format("Pipe DN{} run {}", bore_.dn, number)) {}

    /// Lays a straight leg of about `length` from `start`. Returns false, with nothing placed, if
    /// there is no room.
    bool leg(const Vec3& start, const Vec3& direction, double length) {
        if (!inside(start) || !inside(add(start, scaled(direction, length)))) {
            return false;
        }
        const PlantBuilder::Mark mark = b_.mark();
        const int segment_before = segment_;
        Vec3 p = start;
        double left = length;
        bool flange_before = false;
        while (left >= 0.5) {
            const double piece = left >= 4 ? 4 : std::floor(left * 2) / 2;
            left -= piece;
            const bool flange_after = left >= 0.5 && b_.random.chance(0.4);
            if (b_.triangles() >= limit_) {
                break;
            }
            const double r = bore_.flange;
            const PipeEnds ends{flange_before ? r : 0, flange_after ? r : 0};
            const ShapeId id = b_.shape(
                fmt::format("pipe {} {} {} {}", bore_.dn, piece, flange_before, flange_after),
                [&] { return pipe(piece, bore_.radius, b_.sides, ends); });
            if (!b_.place(id, along(direction, p), "IfcPipeSegment",
                          fmt::format("{} segment {}", name_, ++segment_))) {
                b_.go_back(mark);
                segment_ = segment_before;
                return false;
            }
            p = add(p, scaled(direction, piece));
            if (flange_after) {
                p = add(p, scaled(direction, joint(p, direction)));
            } else if (left >= 0.5) {
                p = add(p, scaled(direction, b_.gap));
            }
            flange_before = flange_after;
        }
        end_ = p;
        return true;
    }

    /// Lays a bend at the end of the last leg, and the leg after it.
    bool turn_and_leg(const Vec3& from, const Vec3& to, double length) {
        const PlantBuilder::Mark mark = b_.mark();
        const double bend = on_grid(3 * bore_.radius);
        const Vec3 end = end_, start = add(end, scaled(from, b_.gap));
        const ShapeId id = b_.shape(fmt::format("elbow {}", bore_.dn), [&] {
            return elbow(bore_.radius, bend, b_.sides, std::max(3, b_.sides / 4));
        });
        if (b_.place(id, turned(from, to, start), "IfcPipeFitting", name_ + " elbow") &&
            leg(add(start, add(scaled(from, bend), scaled(to, bend + b_.gap))), to, length)) {
            return true;
        }
        b_.go_back(mark);
        end_ = end;
        return false;
    }

private:
    /// Runs stay within the building or just outside it.
    [[nodiscard]] bool inside(const Vec3& p) const {
        return p.x >= low_.x && p.y >= low_.y && p.z >= low_.z && p.x <= high_.x &&
               p.y <= high_.y && p.z <= high_.z;
    }

    /// Places studs between two flanges. Returns the distance between the flanges.
    double joint(const Vec3& p, const Vec3& direction) {
        constexpr double kLength = 0.0625, kRadius = 0.01171875;
        const double circle = bore_.flange - 0.015625;
        const ShapeId stud =
            b_.shape("stud", [&] { return bolt(kLength, kRadius, b_.sides < 12); });
        const Vec3 side = direction.y != 0 ? kX : kY, up = cross(direction, side);
        const int count = bore_.dn < 80 ? 4 : bore_.dn < 200 ? 8 : 12;
        for (int k = 0; k < count && b_.triangles() < limit_; ++k) {
            const Point2 c = on_circle(2 * k + 1, 2 * count);
            const Vec3 out =
                add(scaled(side, on_grid(circle * c.u)), scaled(up, on_grid(circle * c.v)));
            b_.place(stud, along(direction, add(p, add(out, scaled(direction, b_.gap)))),
                     "IfcMechanicalFastener", name_ + " stud M20");
        }
        return 2 * b_.gap + kLength;
    }

    PlantBuilder& b_;
    Bore bore_;
    std::uint64_t limit_;
    Vec3 low_, high_;
    std::string name_;
    int segment_ = 0;
    Vec3 end_;
};

Vec3 start_point(PlantBuilder& b, const Unit& unit, Vec3& direction) {
    const int i = b.random.below(unit.bays_x), k = b.random.below(unit.bays_z);
    const int f = b.random.below(unit.floors);
    const std::vector<Opening> holes = openings(unit.use_of(i, k), 1);
    if (unit.use_of(i, k) != BayUse::stairs && unit.use_of(i, k) != BayUse::vessel &&
        b.random.chance(0.5)) {
        const Opening& hole =
            holes[static_cast<std::size_t>(b.random.below(static_cast<int>(holes.size())))];
        direction = kY;
        const Vec3 p{b.random.uniform(hole.x0 + 0.25, hole.x1 - 0.25), b.random.uniform(0.5, 3),
                     b.random.uniform(hole.z0 + 0.25, hole.z1 - 0.25)};
        return unit.in_bay(i, k, f, p);
    }
    direction = b.random.chance(0.5) ? (b.random.chance(0.5) ? kX : scaled(kX, -1))
                                     : (b.random.chance(0.5) ? kZ : scaled(kZ, -1));
    // Most pipes hang in the upper third of a storey. Coarse steps in height arrange them in tiers.
    const double y =
        b.random.chance(0.8) ? 2.5 + 0.25 * b.random.below(8) : 0.5 + 0.25 * b.random.below(6);
    const Vec3 p{b.random.uniform(0.5, 7.5), y, b.random.uniform(0.5, 7.5)};
    return unit.in_bay(i, k, f, p);
}

} // namespace

bool lay_pipe_run(PlantBuilder& b, const Unit& unit, int number, std::uint64_t limit) {
    constexpr std::array<Vec3, 6> kDirections{Vec3{1, 0, 0}, {-1, 0, 0}, {0, 0, 1},
                                              {0, 0, -1},    {0, 1, 0},  {0, -1, 0}};
    const PlantBuilder::Mark before = b.mark();
    Run run(b, unit, number, limit);
    Vec3 direction;
    const Vec3 start = start_point(b, unit, direction);
    double length = b.random.between(6, 24);
    while (!run.leg(start, direction, length)) {
        length = std::floor(length / 2);
        if (length < 2) {
            b.go_back(before);
            return false;
        }
    }
    const int legs = b.random.between(2, 7);
    int laid = 1;
    for (int attempt = 0; attempt < 24 && laid < legs && b.triangles() < limit; ++attempt) {
        const Vec3 to = b.random.pick(kDirections);
        if (dot(to, direction) != 0) {
            continue;
        }
        const double wish = to.y != 0 ? b.random.between(1, 3) : b.random.between(2, 20);
        for (double reach = wish; reach >= 1; reach = std::floor(reach / 2)) {
            if (run.turn_and_leg(direction, to, reach)) {
                direction = to;
                ++laid;
                break;
            }
        }
    }
    return true;
}

void fill_laydown_yard(PlantBuilder& b, double x, double z, std::uint64_t limit) {
    const ShapeId spare = b.shape("spare pipe", [&] {
        return pipe(6, 0.109375, b.sides, {0.171875, 0.171875});
    });
    const ShapeId stud = b.shape("spare bolt", [] { return bolt(0.125, 0.01171875, true); });
    const double ground = ground_level(b);
    const double pitch = on_grid_above(0.34375 + b.gap);
    int row = 0;
    for (; b.triangles() + b.shape(spare).mesh.triangles.size() <= limit; ++row) {
        const int layer = row / 20 % 3, lot = row / 60, lot_row = lot / 10;
        const Vec3 p{x + 8.0 * (lot % 10), ground + 0.5 + pitch * layer,
                     z - pitch * (row % 20) - (20 * pitch + 2) * lot_row};
        b.place(spare, at(p), "IfcPipeSegment", fmt::format("Spare pipe DN200 {}", row + 1));
    }
    const double step = on_grid_above(0.125 + b.gap);
    for (int n = 0; b.triangles() + b.shape(stud).mesh.triangles.size() <= limit && n < 200; ++n) {
        const int column = n % 10, line = n / 10;
        b.place(stud, along(kY, {x - 2 - step * column, ground + b.gap, z - step * line}),
                "IfcMechanicalFastener", fmt::format("Spare bolt M20 {}", n + 1));
    }
}

} // namespace abut::scenes
