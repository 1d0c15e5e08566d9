#include "scenes/plant/plant_unit.h"

#include <algorithm>
#include <fmt/format.h>

namespace abut::scenes {
namespace {

/// Base, motor, coupling and casing in a row: separate parts, as in a model of a real plant.
void build_pump(PlantBuilder& b, const Vec3& foot, int size, const std::string& name) {
    const double s = size == 0 ? 0.75 : 1.25, g = b.gap;
    const auto key = [&](const char* what) { return fmt::format("pump {} {}", what, s); };
    b.place(b.shape(key("base"), [&] { return block(2 * s, 0.1875, 0.875 * s); }),
            at(add(foot, {0, g, 0})), "IfcBuildingElementProxy", name + " base");
    const double r = 0.3125 * s, axis = on_grid_above(0.1875 + 2 * g + 1.3 * r);
    const ShapeId motor = b.shape(key("motor"), [&] {
        return lathe({{0, 0.6 * r},
                      {0.125 * s, r},
                      {0.25 * s, r},
                      {0.25 * s, 1.125 * r},
                      {0.625 * s, 1.125 * r},
                      {0.625 * s, r},
                      {0.75 * s, r},
                      {0.75 * s, 0.25 * r},
                      {0.875 * s, 0.25 * r}},
                     b.sides);
    });
    b.place(motor, at(add(foot, {-s, axis, 0})), "IfcElectricMotor", name + " motor");
    const double coupling_x = on_grid(-0.125 * s + g);
    const ShapeId coupling =
        b.shape(key("coupling"), [&] { return pipe(0.125 * s, 0.4 * r, b.sides); });
    b.place(coupling, at(add(foot, {coupling_x, axis, 0})), "IfcDiscreteAccessory",
            name + " coupling");
    const double casing_x = on_grid(coupling_x + 0.125 * s + g);
    const ShapeId casing = b.shape(key("casing"), [&] {
        return lathe({{0, 0.25 * r},
                      {0.125 * s, 0.25 * r},
                      {0.125 * s, 1.25 * r},
                      {0.375 * s, 1.25 * r},
                      {0.4375 * s, 0.5 * r},
                      {0.625 * s, 0.5 * r},
                      {0.625 * s, 0.75 * r},
                      {0.6875 * s, 0.75 * r}},
                     b.sides);
    });
    b.place(casing, at(add(foot, {casing_x, axis, 0})), "IfcPump", name + " casing");
    const ShapeId nozzle = b.shape(key("nozzle"), [&] {
        return pipe(0.375 * s, 0.4 * r, b.sides, {0, 0.7 * r});
    });
    b.place(nozzle,
            along(kY, add(foot, {casing_x + 0.25 * s, on_grid_above(axis + 1.25 * r + g), 0})),
            "IfcPipeFitting", name + " discharge nozzle");
    const ShapeId bolt_shape =
        b.shape("foundation bolt", [] { return bolt(0.125, 0.0205, false); });
    for (const double x : {-0.75, -0.25, 0.25, 0.75}) {
        for (const double z : {-1.0, 1.0}) {
            b.place(bolt_shape,
                    along(kY, add(foot,
                                  {on_grid(x * s), g, z * on_grid_above(0.4375 * s + g + 0.0225)})),
                    "IfcMechanicalFastener", name + " foundation bolt");
        }
    }
}

void build_horizontal_tank(PlantBuilder& b, const Vec3& foot, double length, double radius,
                           const std::string& name) {
    const double g = b.gap, saddle = 0.75;
    const ShapeId support = b.shape(fmt::format("saddle {}", radius),
                                    [&] { return block(0.25, saddle, 1.5 * radius); });
    for (const double x : {0.25, 0.75}) {
        b.place(support, at(add(foot, {on_grid(length * (x - 0.5)), g, 0})), "IfcDiscreteAccessory",
                name + " saddle");
    }
    const ShapeId shell = b.shape(fmt::format("tank {} {}", length, radius), [&] {
        return tank(length, radius, radius / 2, 2 * b.sides, std::max(2, b.sides / 4));
    });
    b.place(shell, at(add(foot, {-length / 2, on_grid_above(saddle + 2 * g + radius), 0})),
            "IfcTank", name);
}

void build_vessel(PlantBuilder& b, const Vec3& foot, double height, const std::string& name) {
    const double g = b.gap, radius = 0.875, leg = 1;
    const ShapeId support = b.shape("vessel leg", [&] { return block(0.1875, leg, 0.1875); });
    for (const double x : {-0.5, 0.5}) {
        for (const double z : {-0.5, 0.5}) {
            b.place(support, at(add(foot, {x, g, z})), "IfcMember", name + " leg");
        }
    }
    const ShapeId shell = b.shape(fmt::format("vessel {}", height), [&] {
        std::vector<Point2> profile{{0, 0}};
        for (int k = 1; k <= 3; ++k) {
            const Point2 c = on_circle(k, 12);
            profile.push_back({0.4375 * (1 - c.u), radius * c.v});
        }
        const double top = height - 0.75, neck = 0.1875;
        for (const double y : {0.33, 0.66}) { // girth flanges
            profile.insert(profile.end(), {{height * y, radius},
                                           {height * y, radius + 0.0625},
                                           {height * y + 0.125, radius + 0.0625},
                                           {height * y + 0.125, radius}});
        }
        for (int k = 3; k > 0; --k) {
            const Point2 c = on_circle(k, 12);
            profile.push_back({top - 0.4375 * (1 - c.u), std::max(neck, radius * c.v)});
        }
        profile.insert(
            profile.end(),
            {{top, neck}, {height - 0.0625, neck}, {height - 0.0625, 0.3125}, {height, 0.3125}});
        return lathe(profile, 2 * b.sides);
    });
    b.place(shell, along(kY, add(foot, {0, leg + 2 * g, 0})), "IfcTank", name);
}

void build_cabinets(PlantBuilder& b, const Unit& unit, int i, int k, int f, double z) {
    const ShapeId cabinet = b.shape("cabinet", [] { return block(0.75, 2, 0.5); });
    const double step = on_grid_above(0.75 + b.gap);
    int n = 0;
    for (double x = 1.5; x < kBay - 1.25; x += step) {
        b.place(
            cabinet, at(unit.in_bay(i, k, f, x, b.gap, z)), "IfcElectricDistributionBoard",
            fmt::format("Switchgear {}-{}.{}.{} cubicle {}", unit.number, f, i + 1, k + 1, ++n));
    }
}

void furnish(PlantBuilder& b, const Unit& unit, int i, int k, int f) {
    const std::string place = fmt::format("{}-{}.{}.{}", unit.number, f, i + 1, k + 1);
    const double upper = b.random.chance(0.5) ? 2.75 : 4.75;
    switch (b.random.below(6)) {
    case 0:
        for (int n = 0; n < 3; ++n) {
            build_pump(b, unit.in_bay(i, k, f, 2.25 + 1.75 * n, 0, upper), 0,
                       fmt::format("Pump {}{}", place, n + 1));
        }
        break;
    case 1:
        for (int n = 0; n < 2; ++n) {
            build_pump(b, unit.in_bay(i, k, f, 2.5 + 3 * n, 0, upper), 1,
                       fmt::format("Feed pump {}{}", place, n + 1));
        }
        break;
    case 2:
        build_horizontal_tank(b, unit.in_bay(i, k, f, 4, 0, 4), 5, 0.875,
                              "Condensate tank " + place);
        break;
    case 3:
        for (const double z : {2.5, 4.75}) {
            build_horizontal_tank(b, unit.in_bay(i, k, f, 4, 0, z), 4, 0.4375,
                                  fmt::format("Heat exchanger {} z{}", place, z));
        }
        break;
    case 4:
        build_cabinets(b, unit, i, k, f, 2.25);
        build_cabinets(b, unit, i, k, f, 4.75);
        break;
    default:
        break; // an empty floor, with room for pipes
    }
}

} // namespace

void build_equipment(PlantBuilder& b, const Unit& unit) {
    for (int i = 0; i < unit.bays_x; ++i) {
        for (int k = 0; k < unit.bays_z; ++k) {
            const BayUse use = unit.use_of(i, k);
            if (use == BayUse::vessel) {
                const std::string name =
                    fmt::format("Column vessel {}.{}.{}", unit.number, i + 1, k + 1);
                build_vessel(b, unit.in_bay(i, k, 0, 4, 0, 4),
                             kStorey * std::min(unit.floors, 3) - 1.5, name);
                continue;
            }
            for (int f = 0; f < unit.floors; ++f) {
                if (use != BayUse::stairs) {
                    furnish(b, unit, i, k, f);
                }
            }
        }
    }
}

} // namespace abut::scenes
