#pragma once

#include <cstdint>

namespace abut::viewer {

/// The input of a person in one frame. Velocities are fractions of the speed.
struct Wish {
    double forward = 0, right = 0, up = 0;
    bool duck = false, jump = false, fast = false;
};

/// The actions of keys and of a gamepad's buttons.
enum class Action : std::uint8_t {
    walk,
    fly,
    orbit,
    go_to_chosen,
    go_to_name,
    choose_ahead,
    hide,
    show_all,
    ghosts,
    remove,
    measure,
    distances,
    take,
    carry_mode,
    turn_left,
    turn_right,
    turn_up,
    turn_down,
    tilt_left,
    tilt_right,
    straighten,
    farther,
    nearer,
    move_out,
    check_way,
    run_job,
    next_clash,
    mark_reviewed,
    mark_approved,
    clear_mark,
    write_note,
    section_plane,
    section_box,
    save_viewpoint,
    next_viewpoint,
    record,
    replay,
    picture,
    slower,
    faster,
    panels,
    help,
    escape,
};

} // namespace abut::viewer
