#include "toolbox/measure.h"

namespace abut::viewer {

void Measure::clear() {
    picks.clear();
    result.clear();
    has_ends = false;
}

void Measure::next() {
    clear();
    if (!on) {
        on = true;
        kind = Measured::parts;
    } else if (kind == Measured::points) {
        on = false;
    } else {
        kind = kind == Measured::parts ? Measured::point_part : Measured::points;
    }
}

void Measure::forget_removed(const Session& session) {
    for (const Pick& pick : picks)
        if (session.is_removed(pick.part) ||
            (pick.part >= session.view.parts().size() && !session.brought.contains(pick.part))) {
            clear();
            return;
        }
}

void Measure::take(Session& session, const Pick& pick) {
    if (picks.size() == 2)
        clear();
    picks.push_back(pick);
    if (picks.size() < 2)
        return;
    const auto place = [&](const Pick& each) {
        return PartPoint{session.walk_part(each.part), each.point};
    };
    const Measurement measured =
        viewer::measure(session.walk, kind, place(picks[0]), place(picks[1]));
    result = measured.text;
    ends = measured.ends;
    has_ends = true;
}

} // namespace abut::viewer
