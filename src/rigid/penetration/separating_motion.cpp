#include "rigid/penetration/separating_motion.h"

#include "geometry/triangle_triangle_penetration.h"

#include <algorithm>
#include <vector>

namespace abut {

namespace {

constexpr double kTight = 0x1p-24; // 1/16 of a millionth

std::vector<Vec3> directions(const WorldSolid& a, const WorldSolid& b,
                             std::span<const Contact> contacts) {
    constexpr std::size_t kContacts = 64;
    struct Direction {
        Vec3 d;
        int count;
    };
    std::vector<Direction> separating;
    Vec3 mean;
    const std::size_t count = std::min(kContacts, contacts.size());
    for (std::size_t i = 0; i < count; ++i) {
        const Contact& c = contacts[i * contacts.size() / count];
        const Vec3 d =
            triangle_triangle_penetration(a.world_triangle(c.pair.a), b.world_triangle(c.pair.b))
                .direction;
        mean = mean + d;
        const auto same = std::find_if(separating.begin(), separating.end(),
                                       [&](const Direction& e) { return dot(d, e.d) > 1 - 1e-6; });
        if (same != separating.end())
            ++same->count;
        else
            separating.push_back({d, 1});
    }
    std::stable_sort(separating.begin(), separating.end(),
                     [](const Direction& d, const Direction& e) { return d.count > e.count; });
    std::vector<Vec3> result;
    result.reserve(separating.size() + 28);
    for (const Direction& d : separating)
        result.push_back(d.d);
    result.insert(result.begin() + (result.empty() ? 0 : 1), normalized_or_zero(mean));
    for (int x = -1; x <= 1; ++x)
        for (int y = -1; y <= 1; ++y)
            for (int z = -1; z <= 1; ++z)
                result.push_back(normalized_or_zero({double(x), double(y), double(z)}));
    std::erase(result, Vec3{});
    return result;
}

bool parted(const WorldSolid& a, const WorldSolid& b, const Vec3& shift) {
    Counters unused;
    bool apart = true;
    for_each_block_pair(
        a, b, shift, [&](const WorldSolid::Block& of_a, const WorldSolid::Block& of_b) {
            const PlacedPair pair(of_a.model.model(), of_a.model.world(), of_b.model.model(),
                                  translated(of_b.model.world(), shift));
            apart = find_contacts(pair, ContactMode::first, unused).empty();
            return apart;
        });
    return apart;
}

} // namespace

Vec3 nudge_that_parts(const WorldSolid& a, const WorldSolid& b, std::span<const Contact> contacts) {
    const double nudge = kNudge * std::max(a.world_size(), b.world_size());
    for (const Vec3& d : directions(a, b, contacts))
        if (parted(a, b, nudge * d))
            return d;
    return {};
}

SeparatingMotion find_separating_motion(const WorldSolid& a, const WorldSolid& b,
                                        std::span<const Contact> contacts) {
    const double size = a.world_size() + b.world_size();
    SeparatingMotion best;
    for (const Vec3& d : directions(a, b, contacts)) {
        if (best.length > 0 && !parted(a, b, best.length * d))
            continue;
        double short_of = 0, enough = best.length > 0 ? best.length : kNudge * size;
        while (best.length == 0 && enough <= size && !parted(a, b, enough * d)) {
            short_of = enough;
            enough *= 2;
        }
        if (enough > size)
            continue;
        while (enough - short_of > kTight * enough) {
            const double middle = 0.5 * (short_of + enough);
            (parted(a, b, middle * d) ? enough : short_of) = middle;
        }
        best = {enough, d};
    }
    return best;
}

} // namespace abut
