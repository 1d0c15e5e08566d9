#include "view/walker/walker_data.h"

#include <algorithm>
#include <array>

namespace abut {

namespace {

/// Parts overlap at most this often while a body is pushed out of one after the other.
constexpr int kMostPushes = 8;
/// A part that is nearer than this share of the skin counts as overlapping: rounding does not tell
/// it from one that touches.
constexpr double kTouches = 0.01;

} // namespace

void WalkerData::settle() {
    if (push_out() || (!state_.waits && step_aside())) {
        must_settle_ = false;
        state_.squeezed = false;
        return;
    }
    if (state_.waits)
        return;
    choose_thin_body();
    state_.squeezed = true;
    state_.on_ground = false;
    rising_ = 0;
}

bool WalkerData::is_free_way(const Vec3& feet) {
    const Vec3 way = feet - state_.feet;
    if (way == Vec3{})
        return true;
    const HitPart through =
        person_.walk().first_hit({person_.middle(state_.feet), way, 0, 1}, person_.query());
    return !through.meet && through.complete;
}

/// Moves the body out of the parts that it overlaps, one after the other, by at most its width and
/// through nothing.
bool WalkerData::push_out() {
    const WalkerOptions& o = person_.options();
    Vec3 feet = state_.feet;
    for (int push = 0; push < kMostPushes; ++push) {
        const NearParts touched =
            person_.walk().within(body(), Pose{feet}, kTouches * o.skin, person_.query());
        if (!touched.complete) {
            state_.waits = true;
            return false;
        }
        if (touched.parts.empty()) {
            if (!is_free_way(feet))
                return false;
            arrive(feet);
            return true;
        }
        const auto deepest = std::ranges::min_element(touched.parts, {}, &WalkGap::distance);
        feet = feet + (o.skin - deepest->distance) * deepest->normal;
        if (deepest->normal == Vec3{} || length(feet - state_.feet) > 2 * o.radius)
            return false;
    }
    return false;
}

/// Looks around for the nearest place with room.
bool WalkerData::step_aside() {
    const Vec3& up = person_.up();
    const Vec3 x = perpendicular(up), y = cross(up, x);
    for (const double share : {0.25, 0.5, 1.0, 1.5, 2.0})
        for (const Vec3& side :
             {up, x, -x, y, -y, 0.7 * (x + y), 0.7 * (x - y), 0.7 * (y - x), -0.7 * (x + y), -up}) {
            const Vec3 feet = state_.feet + share * person_.options().radius * side;
            const double skin = kTouches * person_.options().skin;
            const NearestPart nearest = person_.walk().distance(body(), Pose{feet}, [&] {
                WalkQuery query = person_.query();
                query.upper_bound = skin;
                return query;
            }());
            if (!nearest.found && nearest.complete && is_free_way(feet)) {
                arrive(feet);
                return true;
            }
        }
    return false;
}

/// Chooses the thickest of the thin bodies that is free; the last one if none is.
void WalkerData::choose_thin_body() {
    const auto is_free = [&](std::size_t i, const Vec3& feet) {
        return person_.walk()
            .collide(person_.thin_bodies()[i], Pose{feet}, person_.query())
            .parts.empty();
    };
    const std::size_t last = person_.thin_bodies().size() - 1;
    for (thin_ = 0; thin_ < last; ++thin_)
        if (is_free(thin_, state_.feet))
            return;
    if (is_free(last, state_.feet))
        return;
    // The point lies on a surface.
    const double by = 0.1 * person_.options().skin;
    for (const Vec3& side : std::array<Vec3, 6>{
             {{by, 0, 0}, {-by, 0, 0}, {0, by, 0}, {0, -by, 0}, {0, 0, by}, {0, 0, -by}}})
        if (is_free(last, state_.feet + side)) {
            arrive(state_.feet + side);
            return;
        }
}

} // namespace abut
