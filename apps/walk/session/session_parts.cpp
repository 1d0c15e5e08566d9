#include "session/session.h"

#include <chrono>

/// The parts of a session: which are chosen, coloured, hidden, moved, brought in or removed.
namespace abut::viewer {

namespace {

constexpr int kMostHits = 200;     ///< parts that are cut away or ghosts, before a pick gives up
constexpr double kBehind = 1e-4;   ///< metres behind such a part, where the pick goes on
constexpr double kNearestSeen = 1; ///< metres from the eye to the middle of a part brought in
constexpr double kAwayOfDiagonal = 1.2; ///< and at least this much of its diagonal
constexpr Colour kBroughtColour{120, 150, 190};
constexpr Colour kFirstOfClash{222, 62, 48}, kSecondOfClash{52, 110, 214};

Box3 box_around(const Mesh& mesh) {
    Box3 box;
    for (const auto& triangle : mesh.triangles)
        for (const std::uint32_t corner : triangle) {
            const Vec3& p = mesh.positions[corner];
            box.lower = {std::min(box.lower.x, p.x), std::min(box.lower.y, p.y),
                         std::min(box.lower.z, p.z)};
            box.upper = {std::max(box.upper.x, p.x), std::max(box.upper.y, p.y),
                         std::max(box.upper.z, p.z)};
        }
    return box;
}

} // namespace

std::optional<Pick> Session::pick(double x, double y) {
    Ray ray = ray_through(camera(), x, y);
    for (int i = 0; i < kMostHits; ++i) {
        const HitPart hit = walk.first_hit(ray);
        const auto index = hit.meet ? index_of(hit.part) : std::nullopt;
        if (!index)
            break;
        const PartState seen = state(*index);
        if (!seen.hidden && !seen.ghosted && !is_cut(hit.point))
            return Pick{*index, hit.point};
        ray.origin = hit.point + kBehind * unit(ray.direction);
    }
    return std::nullopt;
}

void Session::choose(std::optional<std::uint32_t> part) {
    const auto mark = [&](bool on) {
        if (!chosen || is_removed(*chosen))
            return;
        PartState marked = state(*chosen);
        marked.highlighted = on;
        set_state(*chosen, marked);
    };
    mark(false);
    chosen = part;
    mark(true);
    changed = true;
}

ViewPart Session::facts(std::uint32_t part) const {
    const auto found = brought.find(part);
    return found == brought.end() ? view.part(part) : found->second.facts;
}

std::string Session::name(std::uint32_t part) const {
    const ViewPart found = facts(part);
    return found.name.empty() ? found.id : found.name;
}

WalkPart Session::walk_part(std::uint32_t part) const {
    const auto found = brought.find(part);
    return found == brought.end() ? WalkPart{view.parts()[part]} : found->second.part;
}

std::optional<std::uint32_t> Session::index_of(WalkPart part) const {
    for (const auto& [index, each] : brought)
        if (each.part == part)
            return index;
    return view.index_of(part.number);
}

Box3 Session::box_of(std::uint32_t part) {
    const auto found = moved.find(part);
    return found == moved.end()
               ? view.part(part).box
               : viewer::moved(walk.world_from_part(walk_part(part)), found->second.box);
}

bool Session::is_removed(std::uint32_t part) const {
    return std::binary_search(removed_.begin(), removed_.end(), part);
}

std::vector<std::uint32_t> Session::all_parts() const {
    std::vector<std::uint32_t> all;
    for (std::uint32_t i = 0; i < view.parts().size(); ++i)
        if (!is_removed(i))
            all.push_back(i);
    for (const auto& [part, each] : brought)
        all.push_back(part);
    return all;
}

void Session::colour(ColourBy by) {
    colouring = part_colouring(store, by);
    colour_by = by;
    for (const std::uint32_t i : all_parts()) {
        PartState coloured = state(i);
        coloured.colour = colour_of(i);
        set_state(i, coloured);
    }
    changed = true;
}

Colour Session::colour_of(std::uint32_t part) const {
    const auto found = brought.find(part);
    return found == brought.end() ? colouring.colours[part] : found->second.colour;
}

void Session::ghost_all_but(const std::vector<std::uint32_t>& parts) {
    for (const std::uint32_t i : all_parts()) {
        PartState ghost = state(i);
        ghost.colour = colour_of(i);
        ghost.ghosted = !parts.empty() && std::find(parts.begin(), parts.end(), i) == parts.end();
        set_state(i, ghost);
    }
    changed = true;
}

void Session::ghost_all_but_group(std::uint32_t group) {
    for (const std::uint32_t i : all_parts()) {
        PartState ghost = state(i);
        ghost.ghosted = i >= colouring.groups.size() || colouring.groups[i] != group;
        set_state(i, ghost);
    }
    changed = true;
}

void Session::show_all() {
    for (const std::uint32_t i : all_parts()) {
        PartState shown = state(i);
        shown.hidden = shown.ghosted = false;
        shown.colour = colour_of(i);
        set_state(i, shown);
    }
    if (box_is_of_clash_)
        section_box.reset();
    box_is_of_clash_ = false;
    changed = true;
}

std::uint32_t Session::drawn_number(std::uint32_t part) const {
    const auto found = moved.find(part);
    return found == moved.end() ? part : found->second.number;
}

PartState Session::state(std::uint32_t part) const {
    return renderer.state(drawn_number(part));
}

void Session::set_state(std::uint32_t part, const PartState& state) {
    if (is_removed(part))
        return;
    const PartState before = this->state(part);
    if (before == state)
        return;
    changed = true;
    renderer.set_state(drawn_number(part), state);
    if (!moved.contains(part) && state.hidden != before.hidden)
        view.set_hidden(part, state.hidden);
}

void Session::draw_moved(std::uint32_t part) {
    const WalkPart number = walk_part(part);
    const Transform place = walk.world_from_part(number);
    changed = true;
    if (const auto found = moved.find(part); found != moved.end()) {
        renderer.move_part(found->second.number, place);
        return;
    }
    PartState shown = renderer.state(part);
    const Model model = walk.model(number);
    const std::uint32_t drawn = renderer.add_part(model.mesh(), place, shown);
    shown.hidden = true;
    set_state(part, shown);
    moved.emplace(part, DrawnPart{drawn, box_around(model.mesh())});
}

std::uint32_t Session::bring_in(const Mesh& mesh, const std::string& file,
                                const std::string& name) {
    const Box3 box = box_around(mesh);
    const double away = std::max(kNearestSeen, kAwayOfDiagonal * diagonal(box));
    Transform place;
    const Vec3 to = eye() + away * unit(forward()) - middle(box);
    place.m[9] = to.x, place.m[10] = to.y, place.m[11] = to.z; // NOLINT
    const WalkPart part = walk.add(Model(mesh), place);
    std::uint32_t number = 0;
    try {
        number = renderer.add_part(mesh, place, {.colour = kBroughtColour});
    } catch (...) {
        walk.remove(part);
        throw;
    }
    ViewPart facts{part.number, file, name, name, "", viewer::moved(place, box), kBroughtColour};
    brought.emplace(number, BroughtPart{part, std::move(facts), kBroughtColour});
    moved.emplace(number, DrawnPart{number, box});
    changed = true;
    return number;
}

void Session::remove(std::uint32_t part) {
    walk.remove(walk_part(part));
    if (chosen == part)
        choose(std::nullopt);
    if (const auto found = moved.find(part); found != moved.end()) {
        renderer.remove_part(found->second.number);
        moved.erase(found);
    }
    if (brought.erase(part) == 0) {
        PartState gone = renderer.state(part);
        gone.hidden = true;
        set_state(part, gone);
        removed_.insert(std::lower_bound(removed_.begin(), removed_.end(), part), part);
    }
    changed = true;
}

bool Session::learn_ids(double seconds) {
    const auto start = std::chrono::steady_clock::now();
    const auto parts = static_cast<std::uint32_t>(view.parts().size());
    if (ids_.empty())
        ids_.reserve(parts);
    while (next_id_ < parts) {
        const ViewPart part = view.part(next_id_);
        ids_.emplace(part.file + '\n' + part.id, next_id_++);
        if (std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() >
            seconds)
            break;
    }
    return next_id_ == parts;
}

std::optional<std::uint32_t> Session::part_of(const std::string& file,
                                              const std::string& id) const {
    const auto found = ids_.find(file + '\n' + id);
    return found == ids_.end() ? std::nullopt : std::optional(found->second);
}

std::optional<std::uint32_t> Session::find(const std::string& id_or_name) const {
    constexpr std::size_t kAtOnce = 1000;
    std::optional<std::uint32_t> named;
    for (std::uint32_t from = 0; from < view.parts().size();) {
        const FoundParts found = view.find_parts(id_or_name, kAtOnce, from);
        for (const std::uint32_t index : found.parts) {
            const ViewPart part = view.part(index);
            if (part.id == id_or_name)
                return index;
            if (!named && part.name == id_or_name)
                named = index;
        }
        from = found.next;
    }
    return named;
}

bool Session::show_clash(const ListedClash& clash, const ClashViewpoint& from) {
    const auto a = part_of(clash.file[0], clash.part[0]);
    const auto b = part_of(clash.file[1], clash.part[1]);
    if (!a || !b || is_removed(*a) || is_removed(*b))
        return false;
    ghost_all_but({*a, *b});
    const auto paint = [&](std::uint32_t part, const Colour& colour) {
        PartState painted = state(part);
        painted.colour = colour;
        painted.hidden = false;
        set_state(part, painted);
    };
    paint(*a, kFirstOfClash);
    paint(*b, kSecondOfClash);
    section_box = from.section_box;
    box_is_of_clash_ = true;
    // The eye looks at the middle of the box, but for the face that opens a part.
    const double distance = dot(middle(from.section_box) - from.eye, from.direction);
    look_around(from.eye + std::max(0.0, distance) * from.direction, from.eye);
    return true;
}

} // namespace abut::viewer
