#include "session.h"

#include "vec.h"

#include <chrono>
#include <numbers>

namespace abut::viewer {

namespace {

constexpr double kMostPitch = 1.5;
/// Where a person is put down: before and above the point that it looked at.
constexpr double kAway = 0.5, kAbove = 0.02;
constexpr double kFlyingRadius = 0.2; ///< of the ball around an eye that flies

Vec3 translation(const Transform& t) {
    return {t.m[9], t.m[10], t.m[11]};
}

ViewOptions view_options(const Session::Limits& limits) {
    ViewOptions options;
    options.memory = limits.memory / 2;
    options.gpu_memory = limits.gpu_memory;
    options.pixel_error = limits.pixel_error;
    return options;
}

} // namespace

Session::Session(const std::string& store_path, const Limits& limits, std::uint32_t width,
                 std::uint32_t height)
    : path(store_path), store(open_store(store_path)), view(store, view_options(limits)),
      walk(store, {.memory = limits.memory / 2}), renderer(view.parts().size(), view.origin()) {
    const Box3 bounds = view.bounds();
    lens.field_of_view = 1.1;
    resize(width, height);
    lens.far = std::max(100.0, 4 * diagonal(bounds));
    colour(ColourBy::material);
    make_walker(middle(bounds));
    look_at(bounds);
}

void Session::resize(std::uint32_t width, std::uint32_t height) {
    changed = true;
    lens.width = std::max(1U, width);
    lens.height = std::max(1U, height);
}

Vec3 Session::up() const {
    const UpAxis axis = view.up();
    return {axis == UpAxis::x ? 1.0 : 0, axis == UpAxis::y ? 1.0 : 0, axis == UpAxis::z ? 1.0 : 0};
}

Vec3 Session::forward() const {
    const Vec3 north = view.up() == UpAxis::z ? Vec3{0, 1, 0} : Vec3{0, 0, -1};
    const Vec3 east = cross(north, up());
    const Vec3 flat = std::cos(yaw) * north + std::sin(yaw) * east;
    return std::cos(pitch) * flat + std::sin(pitch) * up();
}

Vec3 Session::eye() const {
    return move == Move::orbit ? target - orbit_distance * forward() : walker->state().eye;
}

Camera Session::camera() const {
    Camera camera = lens;
    camera.eye = eye();
    camera.forward = forward();
    camera.up = up();
    return camera;
}

void Session::look(const Vec3& at, const Vec3& towards) {
    if (move == Move::walk)
        set_move(Move::fly); // there may be no room for a whole person
    const Vec3 way = unit(towards), north = view.up() == UpAxis::z ? Vec3{0, 1, 0} : Vec3{0, 0, -1};
    pitch = std::clamp(std::asin(std::clamp(dot(way, up()), -1.0, 1.0)), -kMostPitch, kMostPitch);
    const Vec3 flat = way - dot(way, up()) * up();
    if (length(flat) > 1e-6)
        yaw = std::atan2(dot(flat, cross(north, up())), dot(flat, north));
    const WalkerState& state = walker->state();
    walker->move_to(at - (dot(state.eye - state.feet, up())) * up());
    target = at + orbit_distance * forward();
}

void Session::look_at(const Box3& box) {
    const Vec3 north = view.up() == UpAxis::z ? Vec3{0, 1, 0} : Vec3{0, 0, -1};
    const Vec3 way = unit(0.8 * north + -0.6 * cross(north, up()) + -0.45 * up());
    const Camera seen = look_at_box(box, way, up(), lens);
    target = middle(box);
    orbit_distance = std::max(0.5, length(seen.eye - target));
    look(seen.eye, way);
}

void Session::turn(double right, double up_by) {
    yaw = std::remainder(yaw + right, 2 * std::numbers::pi);
    pitch = std::clamp(pitch + up_by, -kMostPitch, kMostPitch);
}

void Session::set_move(Move to) {
    if (to == move)
        return;
    if (to == Move::orbit) {
        const HitPart ahead = walk.first_hit({eye(), forward()});
        orbit_distance = ahead.meet ? std::max(0.5, length(ahead.point - eye())) : 10;
        target = eye() + orbit_distance * forward();
    } else if (move == Move::orbit) {
        look(eye(), forward());
    }
    const Vec3 at = eye();
    move = to;
    if (to != Move::orbit)
        make_walker(at);
    if (to == Move::walk)
        stand(at);
}

void Session::make_walker(const Vec3& at) {
    WalkerOptions options;
    options.up = view.up();
    options.except = carried_;
    if (move != Move::walk) {
        options.mode = WalkerMode::fly;
        options.radius = kFlyingRadius;
        options.height = options.ducked_height = 2 * kFlyingRadius;
        options.eye_height = options.ducked_eye_height = kFlyingRadius;
    }
    walker = std::make_unique<Walker>(walk, at - options.eye_height * up(), options);
}

void Session::set_carried(WalkPart part) {
    carried_ = part;
    walker->set_except(part);
}

void Session::stand(const Vec3& at) {
    if (const HitPart below = walk.first_hit({at, -1.0 * up()}); below.meet) {
        // The feet of an eye that flew low are not in the floor.
        if (dot(below.point - walker->state().feet, up()) > 0)
            walker->move_to(below.point + kAbove * up());
        return;
    }
    if (const HitPart ahead = walk.first_hit({at, forward()}); ahead.meet) {
        const Vec3 flat = unit(forward() - dot(forward(), up()) * up());
        walker->move_to(ahead.point - kAway * flat + kAbove * up());
        return;
    }
    const Box3 bounds = view.bounds();
    const Vec3 top = middle(bounds) + diagonal(bounds) * up();
    if (const HitPart below = walk.first_hit({top, -1.0 * up()}); below.meet)
        walker->move_to(below.point + kAbove * up());
}

void Session::step(const Wish& wish, double seconds) {
    const Vec3 ahead = forward(), aside = unit(cross(ahead, up()));
    const double rate = speed * (wish.fast ? 5 : 1);
    if (move == Move::orbit) {
        orbit_distance = std::max(0.05, orbit_distance * std::exp(-wish.forward * seconds));
        target = target + (rate * seconds) * (wish.right * aside + wish.up * up());
        walk.move_to(eye());
        return;
    }
    const Vec3 flat = move == Move::walk ? unit(ahead - dot(ahead, up()) * up()) : ahead;
    walker->step(rate * (wish.forward * flat + wish.right * aside + wish.up * up()), seconds,
                 wish.duck, wish.jump);
}

bool Session::is_cut(const Vec3& p) const {
    for (const SectionPlane& plane : sections)
        if (dot(plane.normal, p) > plane.offset)
            return true;
    if (!section_box)
        return false;
    const Vec3 &low = section_box->lower, &high = section_box->upper;
    return p.x < low.x || p.y < low.y || p.z < low.z || p.x > high.x || p.y > high.y ||
           p.z > high.z;
}

std::optional<Pick> Session::pick(double x, double y) {
    constexpr int kMostHits = 200;
    constexpr double kBehind = 1e-4;
    Ray ray = ray_through(camera(), x, y);
    for (int i = 0; i < kMostHits; ++i) {
        const HitPart hit = walk.first_hit(ray);
        const auto index = hit.meet ? view.index_of(hit.part.number) : std::nullopt;
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
        if (!chosen)
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

void Session::colour(ColourBy by) {
    colour_by = by;
    colours_ = part_colours(store, by);
    for (std::uint32_t i = 0; i < colours_.size(); ++i) {
        PartState coloured = state(i);
        coloured.colour = colours_[i];
        set_state(i, coloured);
    }
    changed = true;
}

void Session::ghost_all_but(const std::vector<std::uint32_t>& parts) {
    for (std::uint32_t i = 0; i < colours_.size(); ++i) {
        PartState ghost = state(i);
        ghost.colour = colours_[i];
        ghost.ghosted = !parts.empty() && std::find(parts.begin(), parts.end(), i) == parts.end();
        set_state(i, ghost);
    }
    changed = true;
}

PartState Session::state(std::uint32_t part) const {
    const auto found = moved.find(part);
    return renderer.state(found == moved.end() ? part : found->second.drawn);
}

void Session::set_state(std::uint32_t part, const PartState& state) {
    changed = true;
    if (const auto found = moved.find(part); found != moved.end()) {
        renderer.set_state(found->second.drawn, state);
        return;
    }
    const bool was_hidden = renderer.state(part).hidden;
    renderer.set_state(part, state);
    if (state.hidden != was_hidden)
        view.set_hidden(part, state.hidden);
}

Box3 Session::box_of(std::uint32_t part) {
    const Box3 box = view.part(part).box;
    const auto found = moved.find(part);
    if (found == moved.end())
        return box;
    const Vec3 by = translation(walk.world_from_part(WalkPart{view.parts()[part]})) -
                    found->second.start; // the window only shifts parts
    return {box.lower + by, box.upper + by};
}

void Session::draw_moved(std::uint32_t part) {
    const WalkPart number{view.parts()[part]};
    const Transform place = walk.world_from_part(number);
    changed = true;
    if (const auto found = moved.find(part); found != moved.end()) {
        renderer.move_part(found->second.drawn, place);
        return;
    }
    PartState shown = renderer.state(part);
    const std::uint32_t drawn = renderer.add_part(walk.model(number).mesh(), place, shown);
    shown.hidden = true;
    set_state(part, shown);
    moved.emplace(part, MovedPart{drawn, translation(place)});
}

bool Session::learn_ids(double seconds) {
    const auto start = std::chrono::steady_clock::now();
    const std::size_t parts = view.parts().size();
    while (ids_.size() < parts) {
        const auto next = static_cast<std::uint32_t>(ids_.size());
        const ViewPart part = view.part(next);
        ids_.emplace_back(part.file + '\n' + part.id, next);
        if (ids_.size() == parts)
            std::sort(ids_.begin(), ids_.end());
        if (std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() >
            seconds)
            break;
    }
    return ids_.size() == parts;
}

std::optional<std::uint32_t> Session::part_of(const std::string& file,
                                              const std::string& id) const {
    const auto at =
        std::lower_bound(ids_.begin(), ids_.end(), std::pair{file + '\n' + id, std::uint32_t{0}});
    if (ids_.size() < view.parts().size() || at == ids_.end() || at->first != file + '\n' + id)
        return std::nullopt;
    return at->second;
}

bool Session::show_clash(const ListedClash& clash) {
    const auto a = part_of(clash.file[0], clash.part[0]);
    const auto b = part_of(clash.file[1], clash.part[1]);
    if (!a || !b)
        return false;
    ghost_all_but({*a, *b});
    const auto paint = [&](std::uint32_t part, const Colour& colour) {
        PartState painted = state(part);
        painted.colour = colour;
        painted.hidden = false;
        set_state(part, painted);
    };
    paint(*a, {222, 62, 48});
    paint(*b, {52, 110, 214});
    const Box3 box_a = box_of(*a), box_b = box_of(*b);
    const Box3& small = diagonal(box_a) < diagonal(box_b) ? box_a : box_b;
    set_move(Move::orbit);
    look_at(small);
    return true;
}

void Session::add_plane() {
    if (sections.size() == kMostPlanes)
        return;
    const Vec3 way = unit(forward());
    sections.push_back({-1.0 * way, -dot(way, eye()) - 2});
    changed = true;
}

const ViewFrame& Session::frame(const Camera& camera, const Vec3& velocity, bool rests) {
    const ViewOptions options;
    if (rests)
        view.set_budgets(6 * options.triangle_budget, 6 * options.draw_budget);
    else
        view.set_budgets(pace.triangles(), options.draw_budget);
    // Ghosts, and what is cut away, hide nothing.
    view.set_occlusion(sections.empty() && !section_box && !renderer.has_ghosts());
    return view.frame(camera, velocity);
}

RenderStyle Session::style(bool still) const {
    RenderStyle style;
    style.up = up();
    style.edges = with_edges;
    style.ambient_occlusion = with_occlusion && still;
    style.samples = still ? 2 : 1;
    style.leave_out_backs = !still;
    style.sections = sections;
    style.section_box = section_box;
    style.detail = detail_;
    const Box3 bounds = view.bounds();
    if (with_ground && diagonal(bounds) > 0) {
        const double drop = dot(up(), middle(bounds) - bounds.lower) + 1e-4 * diagonal(bounds);
        style.ground = Ground{middle(bounds) - drop * up(), 2.5 * diagonal(bounds)};
    }
    return style;
}

} // namespace abut::viewer
