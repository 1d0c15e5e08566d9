#include "clash/classify_by_id.h"

#include <utility>

namespace abut {

std::optional<Clash> classify_by_id(const ClashPart& a, std::string_view id_a, const ClashPart& b,
                                    std::string_view id_b, double clearance, double touch) {
    const bool exchanged = id_b < id_a;
    std::optional<Clash> clash =
        exchanged ? classify_pair(b, a, clearance, touch) : classify_pair(a, b, clearance, touch);
    if (!clash)
        return clash;
    // Negative zeros become positive, so that exchanging twice changes no bit.
    Vec3& d = clash->direction;
    d = {d.x + 0.0, d.y + 0.0, d.z + 0.0};
    if (exchanged)
        exchange_sides(*clash);
    return clash;
}

void exchange_sides(Clash& clash) {
    std::swap(clash.point_a, clash.point_b);
    Vec3& d = clash.direction;
    d = {0.0 - d.x, 0.0 - d.y, 0.0 - d.z};
}

} // namespace abut
