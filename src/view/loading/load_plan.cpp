#include "view/loading/load_plan.h"

#include "math/vector.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace abut {

namespace {

/// Points of the predicted path, the present one included.
constexpr int kPathPoints = 5;
/// The pictures of the path are taken this much wider, for turns that are not foreseen.
constexpr double kWidening = 1.25;

/// Rotates v around an axis by its length in radians.
Vec3 rotated(const Vec3& v, const Vec3& rotation) {
    const double angle = length(rotation);
    if (!(angle > 0))
        return v;
    const Vec3 axis = (1 / angle) * rotation;
    return std::cos(angle) * v + std::sin(angle) * cross(axis, v) +
           ((1 - std::cos(angle)) * dot(axis, v)) * axis;
}

} // namespace

Camera predicted(const CameraMotion& motion, double seconds) {
    Camera camera = motion.camera;
    camera.eye = camera.eye + seconds * motion.velocity;
    const double angle = length(motion.turning) * seconds;
    // Nobody turns around and on: a fast turn is a glance to the side.
    const double most = 0.5 * std::numbers::pi;
    const double time = angle > most ? seconds * most / angle : seconds;
    const Vec3 rotation = time * motion.turning;
    camera.forward = rotated(camera.forward, rotation);
    camera.up = rotated(camera.up, rotation);
    return camera;
}

bool CameraMotion::differs(const CameraMotion& other, double seconds) const {
    const Camera &a = camera, &b = other.camera;
    if (a.field_of_view != b.field_of_view || a.width != b.width || a.height != b.height ||
        a.near != b.near || a.far != b.far)
        return true;
    const Camera a_end = predicted(*this, seconds), b_end = predicted(other, seconds);
    const double way = length(a_end.eye - a.eye);
    const double apart = std::max(length(a.eye - b.eye), length(a_end.eye - b_end.eye));
    if (apart > std::max(a.near, way / 8))
        return true;
    const auto turn = [](const Vec3& v, const Vec3& w) {
        return length(normalized_or_zero(v) - normalized_or_zero(w));
    };
    const double most = a.field_of_view / 16;
    return turn(a.forward, b.forward) > most || turn(a_end.forward, b_end.forward) > 2 * most;
}

LoadPlan::LoadPlan(const LevelTree& tree, const CameraMotion& motion, double look_ahead,
                   double pixel_error, std::uint64_t bytes)
    : items_(tree), pixel_error_(pixel_error), bytes_left_(bytes), is_planned_(tree.chunks.size()) {
    for (int i = 0; i < kPathPoints; ++i) {
        const Camera camera = predicted(motion, look_ahead * i / (kPathPoints - 1));
        if (!is_finite(camera.eye) || max_abs(camera.eye) > 1e18)
            continue; // too fast to predict
        ViewPoint point(camera, tree.origin);
        point.frustum =
            Frustum(CameraFrame(camera), camera.near, camera.far, tree.origin, kWidening);
        path_.push_back(point);
    }
    if (!tree.nodes.empty() && !path_.empty())
        heap_.push_back({{}, std::numeric_limits<float>::max(), true});
}

bool LoadPlan::is_seen(const LevelNode& node) const {
    return std::ranges::any_of(path_, [&](const ViewPoint& point) {
        return point.frustum.may_see(node.lower, node.upper);
    });
}

double LoadPlan::error_of(ViewItem item) const {
    const double error = items_.error(item);
    double most = 0;
    for (const ViewPoint& point : path_)
        most = std::max(most, point.pixels(error, items_.node(item),
                                           std::sqrt(distance_sq(items_.node(item), point.eye))));
    return most;
}

void LoadPlan::push_finer(const Step& step) {
    const bool has_chunk = items_.chunk(step.item) != kNoChunk;
    const double error = has_chunk ? error_of(step.item) : step.error;
    if (!items_.has_finer(step.item) || !(error > pixel_error_))
        return;
    const auto shown = static_cast<float>(std::min(error, double{step.error}));
    items_.for_each_finer(step.item, [&](ViewItem item) {
        // The levels of an instance have one box.
        const bool seen = step.is_seen && (item.level > 0 || is_seen(items_.node(item)));
        heap_.push_back({item, shown, seen});
        std::push_heap(heap_.begin(), heap_.end());
    });
}

std::optional<std::uint32_t> LoadPlan::next() {
    while (!heap_.empty()) {
        std::pop_heap(heap_.begin(), heap_.end());
        const Step step = heap_.back();
        heap_.pop_back();
        const std::uint32_t chunk = items_.chunk(step.item);
        const bool is_new = chunk != kNoChunk && !is_planned_[chunk];
        if (is_new) {
            const std::uint64_t bytes = items_.tree().chunks[chunk].bytes();
            if (bytes > bytes_left_) {
                heap_.clear();
                return std::nullopt;
            }
            bytes_left_ -= bytes;
            is_planned_[chunk] = true;
        }
        push_finer(step);
        if (is_new)
            return chunk;
    }
    return std::nullopt;
}

std::uint64_t LoadPlan::most_bytes(const LevelTree& tree) {
    // At most the leaves wait in the heap, which may have grown to twice their number.
    return 2 * tree.nodes.size() * sizeof(Step) + tree.chunks.size() / 8;
}

} // namespace abut
