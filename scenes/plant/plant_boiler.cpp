#include "scenes/plant/plant_unit.h"

#include <algorithm>
#include <fmt/format.h>

namespace abut::scenes {
namespace {

constexpr double kTube = 0.03125; // radius

/// One wall of vertical tubes with its headers. `right` is the direction along the wall.
void build_tube_wall(PlantBuilder& b, const Unit& unit, const Vec3& corner, const Vec3& right,
                     double pitch, char wall) {
    const double height = unit.boiler_height(), low = 2;
    const int sides = std::max(6, b.sides / 2);
    const ShapeId tube = b.shape(fmt::format("wall tube {}", height),
                                 [&] { return pipe(height - low, kTube, sides); });
    for (int t = 0; t < unit.wall_tubes; ++t) {
        const Vec3 p = add(corner, add(scaled(right, (t + 0.5) * pitch), {0, low, 0}));
        b.place(tube, along(kY, p), "IfcPipeSegment",
                fmt::format("Boiler {} wall {} tube {}", unit.number, wall, t + 1));
    }
    const double radius = 0.15625, length = unit.wall_tubes * pitch;
    const ShapeId header = b.shape(fmt::format("header {}", length),
                                   [&] { return tank(length, radius, 0.0625, b.sides, 2); });
    for (const double y : {low - radius - b.gap, height + radius + b.gap}) {
        b.place(header, along(right, add(corner, {0, on_grid(y), 0})), "IfcPipeFitting",
                fmt::format("Boiler {} wall {} header", unit.number, wall));
    }
}

void build_boiler_frame(PlantBuilder& b, const Unit& unit, const Vec3& corner, double width) {
    const double reach = 1.5, height = on_grid(unit.boiler_height() + 4), g = b.gap;
    const double foot = ground_level(b) + g;
    const ShapeId column = b.shape(fmt::format("boiler column {}", height), [&] {
        return hollow_section(height - foot, 0.625, 0.625, 0.03125);
    });
    const double span = width + 2 * reach;
    for (const double x : {-reach, width + reach}) {
        for (const double z : {-reach, width + reach}) {
            b.place(column, along(kY, add(corner, {x, foot, z})), "IfcColumn",
                    fmt::format("Boiler {} column", unit.number));
        }
    }
    const ShapeId girder = b.shape(fmt::format("boiler girder {}", span),
                                   [&] { return i_section(span + 1, 1.25, 0.5, 0.03125, 0.0625); });
    const ShapeId cross_girder = b.shape(fmt::format("boiler cross girder {}", span), [&] {
        return i_section(span - 0.5 - 2 * g, 0.75, 0.375, 0.03125, 0.046875);
    });
    for (const double z : {-reach, width + reach}) {
        b.place(girder, at(add(corner, {-reach - 0.5, height + 0.625 + g, z})), "IfcBeam",
                fmt::format("Boiler {} top girder", unit.number));
    }
    for (int n = 0; n < 4; ++n) {
        const double x = on_grid(-reach + span * n / 3);
        b.place(cross_girder, along(kZ, add(corner, {x, height + 0.625 + g, -reach + 0.25 + g})),
                "IfcBeam", fmt::format("Boiler {} cross girder", unit.number));
    }
    // Tie beams between the columns at every storey.
    const double tie_length = span - 0.625 - 2 * g;
    const ShapeId tie = b.shape(fmt::format("boiler tie {}", tie_length), [&] {
        return i_section(tie_length, 0.375, 0.1875, 0.015625, 0.0234375);
    });
    for (double y = kStorey; y < unit.boiler_height(); y += kStorey) {
        const double first = -reach + 0.3125 + g;
        for (const double side : {-reach, width + reach}) {
            b.place(tie, at(add(corner, {first, y, side})), "IfcBeam",
                    fmt::format("Boiler {} tie", unit.number));
            b.place(tie, along(kZ, add(corner, {side, y, first})), "IfcBeam",
                    fmt::format("Boiler {} tie", unit.number));
        }
    }
}

void build_buckstays(PlantBuilder& b, const Unit& unit, const Vec3& corner, double width) {
    const double off = on_grid_above(kTube + b.gap + 0.15625);
    const ShapeId stay = b.shape(fmt::format("buckstay {}", width), [&] {
        return i_section(width - 0.25, 0.3125, 0.3125, 0.015625, 0.0234375);
    });
    for (double y = 3.5; y < unit.boiler_height(); y += 2.5) {
        for (const double side : {-off, width + off}) {
            b.place(stay, at(add(corner, {0.125, y, side})), "IfcBeam",
                    fmt::format("Boiler {} buckstay", unit.number));
            b.place(stay, along(kZ, add(corner, {side, y, 0.125})), "IfcBeam",
                    fmt::format("Boiler {} buckstay", unit.number));
        }
    }
}

/// Horizontal tubes in the gas pass behind the furnace.
void build_tube_bank(PlantBuilder& b, const Unit& unit, const Vec3& corner, double length,
                     double pitch) {
    const int columns = std::max(4, unit.wall_tubes / 4);
    const int sides = std::max(6, b.sides / 2);
    const ShapeId tube =
        b.shape(fmt::format("bank tube {}", length), [&] { return pipe(length, kTube, sides); });
    for (double low = 4; low + 2 < unit.boiler_height(); low += 5) {
        for (int row = 0; row < columns / 2; ++row) {
            for (int t = 0; t < columns; ++t) {
                b.place(tube, along(kZ, add(corner, {t * pitch, low + row * pitch, 0})),
                        "IfcPipeSegment",
                        fmt::format("Boiler {} bank tube {}.{}", unit.number, row + 1, t + 1));
            }
        }
    }
}

} // namespace

void build_boiler(PlantBuilder& b, const Unit& unit) {
    const double pitch = on_grid_above(2 * kTube + b.gap);
    const double width = unit.wall_tubes * pitch;
    const double z = on_grid((unit.bays_z * kBay - width) / 2);
    const Vec3 corner = add(unit.origin, {unit.boiler_x() + 2, 0, z});
    const double inset = on_grid_above(0.15625 + b.gap); // walls stay clear of each other's headers
    build_tube_wall(b, unit, add(corner, {0, 0, -inset}), kX, pitch, 'A');
    build_tube_wall(b, unit, add(corner, {0, 0, width + inset}), kX, pitch, 'B');
    build_tube_wall(b, unit, add(corner, {-inset, 0, 0}), kZ, pitch, 'C');
    build_tube_wall(b, unit, add(corner, {width + inset, 0, 0}), kZ, pitch, 'D');
    build_buckstays(b, unit, add(corner, {-inset, 0, -inset}), width + 2 * inset);
    build_boiler_frame(b, unit, corner, width);
    const double drum_length = width + 1;
    const double drum_radius = width > 4 ? 0.875 : 0.4375;
    const ShapeId drum = b.shape(fmt::format("steam drum {}", drum_length), [&] {
        return tank(drum_length, drum_radius, 0.375, 2 * b.sides, b.sides / 4);
    });
    b.place(drum, at(add(corner, {-0.5, unit.boiler_height() + 2.25, width / 2})), "IfcTank",
            fmt::format("Steam drum {}", unit.number));
    build_tube_bank(b, unit, add(corner, {width + 3.5, 0, 0}), width, pitch);
}

} // namespace abut::scenes
