#include "session/session.h"

#include <utility>

/// The part of Session that decides what is drawn: sections, style and frame.
namespace abut::viewer {

namespace {

constexpr double kBoxMargin = 1;       ///< metres between a chosen part and a new section box
constexpr double kDetail = 0.5;        ///< RenderStyle::detail, metres
constexpr double kBelowFloors = 1e-4;  ///< of the diagonal: floors on the ground are before it
constexpr double kGroundReach = 2.5;   ///< of the diagonal
constexpr unsigned kRestingBudget = 6; ///< times the budgets of a moving picture
/// Pixels between exact distances; a picture that moves has to be quick.
constexpr std::uint32_t kStillGrid = 2, kMovingGrid = 8;

} // namespace

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

void Session::add_plane() {
    if (sections.size() == kMostPlanes)
        return;
    const Vec3 way = unit(forward());
    sections.push_back({-1.0 * way, -dot(way, eye()) - plane_distance});
    changed = true;
}

void Session::add_plane_across(int along) {
    if (sections.size() == kMostPlanes)
        return;
    const Vec3 way = axis(along);
    sections.push_back({way, dot(way, middle(view.bounds()))});
    changed = true;
}

void Session::toggle_box() {
    changed = true;
    box_is_of_clash_ = false;
    if (section_box) {
        section_box.reset();
        return;
    }
    const Box3 box = chosen ? box_of(*chosen) : view.bounds();
    const double margin = chosen ? kBoxMargin : 0;
    const Vec3 by{margin, margin, margin};
    section_box = Box3{box.lower - by, box.upper + by};
}

const ViewFrame& Session::frame(const Camera& camera, const Vec3& velocity, bool rests) {
    const ViewOptions options;
    if (rests || rested_)
        pace.forget_hidden(); // a picture at rest tells nothing about one that moves
    else
        pace.add_hidden(renderer.statistics().hidden_triangles);
    if (std::exchange(seen_jumps_, jumps) != jumps)
        pace.forget_hidden();
    rested_ = rests;
    if (rests)
        view.set_budgets(kRestingBudget * options.triangle_budget,
                         kRestingBudget * options.draw_budget);
    else
        view.set_budgets(pace.chosen(), options.draw_budget);
    // Ghosts, and what is cut away, hide nothing.
    view.set_occlusion(sections.empty() && !section_box && !renderer.has_ghosts());
    return view.frame(camera, velocity);
}

RenderStyle Session::style(bool still) const {
    RenderStyle style;
    style.up = up();
    style.edges = with_edges && (still || pace.with_lines());
    style.ambient_occlusion = with_occlusion && still;
    style.samples = still ? 2 : 1;
    style.leave_out_backs = style.quick = !still;
    style.sections = sections;
    style.section_box = section_box;
    style.detail = kDetail;
    style.distances = distances;
    if (style.distances)
        style.distances->grid = still ? kStillGrid : kMovingGrid;
    const Box3 bounds = view.bounds();
    if (with_ground && diagonal(bounds) > 0) {
        const double drop =
            dot(up(), middle(bounds) - bounds.lower) + kBelowFloors * diagonal(bounds);
        style.ground = Ground{middle(bounds) - drop * up(), kGroundReach * diagonal(bounds)};
    }
    return style;
}

} // namespace abut::viewer
