#include "scenes/plant/plant_unit.h"

#include <cmath>
#include <fmt/format.h>

namespace abut::scenes {
namespace {

void build_column(PlantBuilder& b, const Unit& unit, int i, int k) {
    const double g = b.gap, foot = 0.0625;
    const Vec3 base = unit.in_bay(i, k, 0, 0, 0, 0);
    const std::string name =
        fmt::format("{}-{}{}", unit.number, static_cast<char>('A' + k % 26), i + 1);
    b.place(b.shape("footing", [] { return block(1.25, 0.5, 1.25); }),
            at(add(base, {0, -0.5 - g, 0})), "IfcFooting", "Footing " + name);
    b.place(b.shape("base plate", [&] { return block(0.625, foot, 0.625); }), at(base), "IfcPlate",
            "Base plate " + name);
    const double out = on_grid_above(0.3125 + g + 0.0225);
    const ShapeId anchor = b.shape("anchor", [] { return bolt(0.1875, 0.0205, false); });
    for (const double sx : {-1.0, 1.0}) {
        for (const double sz : {-1.0, 1.0}) {
            b.place(anchor, along(kY, add(base, {sx * out, 0, sz * 0.25})), "IfcMechanicalFastener",
                    "Anchor bolt M24 " + name);
        }
    }
    for (int f = 0; f < unit.floors; ++f) {
        const double low = f == 0 ? foot + g : f * kStorey + 1;
        const double high =
            f + 1 == unit.floors ? unit.floors * kStorey : (f + 1) * kStorey + 1 - g;
        const ShapeId piece = b.shape(fmt::format("column {}", high - low), [&] {
            return i_section(high - low, kColumn, kColumn, 0.015625, 0.03125);
        });
        b.place(piece, along(kY, add(base, {0, low, 0})), "IfcColumn",
                fmt::format("Column HEB360 {} storey {}", name, f + 1));
    }
}

void build_floor_beams(PlantBuilder& b, const Unit& unit, int f) {
    const double g = b.gap, back = on_grid(kColumn / 2 + g);
    const double length = kBay - 2 * back, joist_length = kBay - kBeamWidth - 2 * g;
    const ShapeId beam = b.shape(
        "floor beam", [&] { return i_section(length, kBeam, kBeamWidth, 0.015625, 0.0234375); });
    const ShapeId joist = b.shape(
        "joist", [&] { return i_section(joist_length, 0.3125, 0.15625, 0.0078125, 0.015625); });
    const double top = -kSlab - g;
    for (int i = 0; i <= unit.bays_x; ++i) {
        for (int k = 0; k <= unit.bays_z; ++k) {
            const std::string name = fmt::format("{}-{}-{}.{}", unit.number, f, i + 1, k + 1);
            if (i < unit.bays_x) {
                b.place(beam, at(unit.in_bay(i, k, f, back, top - kBeam / 2, 0)), "IfcBeam",
                        "Beam IPE500 x " + name);
            }
            if (k < unit.bays_z) {
                b.place(beam, along(kZ, unit.in_bay(i, k, f, 0, top - kBeam / 2, back)), "IfcBeam",
                        "Beam IPE500 z " + name);
            }
            if (i == unit.bays_x || k == unit.bays_z) {
                continue;
            }
            for (const double x : {2.6875, 5.3125}) {
                b.place(joist,
                        along(kZ, unit.in_bay(i, k, f, x, top - 0.15625, kBeamWidth / 2 + g)),
                        "IfcBeam", "Joist IPE300 " + name);
            }
        }
    }
}

/// A diagonal in a face of the frame. Its rotation is not a multiple of 90 degrees.
void build_brace(PlantBuilder& b, const Unit& unit, int f, const Vec3& foot, bool along_x,
                 bool rising) {
    const double run = kBay - 1.5, rise = kStorey - 1.75;
    const double length = std::sqrt(run * run + rise * rise);
    const double c = run / length, s = rise / length;
    const ShapeId brace =
        b.shape("brace", [&] { return hollow_section(length, 0.15625, 0.15625, 0.0078125); });
    const double turn_s = rising ? s : -s;
    const Vec3 x = along_x ? Vec3{c, turn_s, 0} : Vec3{0, turn_s, c};
    const Vec3 y = along_x ? Vec3{-turn_s, c, 0} : Vec3{0, c, -turn_s};
    const Vec3 start =
        add(foot, add(scaled(along_x ? kX : kZ, 0.75), {0, rising ? 0.5 : 0.5 + rise, 0}));
    b.place(brace, turned(x, y, start), "IfcMember",
            fmt::format("Brace SHS150 {}-{}", unit.number, f + 1));
}

} // namespace

void build_steel(PlantBuilder& b, const Unit& unit) {
    for (int i = 0; i <= unit.bays_x; ++i) {
        for (int k = 0; k <= unit.bays_z; ++k) {
            build_column(b, unit, i, k);
        }
    }
    for (int f = 1; f <= unit.floors; ++f) {
        build_floor_beams(b, unit, f);
    }
    for (int f = 0; f < unit.floors; ++f) {
        for (int i = 0; i < unit.bays_x; i += 3) {
            for (const int k : {0, unit.bays_z}) {
                build_brace(b, unit, f, unit.in_bay(i, k, f, 0, 0, 0), true, (i + f) % 2 == 0);
            }
        }
        for (int k = 0; k < unit.bays_z; k += 2) {
            for (const int i : {0, unit.bays_x}) {
                build_brace(b, unit, f, unit.in_bay(i, k, f, 0, 0, 0), false, (k + f) % 2 == 0);
            }
        }
    }
}

} // namespace abut::scenes
