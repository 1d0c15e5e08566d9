#include "toolbox/tools.h"

namespace abut::viewer {

namespace {

constexpr Colour kNearColour{255, 170, 0}, kTouchColour{226, 48, 40}, kMeasureColour{0, 140, 255},
    kOutColour{40, 170, 70};
constexpr float kLineWidth = 3, kDotWidth = 8, kContactWidth = 10; ///< pixels
constexpr std::size_t kMostFound = 200;

void add_pair(Session& session, const Vec3& a, const Vec3& b, const Colour& colour) {
    session.marks.push_back({a, b, colour, kLineWidth});
    session.marks.push_back({a, a, colour, kDotWidth});
    session.marks.push_back({b, b, colour, kDotWidth});
}

/// Contacts in red with the way out in green, clearances in orange.
void add_carried(Session& session, const CarryStep& step) {
    for (const WalkGap& gap : step.touched) {
        add_pair(session, gap.point_part, gap.point_probe, kTouchColour);
        if (gap.distance < 0)
            session.marks.push_back({gap.point_probe,
                                     gap.point_probe + (-gap.distance) * gap.normal, kOutColour,
                                     kLineWidth});
    }
    for (const WalkGap& gap : step.near)
        add_pair(session, gap.point_part, gap.point_probe, kNearColour);
    for (const PartImpact& impact : step.contacts)
        session.marks.push_back(
            {impact.point_part, impact.point_part, kTouchColour, kContactWidth});
}

} // namespace

void Search::begin() {
    found.clear();
    next = 0;
    is_over = text[0] == '\0';
}

void Search::proceed(Session& session) {
    if (!is_over) {
        const FoundParts more =
            session.view.find_parts(text.data(), kMostFound - found.size(), next);
        found.insert(found.end(), more.parts.begin(), more.parts.end());
        next = more.next;
        is_over = more.next >= session.view.parts().size() || found.size() >= kMostFound;
    }
    if (!goes_to_first || (found.empty() && !is_over))
        return;
    goes_to_first = false;
    if (found.empty())
        return;
    session.choose(found.front());
    session.look_at(session.box_of(found.front()));
}

void Tools::update(Session& session, double seconds) {
    attempt([&] { viewpoints.update(session, seconds); });
    attempt([&] { carrying.update(session); });
    attempt([&] { clashes.update(session); });
    attempt([&] { search.proceed(session); });
}

void Tools::remove_part(Session& session, std::uint32_t part) {
    const std::string name = session.name(part);
    if (carrying.carry && carrying.part == part)
        carrying.remove(session);
    else
        session.remove(part);
    measure.forget_removed(session);
    message = name + " is removed from this walk";
}

void Tools::add_marks(Session& session) const {
    if (proximity.on && proximity.nearest)
        add_pair(session, proximity.nearest->point_part, proximity.nearest->point_probe,
                 proximity.nearest->distance > 0 ? kNearColour : kTouchColour);
    if (measure.has_ends)
        add_pair(session, measure.ends[0], measure.ends[1], kMeasureColour);
    for (const Pick& pick : measure.picks)
        session.marks.push_back({pick.point, pick.point, kMeasureColour, kDotWidth});
    if (carrying.carry)
        add_carried(session, carrying.carry->state());
}

} // namespace abut::viewer
