#include "scenes/deforming/cloth.h"

#include "scenes/deforming/frame.h"
#include "scenes/deforming/surfaces.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace abut::scenes {

namespace {

constexpr int kSubsteps = 6;
constexpr int kIterations = 3;
constexpr int kImpactRounds = 8;
constexpr int kImpactSweeps = 3;
/// The part of a missing distance that one frame restores. Restoring all of it would fling the
/// cloth away.
constexpr double kRecovery = 0.25;
/// Length to which a tether stretches, relative to its length at rest.
constexpr double kTether = 1.03;
/// Inverse mass of a driven vertex: it is infinitely heavy.
constexpr double kDriven = 0;

} // namespace

Cloth::Cloth(Mesh mesh, const std::vector<bool>& driven, const ClothSettings& settings)
    : mesh_(std::move(mesh)), settings_(settings), positions_(mesh_.positions),
      velocities_(mesh_.positions.size()), surface_(mesh_) {
    for (const bool is_driven : driven)
        inverse_mass_.push_back(is_driven ? kDriven : 1);
    add_lengths();
    if (settings_.hangs)
        add_tethers();
    show();
}

void Cloth::show() {
    std::ranges::transform(positions_, mesh_.positions.begin(), on_float_grid);
}

void Cloth::add_length(std::uint32_t a, std::uint32_t b, double stiffness) {
    if (inverse_mass_[a] + inverse_mass_[b] > 0)
        lengths_.push_back({a, b, norm(subtract(positions_[a], positions_[b])), stiffness});
}

/// Makes every edge keep its length, and makes the two vertices opposite to each edge resist
/// folding.
void Cloth::add_lengths() {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> opposite;
    for (const auto& t : mesh_.triangles)
        for (std::size_t i = 0; i < 3; ++i) {
            const auto edge = std::minmax(t[i], t[(i + 1) % 3]);
            const std::uint32_t across = t[(i + 2) % 3];
            const auto [found, is_new] = opposite.try_emplace(edge, across);
            if (is_new)
                add_length(edge.first, edge.second, 1);
            else
                add_length(found->second, across, settings_.bending);
        }
}

/// Ties each vertex to the driven vertex that is the fewest edges away, and of those to the
/// nearest. Without tethers, the few iterations of a step cannot carry the weight of hanging cloth
/// from row to row.
void Cloth::add_tethers() {
    constexpr std::uint32_t kNone = ~std::uint32_t{0};
    const std::size_t count = positions_.size();
    std::vector<std::vector<std::uint32_t>> neighbours(count);
    for (const auto& [a, b] : surface_.edges()) {
        neighbours[a].push_back(b);
        neighbours[b].push_back(a);
    }
    std::vector<std::uint32_t> holder(count, kNone), order;
    std::vector<int> edges_away(count, 0);
    for (std::uint32_t v = 0; v < count; ++v)
        if (inverse_mass_[v] == kDriven) {
            holder[v] = v;
            order.push_back(v);
        }
    const auto distance = [&](std::uint32_t a, std::uint32_t b) {
        return norm(subtract(positions_[a], positions_[b]));
    };
    for (std::size_t i = 0; i < order.size(); ++i) {
        const std::uint32_t v = order[i];
        for (const std::uint32_t next : neighbours[v])
            if (holder[next] == kNone) {
                holder[next] = holder[v];
                edges_away[next] = edges_away[v] + 1;
                order.push_back(next);
            } else if (edges_away[next] == edges_away[v] + 1 &&
                       distance(next, holder[v]) < distance(next, holder[next])) {
                holder[next] = holder[v];
            }
    }
    for (const std::uint32_t v : order)
        if (inverse_mass_[v] != kDriven)
            tethers_.push_back({v, holder[v], kTether * distance(v, holder[v])});
}

void Cloth::step(std::span<const Vec3> driven_to) {
    start_ = positions_;
    find_near();
    for (int k = 0; k < kSubsteps; ++k)
        substep(driven_to, 1.0 / (kSubsteps - k));
    show();
    push_back_impacts();
}

void Cloth::find_near() {
    near_.clear();
    surface_.set_motion(start_, start_);
    for (const FeaturePair& pair : self_within(surface_, settings_.thickness)) {
        const auto contact = contact_of(surface_, pair, start_);
        if (contact)
            near_.push_back(
                {*contact, pair.distance + kRecovery * (settings_.thickness - pair.distance)});
    }
}

