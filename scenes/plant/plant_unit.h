#pragma once

#include "scenes/plant/plant_builder.h"

#include <cstdint>
#include <vector>

/// One generating unit of a plant, and the stages that build it. A plant is a row of them.
///
///     z  ^   building: bays_x by bays_z bays, `floors` storeys | boiler | stack
///        |   pipe rack along x
///        |   tank farm
///        +--> x
namespace abut::scenes {

inline constexpr double kBay = 8;
inline constexpr double kStorey = 5;
inline constexpr double kSlab = 0.1875;
inline constexpr double kColumn = 0.375; ///< depth of a column's section
inline constexpr double kBeam = 0.5;     ///< depth of a floor beam
inline constexpr double kBeamWidth = 0.25;
inline constexpr double kRackDepth = 5;   ///< of the pipe rack, in z
inline constexpr double kRackFront = -10; ///< z of its front columns

enum class BayUse : std::uint8_t { open, shaft, stairs, vessel };

struct Unit {
    int number = 1;
    Vec3 origin;
    int bays_x = 1, bays_z = 1, floors = 1;
    int wall_tubes = 8; ///< per wall of the boiler
    int storage_tanks = 1;
    double rack_length = 12;
    double stack_height = 20;
    std::vector<BayUse> use; ///< of bay (i, k) at index bays_z * i + k

    [[nodiscard]] BayUse use_of(int i, int k) const {
        return use[static_cast<std::size_t>(i * bays_z + k)];
    }
    /// A point relative to the corner of bay (i, k), with y as the height above floor `f`.
    [[nodiscard]] Vec3 in_bay(int i, int k, int f, double x, double y, double z) const {
        return add(origin, {i * kBay + x, f * kStorey + y, k * kBay + z});
    }
    [[nodiscard]] Vec3 in_bay(int i, int k, int f, const Vec3& p) const {
        return in_bay(i, k, f, p.x, p.y, p.z);
    }
    [[nodiscard]] double boiler_x() const { return bays_x * kBay + 4; }
    [[nodiscard]] double boiler_height() const { return floors * kStorey + 5; }
};

/// An opening in the slabs of a bay, relative to the bay's corner.
struct Opening {
    double x0, z0, x1, z1;
};
/// The openings of a bay's slab at floor `f`; none on the ground floor.
std::vector<Opening> openings(BayUse use, int f);

inline double ground_level(const PlantBuilder& b) {
    return -0.5 - 2 * b.gap;
}

void build_steel(PlantBuilder& b, const Unit& unit);
void build_floors(PlantBuilder& b, const Unit& unit);
void build_stairs(PlantBuilder& b, const Unit& unit);
void build_boiler(PlantBuilder& b, const Unit& unit);
void build_rack(PlantBuilder& b, const Unit& unit);
void build_yard(PlantBuilder& b, const Unit& unit);
void build_equipment(PlantBuilder& b, const Unit& unit);
void build_services(PlantBuilder& b, const Unit& unit);
void build_cladding(PlantBuilder& b, const Unit& unit);

/// Lays one pipe run through the room that is left. Stops at `limit` triangles. Returns false if
/// there was no room.
bool lay_pipe_run(PlantBuilder& b, const Unit& unit, int number, std::uint64_t limit);
/// Stores loose pipes and bolts in the laydown yard until `limit` triangles are reached, exactly or
/// nearly.
void fill_laydown_yard(PlantBuilder& b, double x, double z, std::uint64_t limit);

/// Plants the clashes of the options: in the building as long as it has room, else in rows at
/// `laydown`.
void plant_clashes(PlantBuilder& b, const std::vector<Unit>& units, const Vec3& laydown);

} // namespace abut::scenes
