#include "scenes/plant/plant_unit.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace abut::scenes {
namespace {

constexpr double kFrame = 6;           // distance from one frame of the rack to the next
constexpr std::array kTiers{5.0, 7.5}; // heights of the rack's beams

void build_rack_steel(PlantBuilder& b, const Unit& unit, double z) {
    const double g = b.gap, foot = ground_level(b) + g, top = 8.5;
    const ShapeId column = b.shape(
        "rack column", [&] { return i_section(top - foot, 0.3125, 0.3125, 0.015625, 0.0234375); });
    const double beam_length = kRackDepth - 0.3125 - 2 * g;
    const ShapeId beam = b.shape(
        "rack beam", [&] { return i_section(beam_length, 0.3125, 0.1875, 0.015625, 0.0234375); });
    for (double x = 1; x + kFrame / 2 < unit.rack_length; x += kFrame) {
        for (const double dz : {0.0, kRackDepth}) {
            b.place(column, along(kY, add(unit.origin, {x, foot, z + dz})), "IfcColumn",
                    fmt::format("Rack {} column", unit.number));
        }
        for (const double y : kTiers) {
            b.place(beam, along(kZ, add(unit.origin, {x, y - 0.15625, z + 0.15625 + g})), "IfcBeam",
                    fmt::format("Rack {} beam", unit.number));
        }
    }
    // One piece from end to end. These girders are the longest parts of the plant.
    const ShapeId girder = b.shape(fmt::format("rack girder {}", unit.rack_length), [&] {
        return i_section(unit.rack_length, 0.375, 0.25, 0.015625, 0.0234375);
    });
    for (const double dz : {0.0, kRackDepth}) {
        b.place(girder, at(add(unit.origin, {0, top + g + 0.1875, z + dz})), "IfcBeam",
                fmt::format("Rack {} girder {} m", unit.number, unit.rack_length));
    }
}

void build_rack_pipes(PlantBuilder& b, const Unit& unit, double z) {
    const std::array radius{0.0546875, 0.109375, 0.15625, 0.078125, 0.203125};
    for (std::size_t tier = 0; tier < kTiers.size(); ++tier) {
        double across = 0.5;
        for (int line = 1; across < kRackDepth - 0.75; ++line) {
            const double r = b.random.pick(radius), flange = on_grid(r * 1.4 + 0.046875);
            across += flange;
            const double y = on_grid_above(kTiers[tier] + b.gap + flange);
            int segment = 0;
            for (double x = 0.5; x + 6 < unit.rack_length; x += 6 + b.gap) {
                const bool flanged = segment % 2 == 1;
                const ShapeId id = b.shape(fmt::format("rack pipe {} {}", r, flanged), [&] {
                    return pipe(6, r, b.sides, {flanged ? flange : 0, flanged ? 0 : flange});
                });
                b.place(id, at(add(unit.origin, {x, y, z + across})), "IfcPipeSegment",
                        fmt::format("Pipe DN{} rack {} line {}.{} segment {}",
                                    static_cast<int>(2000 * r / 25) * 25, unit.number, tier + 1,
                                    line, ++segment));
            }
            across += flange + b.random.uniform(b.gap, b.gap + 0.25);
        }
    }
}

void build_storage_tanks(PlantBuilder& b, const Unit& unit) {
    const double g = b.gap, ground = ground_level(b);
    double x = 2;
    for (int n = 0; n < unit.storage_tanks; ++n) {
        const int size = n % 3;
        const double radius = 3.0 + size, height = 7.0 + 2 * ((n + 1) % 3), z = kRackFront - 4 - 5;
        const Vec3 foot = add(unit.origin, {x + radius, ground + g, z});
        const ShapeId pad = b.shape(fmt::format("tank pad {}", size), [&] {
            return lathe({{0, radius + 0.5}, {0.375, radius + 0.5}}, 2 * b.sides);
        });
        const ShapeId shell = b.shape(fmt::format("storage tank {}", n % 3), [&] {
            return lathe({{0, radius},
                          {height - 0.25, radius},
                          {height - 0.25, radius + 0.125},
                          {height, radius + 0.125},
                          {height, radius},
                          {height + radius * 0.18, radius * 0.6},
                          {height + radius * 0.25, 0}},
                         2 * b.sides);
        });
        b.place(pad, along(kY, foot), "IfcFooting",
                fmt::format("Tank foundation {}.{}", unit.number, n + 1));
        b.place(shell, along(kY, add(foot, {0, 0.375 + g, 0})), "IfcTank",
                fmt::format("Storage tank {}.{}", unit.number, n + 1));
        const ShapeId steps =
            b.shape(fmt::format("tank ladder {}", height), [&] { return ladder(height); });
        b.place(steps, at(add(foot, {0, 0.375 + g, -on_grid_above(radius + 0.125 + 0.0625 + g)})),
                "IfcStairFlight", fmt::format("Ladder of tank {}.{}", unit.number, n + 1));
        x += 2 * radius + 2;
    }
}

/// Builds the stack, its platforms and the flue.
void build_stack(PlantBuilder& b, const Unit& unit) {
    const double g = b.gap, ground = ground_level(b);
    const double pitch = on_grid_above(0.0625 + g), width = unit.wall_tubes * pitch;
    const double stack_r = std::max(1.0, on_grid(unit.stack_height / 32));
    const double side = on_grid_above(stack_r + 0.25);
    const double z = on_grid(unit.bays_z * kBay / 2);
    const Vec3 foot =
        add(unit.origin, {on_grid(unit.boiler_x() + 2 + width + 14 + 2 * stack_r), ground + g, z});
    const double h = unit.stack_height;
    const ShapeId stack = b.shape(fmt::format("stack {}", h), [&] {
        const double top_r = stack_r * 0.625, wall = 0.25;
        return lathe({{0, stack_r}, {h, top_r}, {h, top_r - wall}, {0, stack_r - wall}},
                     2 * b.sides, true);
    });
    b.place(stack, along(kY, foot), "IfcChimney", fmt::format("Stack {}", unit.number));
    const double outer = side + 1;
    const ShapeId ring = b.shape(fmt::format("stack platform {}", h), [&] {
        return plate({-outer, -side, side, outer}, {-outer, -side, side, outer}, 0, 0.0625,
                     [](std::size_t i, std::size_t k) { return i != 1 || k != 1; });
    });
    const ShapeId rail = b.shape(fmt::format("stack rail {}", outer),
                                 [&] { return railing(2 * outer - 0.5, 1.09375); });
    for (double y = 10; y < h; y += 10) {
        const Vec3 level = add(foot, {0, y, 0});
        b.place(ring, at(level), "IfcSlab", fmt::format("Stack {} platform", unit.number));
        for (const double s : {-1.0, 1.0}) {
            const double off = s * (outer - 0.125);
            b.place(rail, at(add(level, {0.25 - outer, 0.0625 + g, off})), "IfcRailing",
                    "Stack railing");
            b.place(rail, along(kZ, add(level, {off, 0.0625 + g, 0.25 - outer})), "IfcRailing",
                    "Stack railing");
        }
    }
    const double flue = width > 4 ? 2.0 : 1.0, from = foot.x - side - g - 4;
    const ShapeId duct_shape =
        b.shape(fmt::format("flue {}", flue), [&] { return duct(4, flue, flue); });
    b.place(duct_shape, at({from, 5, foot.z}), "IfcDuctSegment",
            fmt::format("Flue {}", unit.number));
    b.place(duct_shape, along(kY, {from - 1 - flue, 5 + flue, foot.z}), "IfcDuctSegment",
            fmt::format("Flue {} riser", unit.number));
}

} // namespace

void build_rack(PlantBuilder& b, const Unit& unit) {
    build_rack_steel(b, unit, kRackFront);
    build_rack_pipes(b, unit, kRackFront);
}

void build_yard(PlantBuilder& b, const Unit& unit) {
    build_storage_tanks(b, unit);
    build_stack(b, unit);
}

} // namespace abut::scenes