/// In: share, the part of the driven vertices' remaining way in this frame that this substep
/// covers.
void Cloth::substep(std::span<const Vec3> driven_to, double share) {
    constexpr double kSeconds = kFrameSeconds / kSubsteps;
    previous_ = positions_;
    const double kept = 1 - settings_.drag * kSeconds;
    for (std::size_t v = 0; v < positions_.size(); ++v) {
        if (inverse_mass_[v] == kDriven) {
            positions_[v] = mixed(positions_[v], driven_to[v], share);
            continue;
        }
        const Vec3 velocity =
            scaled(add(velocities_[v], scaled(settings_.gravity, kSeconds)), kept);
        positions_[v] = add(positions_[v], scaled(velocity, kSeconds));
    }
    for (int i = 0; i < kIterations; ++i) {
        keep_lengths();
        keep_tethers();
        keep_spacing();
    }
    for (std::size_t v = 0; v < positions_.size(); ++v)
        velocities_[v] = scaled(subtract(positions_[v], previous_[v]), 1 / kSeconds);
}

void Cloth::keep_lengths() {
    for (const Length& each : lengths_) {
        const Vec3 between = subtract(positions_[each.a], positions_[each.b]);
        const double length = norm(between);
        if (length == 0)
            continue;
        const double a = inverse_mass_[each.a], b = inverse_mass_[each.b];
        const Vec3 excess =
            scaled(between, each.stiffness * (length - each.rest) / (length * (a + b)));
        positions_[each.a] = subtract(positions_[each.a], scaled(excess, a));
        positions_[each.b] = add(positions_[each.b], scaled(excess, b));
    }
}

void Cloth::keep_tethers() {
    for (const Tether& each : tethers_) {
        const Vec3 away = subtract(positions_[each.vertex], positions_[each.holder]);
        const double length = norm(away);
        if (length > each.most)
            positions_[each.vertex] =
                add(positions_[each.holder], scaled(away, each.most / length));
    }
}

void Cloth::keep_spacing() {
    for (const Spacing& each : near_) {
        const double pushed = push(each.contact, each.least);
        if (pushed > 0)
            rub(each.contact, pushed);
    }
}

/// Widens the contact to at least `least` along its normal. Returns by how much it was widened.
double Cloth::push(const Contact& contact, double least) {
    const double missing = least - dot(contact.normal, contact.offset(positions_));
    if (missing <= 0)
        return 0;
    shift(contact, scaled(contact.normal, missing));
    return missing;
}

/// Friction: undoes the features' sliding in this substep, as far as the push allows.
void Cloth::rub(const Contact& contact, double push) {
    const Vec3 moved = subtract(contact.offset(positions_), contact.offset(previous_));
    const Vec3 slid = subtract(moved, scaled(contact.normal, dot(contact.normal, moved)));
    const double length = norm(slid);
    if (length > 0)
        shift(contact, scaled(slid, -std::min(1.0, settings_.friction * push / length)));
}

/// Moves the vertices, lighter ones farther, until the contact's offset has changed by `by`.
void Cloth::shift(const Contact& contact, const Vec3& by) {
    double mobility = 0;
    for (std::size_t i = 0; i < 4; ++i)
        mobility += contact.weights[i] * contact.weights[i] * inverse_mass_[contact.vertices[i]];
    if (mobility == 0)
        return;
    for (std::size_t i = 0; i < 4; ++i) {
        const std::uint32_t v = contact.vertices[i];
        const double share = contact.weights[i] * inverse_mass_[v] / mobility;
        positions_[v] = add(positions_[v], scaled(by, share));
    }
}

void Cloth::push_back_impacts() {
    previous_ = positions_;
    for (int round = 0; round < kImpactRounds; ++round) {
        surface_.set_motion(start_, positions_);
        std::vector<Contact> contacts;
        for (const FeatureImpact& impact : self_impacts(surface_).list)
            if (const auto contact = contact_of(surface_, impact))
                contacts.push_back(*contact);
        if (contacts.empty())
            break;
        for (int sweep = 0; sweep < kImpactSweeps; ++sweep)
            for (const Contact& contact : contacts)
                push(contact, settings_.thickness / 2);
    }
    for (std::size_t v = 0; v < velocities_.size(); ++v)
        velocities_[v] =
            add(velocities_[v], scaled(subtract(positions_[v], previous_[v]), 1 / kFrameSeconds));
}

} // namespace abut::scenes
