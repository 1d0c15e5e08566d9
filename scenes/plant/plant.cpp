#include "scenes/plant/plant.h"

#include <abut/error.h>

#include "scenes/plant/plant_distinct.h"
#include "scenes/plant/plant_unit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

namespace abut {
namespace {

using namespace scenes;

/// The size of a plant. Each step adds some 25 % more triangles; beyond the last step, each adds
/// one more unit.
struct Size {
    int bays_x, bays_z, floors, wall_tubes, storage_tanks;
    double rack_length, stack_height;
};
constexpr std::array kSizes{
    Size{1, 1, 1, 6, 1, 12, 20},    Size{1, 1, 2, 8, 1, 18, 24},   Size{2, 1, 2, 10, 1, 18, 24},
    Size{2, 2, 2, 16, 1, 30, 32},   Size{3, 2, 2, 20, 2, 36, 32},  Size{3, 2, 3, 28, 2, 48, 40},
    Size{4, 2, 3, 40, 3, 72, 48},   Size{4, 3, 3, 48, 3, 100, 56}, Size{5, 3, 3, 56, 4, 100, 56},
    Size{5, 3, 4, 60, 4, 100, 60},  Size{6, 3, 5, 64, 4, 100, 64}, Size{6, 4, 6, 72, 5, 100, 72},
    Size{8, 4, 6, 80, 6, 100, 80},  Size{8, 5, 7, 88, 6, 100, 90}, Size{10, 5, 8, 96, 6, 100, 100},
    Size{10, 6, 9, 96, 6, 100, 110}};
constexpr int kLargest = static_cast<int>(kSizes.size()) - 1;

std::vector<Unit> lay_out(int step, Random& random) {
    const Size& size = kSizes[static_cast<std::size_t>(std::min(step, kLargest))];
    const int count = 1 + std::max(0, step - kLargest);
    std::vector<Unit> units;
    for (int n = 0; n < count; ++n) {
        Unit unit;
        unit.number = n + 1;
        // Rows of four along x, spaced for the largest unit.
        const int column = n % 4, row = n / 4;
        unit.origin = {170.0 * column, 0, 110.0 * row};
        unit.bays_x = size.bays_x;
        unit.bays_z = size.bays_z;
        unit.floors = size.floors;
        unit.wall_tubes = size.wall_tubes;
        unit.storage_tanks = size.storage_tanks;
        unit.rack_length = size.rack_length;
        unit.stack_height = size.stack_height;
        const int bays = size.bays_x * size.bays_z;
        for (int bay = 0; bay < bays; ++bay) {
            const int draw = random.below(10);
            unit.use.push_back(draw < 5 ? BayUse::open : draw < 8 ? BayUse::shaft : BayUse::vessel);
        }
        unit.use[0] = BayUse::stairs; // front left: visible from the road
        if (unit.bays_x >= 5) {
            unit.use[static_cast<std::size_t>(bays - unit.bays_z)] = BayUse::stairs;
        }
        units.push_back(std::move(unit));
    }
    return units;
}

/// Builds everything except the pipe runs, which use the room and the triangles that are left.
void build_base(PlantBuilder& b, const std::vector<Unit>& units) {
    for (const Unit& unit : units) {
        build_steel(b, unit);
        build_floors(b, unit);
        build_stairs(b, unit);
        build_boiler(b, unit);
        build_rack(b, unit);
        build_yard(b, unit);
        build_cladding(b, unit);
        build_equipment(b, unit);
        build_services(b, unit);
    }
    plant_clashes(b, units, {0, ground_level(b), -60});
    const Box3 all = b.bounds();
    const double top = ground_level(b), edge = 4;
    const Box3 ground{{std::floor(all.lower.x) - edge, top - 0.25, std::floor(all.lower.z) - edge},
                      {std::ceil(all.upper.x) + edge, top, std::ceil(all.upper.z) + edge}};
    b.place(b.shape("ground", [&] { return box(ground); }), at({}), "IfcSlab", "Ground");
}

/// Adds pipe runs until the number of triangles is reached. Returns false if the plant has no more
/// room for them.
bool fill_with_pipes(PlantBuilder& b, const std::vector<Unit>& units) {
    const std::uint64_t target = b.options.triangles;
    int failures = 0, number = 1;
    while (b.triangles() + target / 200 < target) {
        const Unit& unit = units[static_cast<std::size_t>(number) % units.size()];
        if (lay_pipe_run(b, unit, number, target)) {
            failures = 0;
            ++number;
        } else if (++failures > 200) {
            return false;
        }
    }
    return true;
}

void check(const PlantOptions& options) {
    if (!(options.clearance >= 0 && options.clearance <= 0.25)) {
        throw Error(ErrorCode::bad_argument, "plant: the clearance must lie in [0, 0.25] m");
    }
    if (options.clashes < 0 || options.clashes > 1'000'000) {
        throw Error(ErrorCode::bad_argument,
                    "plant: the number of clashes must lie in [0, 1000000]");
    }
    if (options.triangles < 10'000 || options.triangles > 1'000'000'000) {
        throw Error(ErrorCode::bad_argument,
                    "plant: the number of triangles must lie in [10000, 1000000000]");
    }
}

} // namespace

Plant make_plant(const PlantOptions& options) {
    check(options);
    const int sides = options.triangles < 60'000      ? 8
                      : options.triangles < 1'500'000 ? 12
                      : options.triangles < 8'000'000 ? 16
                                                      : 20;
    const auto build = [&](int step) {
        auto b = std::make_unique<PlantBuilder>(options, sides);
        std::vector<Unit> units = lay_out(step, b->random);
        build_base(*b, units);
        return std::pair(std::move(b), std::move(units));
    };
    // The largest plant whose base leaves enough of the given triangles for pipes.
    const double share = 0.6 * static_cast<double>(options.triangles);
    int step = 0;
    auto plant = build(step);
    for (int next = 1; next > step;) {
        auto larger = build(next);
        if (static_cast<double>(larger.first->triangles()) > share) {
            next = step + (next - step) / 2;
            continue;
        }
        plant = std::move(larger);
        step = next;
        next = step + 1;
        if (step >= kLargest) { // larger plants grow by whole units: jump to the number that fits
            const double units = step - kLargest + 1;
            const double fit = share * units / static_cast<double>(plant.first->triangles());
            next = std::max(next, kLargest - 1 + static_cast<int>(fit));
        }
    }
    if (!fill_with_pipes(*plant.first, plant.second)) {
        const Box3 all = plant.first->bounds();
        fill_laydown_yard(*plant.first, 0, std::floor(all.lower.z) - 10, options.triangles);
    }
    Plant result = plant.first->finish();
    if (options.distinct)
        make_distinct(result);
    return result;
}

} // namespace abut
