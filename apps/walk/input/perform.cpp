#include "input/perform.h"

#include <fmt/format.h>
#include <numbers>

namespace abut::viewer {

namespace {

constexpr double kPush = 0.1;      ///< metres of a key
constexpr double kSpeedStep = 0.4; ///< of the logarithm

void write_picture(Session& session, Tools& tools) {
    const Camera camera = session.camera();
    const ViewFrame& frame = session.frame(camera);
    const std::string name = fmt::format("abut-walk-{}.png", ++tools.pictures);
    write_png(session.renderer.picture(frame, camera, session.style(true), session.marks), name);
    tools.message = name + " written";
}

void take_or_put_down(Session& session, Tools& tools) {
    if (tools.carrying.carry)
        tools.carrying.put_down(session);
    else if (session.chosen)
        tools.carrying.take(session, *session.chosen);
    else
        tools.message = "no part is chosen";
}

void check_way(Session& session, Tools& tools) {
    tools.carrying.check_way(session);
    const PathReport& report = *tools.carrying.report;
    tools.message = report.is_free()
                        ? fmt::format("the way of {:.2f} m is free", report.length)
                        : fmt::format("the way of {:.2f} m meets {} parts, first {}", report.length,
                                      report.contacts.size(),
                                      name_of(session, report.contacts.front().impact.part));
}

/// Turns and moves the part in the hand. Returns false if the action is another one.
bool perform_on_hand(Action action, Session& session, Tools& tools) {
    Carrying& carrying = tools.carrying;
    const double angle = carrying.turn_step * std::numbers::pi / 180;
    const Camera camera = session.camera();
    const Vec3 up = session.up(), forward = unit(camera.forward), right = unit(cross(forward, up));
    switch (action) {
    case Action::turn_left:
        carrying.turn(up, angle);
        return true;
    case Action::turn_right:
        carrying.turn(up, -angle);
        return true;
    case Action::turn_up:
        carrying.turn(right, angle);
        return true;
    case Action::turn_down:
        carrying.turn(right, -angle);
        return true;
    case Action::tilt_left:
        carrying.turn(forward, -angle);
        return true;
    case Action::tilt_right:
        carrying.turn(forward, angle);
        return true;
    case Action::straighten:
        if (carrying.carry)
            carrying.straighten();
        return true;
    case Action::farther:
        carrying.push(kPush);
        return true;
    case Action::nearer:
        carrying.push(-kPush);
        return true;
    case Action::move_out:
        if (carrying.carry && !carrying.move_out(session))
            tools.message = "it overlaps no part";
        return true;
    case Action::carry_mode:
        carrying.next_mode(session);
        return true;
    case Action::take:
        take_or_put_down(session, tools);
        return true;
    case Action::check_way:
        check_way(session, tools);
        return true;
    default:
        return false;
    }
}

bool perform_on_clashes(Action action, Session& session, Tools& tools) {
    ClashList& clashes = tools.clashes;
    switch (action) {
    case Action::run_job:
        clashes.run_job(session);
        return true;
    case Action::next_clash:
        clashes.show_next(session);
        return true;
    case Action::mark_reviewed:
        clashes.mark(session, ClashStatus::reviewed);
        return true;
    case Action::mark_approved:
        clashes.mark(session, ClashStatus::approved);
        return true;
    case Action::clear_mark:
        clashes.clear_mark(session);
        return true;
    case Action::write_note:
        tools.with_panels = tools.note_wants_keyboard = true;
        return true;
    default:
        return false;
    }
}

/// Performs the actions that need a chosen part.
bool perform_on_chosen(Action action, Session& session, Tools& tools) {
    if (action != Action::go_to_chosen && action != Action::ghosts && action != Action::hide &&
        action != Action::remove)
        return false;
    if (!session.chosen) {
        tools.message = "no part is chosen";
        return true;
    }
    const std::uint32_t chosen = *session.chosen;
    if (action == Action::go_to_chosen)
        session.look_at(session.box_of(chosen));
    if (action == Action::ghosts)
        session.ghost_all_but({chosen});
    if (action == Action::remove)
        tools.remove_part(session, chosen);
    if (action == Action::hide) {
        PartState state = session.state(chosen);
        state.hidden = true;
        session.set_state(chosen, state);
    }
    return true;
}

bool perform_on_viewpoints(Action action, Session& session, Tools& tools) {
    switch (action) {
    case Action::save_viewpoint:
        tools.viewpoints.save(session);
        return true;
    case Action::next_viewpoint:
        tools.viewpoints.visit_next(session);
        return true;
    case Action::record:
        tools.viewpoints.toggle_recording();
        return true;
    case Action::replay:
        tools.viewpoints.replay(session);
        return true;
    case Action::picture:
        write_picture(session, tools);
        return true;
    default:
        return false;
    }
}

void choose_ahead(Session& session) {
    const std::optional<Pick> ahead =
        session.pick(0.5 * session.lens.width, 0.5 * session.lens.height);
    session.choose(ahead ? std::optional(ahead->part) : std::nullopt);
}

/// The rest: how the person moves, and what is shown.
void perform_on_view(Action action, Session& session, Tools& tools) {
    switch (action) {
    case Action::walk:
        session.set_move(Move::walk);
        break;
    case Action::fly:
        session.set_move(Move::fly);
        break;
    case Action::orbit:
        session.set_move(Move::orbit);
        break;
    case Action::slower:
        session.change_speed(-kSpeedStep);
        break;
    case Action::faster:
        session.change_speed(kSpeedStep);
        break;
    case Action::choose_ahead:
        choose_ahead(session);
        break;
    case Action::go_to_name:
        tools.with_panels = tools.search.wants_keyboard = true;
        break;
    case Action::show_all:
        session.show_all();
        break;
    case Action::measure:
        tools.measure.next();
        break;
    case Action::distances:
        tools.proximity.colours = !tools.proximity.colours;
        if (tools.proximity.colours) // from the chosen part, or else from the person
            tools.proximity.of_chosen = session.chosen.has_value();
        break;
    case Action::section_plane:
        session.add_plane();
        break;
    case Action::section_box:
        session.toggle_box();
        break;
    case Action::panels:
        tools.with_panels = !tools.with_panels;
        break;
    case Action::help:
        tools.with_help = !tools.with_help;
        break;
    case Action::escape:
        tools.must_end = !session.chosen;
        session.choose(std::nullopt);
        break;
    default:
        break;
    }
}

/// The panel with the settings of what was begun.
Panel panel_of(Action action) {
    switch (action) {
    case Action::go_to_name:
        return Panel::parts;
    case Action::measure:
        return Panel::measure;
    case Action::take:
    case Action::carry_mode:
    case Action::check_way:
        return Panel::carry;
    case Action::run_job:
    case Action::next_clash:
    case Action::write_note:
        return Panel::clashes;
    case Action::section_plane:
    case Action::section_box:
        return Panel::sections;
    case Action::save_viewpoint:
    case Action::record:
        return Panel::viewpoints;
    default:
        return Panel::none;
    }
}

} // namespace

void perform(Action action, Session& session, Tools& tools) {
    session.changed = true;
    if (const Panel panel = panel_of(action); panel != Panel::none)
        tools.opens = panel;
    if (!perform_on_hand(action, session, tools) && !perform_on_clashes(action, session, tools) &&
        !perform_on_chosen(action, session, tools) &&
        !perform_on_viewpoints(action, session, tools))
        perform_on_view(action, session, tools);
}

} // namespace abut::viewer
