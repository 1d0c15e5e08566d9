#include <abut/model.h>
#include <abut/rigid.h>

#include "math/vector.h"
#include "render/picture/framing.h"
#include "render/picture/picture_job.h"

#include <algorithm>
#include <cmath>

namespace abut {

namespace {

constexpr Colour kRed{222, 62, 48}, kBlue{52, 110, 214}, kMarkColour{255, 214, 40};

/// The side of the small pictures that are tried, in pixels.
constexpr std::uint32_t kTrialWidth = 160, kTrialHeight = 100;
/// A part that covers less than this fraction of a trial picture counts as not seen.
constexpr double kLeastSeen = 0.002;

double diagonal_of(const Box3& box) {
    return length(box.upper - box.lower);
}

/// Whether a segment meets a box, by its slabs.
bool crosses(const Vec3& from, const Vec3& to, const Box3& box) {
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

} // namespace

struct PictureJob::Sides {
    std::array<std::uint32_t, 2> part{};
    std::array<Vec3, 2> points;
    Box3 frame;     ///< what the picture is about
    Vec3 middle;    ///< between the points
    double reach{}; ///< half of the frame's side
};

PictureScene PictureJob::best_scene(const Sides& sides, const std::vector<SectionPlane>& sections,
                                    double& shown) {
    PictureScene best;
    double best_score = -1;
    for (const ViewDirection& direction : directions_around(model_.up)) {
        const Camera camera = fit_boxes(std::array{sides.frame}, direction, lens());
        PictureScene trial{with_range(camera, model_.bounds), style(false), {}};
        trial.style.sections.insert(trial.style.sections.end(), sections.begin(), sections.end());
        PictureScene small = trial;
        small.camera.width = kTrialWidth, small.camera.height = kTrialHeight;
        small.style.edges = small.style.ambient_occlusion = false;
        small.style.samples = 1;
        renderer_.begin(small.camera, small.style);
        stream_.visit(DrawnCamera(small.camera), opaque_,
                      [&](const ViewFrame& frame) { renderer_.add(frame); }, {});
        const std::vector<std::uint64_t> seen = renderer_.visible_samples(sides.part);
        const double all = kTrialWidth * kTrialHeight;
        const double least = static_cast<double>(std::min(seen[0], seen[1])) / all;
        double before = 0; // ghosts between the eye and the middle
        for (std::size_t i = 0; i < model_.parts.size(); ++i)
            before += !opaque_[i] && crosses(camera.eye, sides.middle, model_.parts[i].view.box);
        const auto more = static_cast<double>(std::max(seen[0], seen[1])) / all;
        double score = std::cbrt(least * least * more) / (1 + 0.15 * before);
        for (const SectionPlane& plane : sections) { // seen from the front rather than askew
            const double facing = std::max(0.0, -dot(plane.normal, direction.towards));
            score *= facing * facing;
        }
        if (score > best_score) {
            best_score = score;
            shown = least;
            best = trial;
        }
    }
    return best;
}

namespace {

/// A plane that is turned to the viewer, along an axis, and opens what hides a part or the middle.
SectionPlane opening(const Vec3& towards, const Box3& hidden, const Vec3& middle, double reach) {
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

} // namespace

PictureScene PictureJob::aimed(const PairAim& aim) {
    Sides sides;
    for (std::size_t i = 0; i < 2; ++i)
        sides.part.at(i) = find_part(model_, aim.file.at(i), aim.part.at(i));
    const PicturePart& a = model_.parts[sides.part[0]];
    const PicturePart& b = model_.parts[sides.part[1]];
    if (aim.points) {
        sides.points = *aim.points;
    } else {
        const Gap gap = distance(Model(*model_.mesh(a.mesh)), a.world_from_mesh,
                                 Model(*model_.mesh(b.mesh)), b.world_from_mesh);
        sides.points = {gap.point_a, gap.point_b};
    }
    sides.middle = 0.5 * (sides.points[0] + sides.points[1]);
    const Box3 &box_a = a.view.box, &box_b = b.view.box;
    const Box3 common{max(box_a.lower, box_b.lower), min(box_a.upper, box_b.upper)};
    const double whole = std::max(diagonal_of(box_a), diagonal_of(box_b));
    const double small = std::min(diagonal_of(box_a), diagonal_of(box_b));
    const double shared = overlap(box_a, box_b) ? diagonal_of(common) : 0;
    const double gap = length(sides.points[1] - sides.points[0]);
    sides.reach =
        std::min(std::max({0.6 * std::min(shared, small), 0.3 * small, 0.02 * whole, gap, 1e-9}),
                 0.6 * (whole + gap) + 1e-9);
    sides.frame = grown({sides.middle, sides.middle}, sides.reach);

    ghost_all_but(sides.part);
    renderer_.set_state(sides.part[0], {.colour = kRed});
    renderer_.set_state(sides.part[1], {.colour = kBlue});
    double shown = 0;
    PictureScene scene = best_scene(sides, {}, shown);
    if (shown < kLeastSeen) {
        const bool is_a_hidden = diagonal_of(box_a) < diagonal_of(box_b);
        const SectionPlane plane = opening(normalized_or_zero(scene.camera.forward),
                                           is_a_hidden ? box_a : box_b, sides.middle, sides.reach);
        scene = best_scene(sides, {plane}, shown);
    }
    if (gap > 0)
        scene.marks.push_back({sides.points[0], sides.points[1], kMarkColour, 4});
    for (const Vec3& point : sides.points)
        scene.marks.push_back({point, point, kMarkColour, 9});
    return scene;
}

} // namespace abut
