#include "scenes/plant/plant_unit.h"

#include <fmt/format.h>

namespace abut::scenes {
namespace {

/// A cable tray along x under the ceiling of a row of bays, with its cables.
void build_tray_line(PlantBuilder& b, const Unit& unit, int k, int f) {
    constexpr double kLength = 4, kWidth = 0.5, kHeight = 0.125, kCable = 0.015625;
    const double g = b.gap, y = kStorey - 1.1875;
    const ShapeId trough = b.shape("tray", [&] { return tray(kLength - g, kWidth, kHeight); });
    const ShapeId cable = b.shape("cable", [&] { return pipe(kLength - g, kCable, 6); });
    for (int n = 0; n < unit.bays_x * 2; ++n) {
        const Vec3 start = unit.in_bay(0, k, f, n * kLength, y, 2.25);
        const std::string name = fmt::format("{}-{}.{} piece {}", unit.number, f, k + 1, n + 1);
        b.place(trough, at(start), "IfcCableCarrierSegment", "Cable tray " + name);
        for (const double z : {-1.0, 0.0, 1.0}) {
            b.place(cable,
                    at(add(start, {0, on_grid_above(g + kCable), on_grid(z * (g + 2 * kCable))})),
                    "IfcCableSegment", "Cable " + name);
        }
    }
}

/// A ventilation duct along z, with stiffening collars.
void build_duct_line(PlantBuilder& b, const Unit& unit, int i, int f) {
    constexpr double kLength = 4, kHeight = 0.5, kWidth = 0.875;
    const double g = b.gap, y = kStorey - 1.875;
    const ShapeId piece =
        b.shape("duct", [&] { return duct(kLength - 0.0625 - 2 * g, kHeight, kWidth); });
    const ShapeId collar = b.shape("duct collar", [&] {
        return hollow_section(0.0625, kHeight + 0.125, kWidth + 0.125, 0.0625);
    });
    for (int n = 0; n < unit.bays_z * 2; ++n) {
        const Vec3 start = unit.in_bay(i, 0, f, 4, y, n * kLength);
        const std::string name = fmt::format("{}-{}.{} piece {}", unit.number, f, i + 1, n + 1);
        b.place(piece, along(kZ, start), "IfcDuctSegment", "Duct " + name);
        b.place(collar, along(kZ, add(start, {0, 0, kLength - 0.0625 - g})), "IfcDuctFitting",
                "Duct collar " + name);
    }
}

} // namespace

void build_services(PlantBuilder& b, const Unit& unit) {
    for (int f = 0; f < unit.floors; ++f) {
        for (int k = 0; k < unit.bays_z; ++k) {
            build_tray_line(b, unit, k, f);
        }
        for (int i = f % 2; i < unit.bays_x; i += 2) {
            build_duct_line(b, unit, i, f);
        }
    }
}

void build_cladding(PlantBuilder& b, const Unit& unit) {
    const double g = b.gap, off = on_grid_above(0.625 + g + 0.125);
    const ShapeId panel =
        b.shape("cladding", [&] { return cladding(kStorey - g, kBay - g, 0.125, 8 + b.sides); });
    const std::string name = fmt::format("Cladding {}", unit.number);
    for (int f = 0; f < unit.floors; ++f) {
        for (int i = 0; i < unit.bays_x; ++i) { // the rear; the front stays open to view
            const Vec3 low = unit.in_bay(i, unit.bays_z, f, kBay - g, 0, off);
            b.place(panel, turned(kY, kZ, add(low, {-(kBay - g), 0, 0})), "IfcPlate", name);
        }
        for (int k = 0; k < unit.bays_z && f > 0; ++k) {
            const Vec3 low = unit.in_bay(unit.bays_x, k, f, off, 0, 0);
            b.place(panel, turned(kY, scaled(kX, -1), low), "IfcPlate", name);
        }
    }
}

} // namespace abut::scenes
