#include "clash/viewpoint/choose_view.h"

#include "clash/viewpoint/depth_picture.h"
#include "core/stop.h"
#include "view/camera/fit_camera.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace abut {

namespace {

/// Rows of the small pictures that are tried.
constexpr std::uint32_t kTrialHeight = 40;
constexpr std::uint32_t kLeastTrialWidth = 10, kMostTrialWidth = 160;
/// A part that covers fewer pixels than this is not seen.
constexpr std::uint64_t kLeastPixels = 2;
/// How much a ghost between the eye and the middle lowers the score.
constexpr double kGhostVeil = 0.15;

double diagonal_of_box(const Box3& box) {
    return length(box.upper - box.lower);
}

/// Returns whether a segment meets a box, by its slabs.
bool segment_crosses(const Vec3& from, const Vec3& to, const Box3& box) {
    double enter = 0, leave = 1;
    for (int axis = 0; axis < 3; ++axis) {
        const double start = component(from, axis), way = component(to, axis) - start;
        const double lower = component(box.lower, axis), upper = component(box.upper, axis);
        if (way == 0) {
            if (start < lower || start > upper)
                return false;
            continue;
        }
        const double a = (lower - start) / way, b = (upper - start) / way;
        enter = std::max(enter, std::min(a, b));
        leave = std::min(leave, std::max(a, b));
    }
    return enter <= leave;
}

/// The pixels that each part covers, and what follows from them.
class VisibleParts {
public:
    explicit VisibleParts(const ViewSubject& subject)
        : subject_(subject), pixels_(subject.side.size()) {}

    void count(std::span<const std::uint32_t> owners) {
        std::ranges::fill(pixels_, 0U);
        for (const std::uint32_t owner : owners)
            if (owner < pixels_.size())
                ++pixels_[owner];
        const auto all = static_cast<double>(owners.size());
        shown_ = {};
        std::size_t seen = 0;
        for (std::size_t i = 0; i < pixels_.size(); ++i) {
            shown_.at(subject_.side[i]) += static_cast<double>(pixels_[i]) / all;
            seen += pixels_[i] >= kLeastPixels ? 1 : 0;
        }
        fraction_ = static_cast<double>(seen) /
                    static_cast<double>(std::max<std::size_t>(1, pixels_.size()));
    }
    [[nodiscard]] const std::array<double, 2>& shown() const { return shown_; }
    [[nodiscard]] double score() const {
        const double least = std::min(shown_[0], shown_[1]), more = std::max(shown_[0], shown_[1]);
        return std::cbrt(least * least * more) * (0.25 + 0.75 * fraction_);
    }

private:
    const ViewSubject& subject_;
    std::vector<std::uint64_t> pixels_;
    std::array<double, 2> shown_{};
    double fraction_ = 0;
};

/// Appends the polygon that remains of a triangle where dot(normal, x) <= offset.
void append_cut(OwnedTriangles& kept, const Triangle& triangle, std::uint32_t owner,
                const Vec3& normal, double offset) {
    std::array<double, 3> beyond{};
    for (std::size_t i = 0; i < 3; ++i)
        beyond.at(i) = dot(normal, triangle.at(i)) - offset;
    std::array<Vec3, 4> corners{};
    std::size_t count = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t next = (i + 1) % 3;
        if (beyond.at(i) <= 0)
            corners.at(count++) = triangle.at(i);
        if ((beyond.at(i) <= 0) != (beyond.at(next) <= 0))
            corners.at(count++) =
                triangle.at(i) + (beyond.at(i) / (beyond.at(i) - beyond.at(next))) *
                                     (triangle.at(next) - triangle.at(i));
    }
    for (std::size_t i = 2; i < count; ++i) {
        kept.triangles.push_back({corners[0], corners.at(i - 1), corners.at(i)});
        kept.owner.push_back(owner);
    }
}

} // namespace

