#include "session.h"

#include "vec.h"

#include <chrono>
#include <numbers>

namespace abut::viewer {

namespace {

constexpr double kMostPitch = 1.5;

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
    WalkerOptions options;
    options.up = view.up();
    options.mode = WalkerMode::fly;
    walker = std::make_unique<Walker>(walk, middle(bounds), options);
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
        const HitPart ahead = walk.first_hit({eye(), forward()}, {.missing = MissingParts::skip});
        orbit_distance = ahead.meet ? std::max(0.5, length(ahead.point - eye())) : 10;
        target = eye() + orbit_distance * forward();
    } else if (move == Move::orbit) {
        look(eye(), forward());
    }
    move = to;
    walker->set_mode(to == Move::walk ? WalkerMode::walk : WalkerMode::fly);
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

std::optional<Pick> Session::pick(double x, double y) {
    const HitPart hit =
        walk.first_hit(ray_through(camera(), x, y), {.missing = MissingParts::skip});
    const auto index = hit.meet ? view.index_of(hit.part.number) : std::nullopt;
    if (!index)
        return std::nullopt;
    return Pick{*index, hit.point};
}

void Session::choose(std::optional<std::uint32_t> part) {
    changed = true;
    const auto mark = [&](bool on) {
        if (!chosen)
            return;
        PartState state = renderer.state(*chosen);
        state.highlighted = on;
        renderer.set_state(*chosen, state);
    };
    mark(false);
    chosen = part;
    mark(true);
}

void Session::colour(ColourBy by) {
    changed = true;
    colour_by = by;
    colours_ = part_colours(store, by);
    for (std::uint32_t i = 0; i < colours_.size(); ++i) {
        PartState state = renderer.state(i);
        state.colour = colours_[i];
        renderer.set_state(i, state);
    }
}

void Session::ghost_all_but(const std::vector<std::uint32_t>& parts) {
    changed = true;
    for (std::uint32_t i = 0; i < colours_.size(); ++i) {
        PartState state = renderer.state(i);
        state.colour = colours_[i];
        state.ghosted = !parts.empty() && std::find(parts.begin(), parts.end(), i) == parts.end();
        renderer.set_state(i, state);
    }
}

void Session::set_state(std::uint32_t part, const PartState& state) {
    changed = true;
    renderer.set_state(part, state);
    view.set_hidden(part, state.hidden);
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

void Session::show_clash(const ListedClash& clash) {
    const auto a = part_of(clash.file[0], clash.part[0]);
    const auto b = part_of(clash.file[1], clash.part[1]);
    if (!a || !b)
        return;
    ghost_all_but({*a, *b});
    PartState state;
    state.colour = {222, 62, 48};
    renderer.set_state(*a, state);
    state.colour = {52, 110, 214};
    renderer.set_state(*b, state);
    const Box3 box_a = view.part(*a).box, box_b = view.part(*b).box;
    const Box3& small = diagonal(box_a) < diagonal(box_b) ? box_a : box_b;
    set_move(Move::orbit);
    look_at(small);
}

RenderStyle Session::style(bool still) const {
    RenderStyle style;
    style.up = up();
    style.edges = with_edges;
    style.ambient_occlusion = with_occlusion && still;
    style.samples = still ? 2 : 1;
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
