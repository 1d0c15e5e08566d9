#include <abut/model.h>
#include <abut/rigid.h>

#include "clash/viewpoint/choose_view.h"
#include "math/transform.h"
#include "math/vector.h"
#include "render/picture/framing.h"
#include "render/picture/picture_job.h"

#include <algorithm>

namespace abut {

namespace {

constexpr Colour kMarkColour{255, 214, 40};

/// The view of larger parts is chosen by their largest triangles.
constexpr std::size_t kMostTrialTriangles = 100'000;

/// The triangles of two parts in the world.
OwnedTriangles triangles_of(const PictureModel& model, const std::array<std::uint32_t, 2>& parts) {
    OwnedTriangles all;
    for (std::uint32_t side = 0; side < 2; ++side) {
        const PicturePart& part = model.parts[parts.at(side)];
        const std::shared_ptr<const Mesh> mesh = model.mesh(part.mesh);
        for (const std::array<std::uint32_t, 3>& corners : mesh->triangles) {
            Triangle placed;
            for (std::size_t i = 0; i < 3; ++i)
                placed.at(i) = apply(part.world_from_mesh, mesh->positions[corners.at(i)]);
            all.triangles.push_back(placed);
            all.owner.push_back(side);
        }
    }
    return all;
}

} // namespace

PictureScene PictureJob::aimed(const PairAim& aim) {
    std::array<std::uint32_t, 2> parts{};
    for (std::size_t i = 0; i < 2; ++i)
        parts.at(i) = find_part(model_, aim.file.at(i), aim.part.at(i));
    const PicturePart& a = model_.parts[parts[0]];
    const PicturePart& b = model_.parts[parts[1]];
    std::array<Vec3, 2> points;
    if (aim.points) {
        points = *aim.points;
    } else {
        const Gap gap = distance(Model(*model_.mesh(a.mesh)), a.world_from_mesh,
                                 Model(*model_.mesh(b.mesh)), b.world_from_mesh);
        points = {gap.point_a, gap.point_b};
    }
    const Box3 &box_a = a.view.box, &box_b = b.view.box;
    const double gap = length(points[1] - points[0]);
    const double reach = reach_of({points, {box_a, box_b}});
    ViewSubject subject;
    subject.middle = 0.5 * (points[0] + points[1]);
    subject.frame = grown({subject.middle, subject.middle}, reach);
    subject.geometry = triangles_of(model_, parts);
    keep_largest(subject.geometry, kMostTrialTriangles);
    for (const SectionPlane& plane : options_.sections)
        cut_to_plane(subject.geometry, plane.normal, plane.offset);
    if (options_.section_box)
        cut_to_box(subject.geometry, *options_.section_box);
    subject.side = {0, 1};
    for (std::uint32_t i = 0; i < model_.parts.size(); ++i)
        if (i != parts[0] && i != parts[1])
            subject.ghosts.push_back(model_.parts[i].view.box);

    ghost_all_but(parts);
    renderer_.set_state(parts[0], {.colour = kSideA});
    renderer_.set_state(parts[1], {.colour = kSideB});
    RenderStyle style = this->style(false);
    ChosenView view = choose_view(subject, model_.up, lens());
    if (std::min(view.shown[0], view.shown[1]) < kLeastShown) {
        const bool is_a_hidden =
            length(box_a.upper - box_a.lower) < length(box_b.upper - box_b.lower);
        const Opening opening = opening_before(normalized_or_zero(view.camera.forward),
                                               is_a_hidden ? box_a : box_b, subject.middle, reach);
        cut_to_plane(subject.geometry, opening.normal, opening.offset);
        subject.section = opening.normal;
        style.sections.push_back({opening.normal, opening.offset});
        view = choose_view(subject, model_.up, lens());
    }
    PictureScene scene{with_range(view.camera, model_.bounds), style, {}};
    if (gap > 0)
        scene.marks.push_back({points[0], points[1], kMarkColour, 4});
    for (const Vec3& point : points)
        scene.marks.push_back({point, point, kMarkColour, 9});
    return scene;
}

} // namespace abut