ChosenView choose_view(const ViewSubject& subject, UpAxis up, const Camera& lens) {
    const double aspect = static_cast<double>(lens.width) / lens.height;
    Camera trial = lens;
    trial.height = kTrialHeight;
    trial.width = static_cast<std::uint32_t>(std::clamp(
        std::round(aspect * kTrialHeight), double(kLeastTrialWidth), double(kMostTrialWidth)));
    DepthPicture picture(trial.width, trial.height);
    VisibleParts visible(subject);
    ChosenView best;
    double best_score = -1;
    for (const ViewDirection& direction : directions_around(up)) {
        poll_stop();
        const Camera camera = fit_boxes(std::array{subject.frame}, direction, trial);
        picture.begin(CameraFrame(camera));
        const OwnedTriangles& all = subject.geometry;
        for (std::size_t i = 0; i < all.triangles.size(); ++i)
            picture.draw(all.triangles[i], all.owner[i]);
        visible.count(picture.owners());
        double veils = 0;
        for (const Box3& ghost : subject.ghosts)
            veils += segment_crosses(camera.eye, subject.middle, ghost) ? 1 : 0;
        double score = visible.score() / (1 + kGhostVeil * veils);
        if (subject.section) { // seen from the front rather than askew
            const double facing = std::max(0.0, -dot(*subject.section, direction.towards));
            score *= facing * facing;
        }
        if (score > best_score) {
            best_score = score;
            best = {fit_boxes(std::array{subject.frame}, direction, lens), visible.shown()};
        }
    }
    return best;
}

void cut_to_plane(OwnedTriangles& geometry, const Vec3& normal, double offset) {
    OwnedTriangles kept;
    kept.triangles.reserve(geometry.triangles.size());
    kept.owner.reserve(geometry.triangles.size());
    for (std::size_t i = 0; i < geometry.triangles.size(); ++i)
        append_cut(kept, geometry.triangles[i], geometry.owner[i], normal, offset);
    geometry = std::move(kept);
}

void cut_to_box(OwnedTriangles& geometry, const Box3& box) {
    cut_to_plane(geometry, {1, 0, 0}, box.upper.x);
    cut_to_plane(geometry, {0, 1, 0}, box.upper.y);
    cut_to_plane(geometry, {0, 0, 1}, box.upper.z);
    cut_to_plane(geometry, {-1, 0, 0}, -box.lower.x);
    cut_to_plane(geometry, {0, -1, 0}, -box.lower.y);
    cut_to_plane(geometry, {0, 0, -1}, -box.lower.z);
}

void keep_largest(OwnedTriangles& geometry, std::size_t most) {
    const std::size_t count = geometry.triangles.size();
    if (count <= most)
        return;
    std::vector<double> area(count);
    for (std::size_t i = 0; i < count; ++i) {
        const Triangle& t = geometry.triangles[i];
        area[i] = length_sq(cross(t[1] - t[0], t[2] - t[0]));
    }
    std::vector<std::uint32_t> order(count);
    std::iota(order.begin(), order.end(), 0U);
    std::ranges::nth_element(order, order.begin() + static_cast<std::ptrdiff_t>(most),
                             [&](std::uint32_t i, std::uint32_t k) {
                                 return area[i] != area[k] ? area[i] > area[k] : i < k;
                             });
    order.resize(most);
    std::ranges::sort(order);
    OwnedTriangles kept;
    for (const std::uint32_t i : order) {
        kept.triangles.push_back(geometry.triangles[i]);
        kept.owner.push_back(geometry.owner[i]);
    }
    geometry = std::move(kept);
}

double reach_of(const PairPlace& pair) {
    const Box3 &a = pair.boxes[0], &b = pair.boxes[1];
    const Box3 common{max(a.lower, b.lower), min(a.upper, b.upper)};
    const double whole = std::max(diagonal_of_box(a), diagonal_of_box(b));
    const double small = std::min(diagonal_of_box(a), diagonal_of_box(b));
    const double shared = overlap(a, b) ? diagonal_of_box(common) : 0;
    const double gap = length(pair.points[1] - pair.points[0]);
    return std::min(std::max({0.6 * std::min(shared, small), 0.3 * small, 0.02 * whole, gap, 1e-9}),
                    0.6 * (whole + gap) + 1e-9);
}

Opening opening_before(const Vec3& towards, const Box3& hidden, const Vec3& middle, double reach) {
    Vec3 normal;
    const Vec3 back = -towards;
    const double most = max_abs(back);
    if (std::abs(back.x) == most)
        normal = {back.x > 0 ? 1.0 : -1.0, 0, 0};
    else if (std::abs(back.y) == most)
        normal = {0, back.y > 0 ? 1.0 : -1.0, 0};
    else
        normal = {0, 0, back.z > 0 ? 1.0 : -1.0};
    const Vec3 nearest{normal.x > 0 ? hidden.upper.x : hidden.lower.x,
                       normal.y > 0 ? hidden.upper.y : hidden.lower.y,
                       normal.z > 0 ? hidden.upper.z : hidden.lower.z};
    const double before = dot(normal, nearest) + 0.02 * reach;
    return {normal, std::min(before, dot(normal, middle) + 0.6 * reach)};
}

} // namespace abut
