#include "scenes/plant/plant_unit.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace abut::scenes {
namespace {

/// Flights alternate between two lanes of their bay, so that each starts on a floor.
double flight_x(int f) {
    return f % 2 == 0 ? 1.59375 : 6.40625;
}

} // namespace

std::vector<Opening> openings(BayUse use, int f) {
    if (f == 0) {
        return {};
    }
    switch (use) {
    case BayUse::open:
        return {{0.75, 6, 2.25, 7}};
    case BayUse::shaft:
        return {{0.75, 0.75, 2.25, 1.75}, {5.75, 0.75, 7.25, 2.25}, {3.25, 6, 4.75, 7}};
    case BayUse::stairs: {
        const double x = flight_x(f - 1); // x of the flight that arrives
        return {{x - 0.84375, 0.75, x + 0.84375, 7.25}};
    }
    case BayUse::vessel:
        return {{2.9375, 2.75, 5.0625, 5.25}};
    }
    return {};
}

namespace {

/// The slab of a bay, notched at the columns, with its openings. Slabs of neighbouring bays keep
/// the gap.
Shape slab(const PlantBuilder& b, BayUse use, int f) {
    const double g = b.gap, edge = on_grid_above(g / 2);
    const double notch = on_grid_above((f == 0 ? 0.625 : kColumn / 2) + g);
    const std::vector<Opening> holes = openings(use, f);
    std::vector<double> x{edge, notch, kBay - notch, kBay - edge}, z = x;
    for (const Opening& hole : holes) {
        x.insert(x.end(), {hole.x0, hole.x1});
        z.insert(z.end(), {hole.z0, hole.z1});
    }
    for (auto* cuts : {&x, &z}) {
        std::sort(cuts->begin(), cuts->end());
        cuts->erase(std::unique(cuts->begin(), cuts->end()), cuts->end());
    }
    return plate(x, z, -kSlab, 0, [&](std::size_t i, std::size_t k) {
        const bool corner = (i == 0 || i + 2 == x.size()) && (k == 0 || k + 2 == z.size());
        return !corner && std::ranges::none_of(holes, [&](const Opening& hole) {
            return x[i] >= hole.x0 && x[i] < hole.x1 && z[k] >= hole.z0 && z[k] < hole.z1;
        });
    });
}

/// Railings along the four edges of a storey's floor, one for each bay.
void build_railings(PlantBuilder& b, const Unit& unit, int f) {
    const double g = b.gap, inset = 0.4375, start = 0.75;
    const ShapeId rail = b.shape("railing", [&] { return railing(kBay - 2 * start, 1.09375); });
    const std::string name = fmt::format("Railing {}-{}", unit.number, f);
    for (int i = 0; i < unit.bays_x; ++i) {
        b.place(rail, at(unit.in_bay(i, 0, f, start, g, inset)), "IfcRailing", name);
        b.place(rail, at(unit.in_bay(i, unit.bays_z, f, start, g, -inset)), "IfcRailing", name);
    }
    for (int k = 0; k < unit.bays_z; ++k) {
        b.place(rail, along(kZ, unit.in_bay(0, k, f, inset, g, start)), "IfcRailing", name);
        b.place(rail, along(kZ, unit.in_bay(unit.bays_x, k, f, -inset, g, start)), "IfcRailing",
                name);
    }
}

/// A sloping stringer in the plane of x and y, cut vertically at its ends.
Shape stringer(double run, double rise, double depth, double thick) {
    const Shape upright = prism(thick, {{0, 0}, {depth, 0}, {rise + depth, run}, {rise, run}});
    Shape shape;
    append(shape, upright, turned(scaled(kZ, -1), kY, {}));
    shape.cover.clear();
    const int pieces = static_cast<int>(run / 0.125);
    for (int k = 0; k < pieces; ++k) {
        shape.cover.push_back({{run * k / pieces, rise * k / pieces, -thick},
                               {run * (k + 1) / pieces, rise * (k + 1) / pieces + depth, 0}});
    }
    return shape;
}

/// One straight flight from floor to floor in the opening of a stair bay, along z.
void build_flight(PlantBuilder& b, const Unit& unit, int i, int k, int f) {
    constexpr int kSteps = 25;
    constexpr double kWidth = 1, kGoing = 0.25, kThick = 0.046875, kBoard = 0.03125, kDepth = 0.25;
    const double g = b.gap, rise = kStorey / (kSteps + 1);
    const double run = kSteps * kGoing, climb = on_grid(kSteps * rise);
    // Built in the plane of x and y, rising along x; the pose turns the flight to z.
    const Vec3 foot = unit.in_bay(i, k, f, flight_x(f), 0, 0.875);
    const auto pose = [&](double x, double y, double z) {
        return turned(kZ, kY, add(foot, {-z, y, x}));
    };
    const std::string name = fmt::format("Stair {}-{}", unit.number, f + 1);
    const ShapeId side = b.shape("stringer", [&] { return stringer(run, climb, kDepth, kBoard); });
    const double edge = on_grid_above(kWidth / 2 + g);
    b.place(side, pose(0, g, edge + kBoard), "IfcMember", name + " stringer");
    b.place(side, pose(0, g, -edge), "IfcMember", name + " stringer");
    const ShapeId tread = b.shape("tread", [&] {
        return box({{0, 0, -kWidth / 2}, {kGoing - 0.03125, kThick, kWidth / 2}});
    });
    for (int step = 0; step < kSteps; ++step) {
        const double y = on_grid((step + 1) * rise);
        b.place(tread, pose(step * kGoing, y, 0), "IfcStairFlight",
                fmt::format("{} tread {}", name, step + 1));
    }
    const ShapeId rail =
        b.shape("hand rail", [&] { return stringer(run, climb, 0.0625, 0.046875); });
    for (const double z : {edge + 0.046875, -edge}) {
        b.place(rail, pose(0, 1.25, z), "IfcRailing", name + " hand rail");
    }
    const ShapeId post =
        b.shape("stair post", [&] { return block(0.03125, on_grid(1 - kDepth - 2 * g), 0.03125); });
    for (int step = 2; step < kSteps; step += 5) {
        const double y = on_grid_above(g + kDepth + (step + 0.75) * rise + g);
        for (const double z : {edge + 0.015625, -edge - 0.015625}) {
            b.place(post, pose(step * kGoing, y, z), "IfcRailing", name + " post");
        }
    }
}

} // namespace

void build_floors(PlantBuilder& b, const Unit& unit) {
    for (int f = 0; f <= unit.floors; ++f) {
        for (int i = 0; i < unit.bays_x; ++i) {
            for (int k = 0; k < unit.bays_z; ++k) {
                const BayUse use = unit.use_of(i, k);
                const ShapeId id =
                    b.shape(fmt::format("slab {} {}", f == 0 ? -1 : static_cast<int>(use),
                                        use == BayUse::stairs ? f % 2 : 0),
                            [&] { return slab(b, use, f); });
                b.place(id, at(unit.in_bay(i, k, f, 0, 0, 0)), "IfcSlab",
                        fmt::format("Slab {}-{} bay {}.{}", unit.number, f, i + 1, k + 1));
            }
        }
        if (f > 0) {
            build_railings(b, unit, f);
        }
    }
}

void build_stairs(PlantBuilder& b, const Unit& unit) {
    for (int i = 0; i < unit.bays_x; ++i) {
        for (int k = 0; k < unit.bays_z; ++k) {
            for (int f = 0; f < unit.floors && unit.use_of(i, k) == BayUse::stairs; ++f) {
                build_flight(b, unit, i, k, f);
            }
        }
    }
}

} // namespace abut::scenes
