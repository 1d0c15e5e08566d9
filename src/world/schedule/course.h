#pragma once

#include <abut/types.h>
#include <abut/world.h>

#include "world/narrow_phase/world_data.h"
#include "world/schedule/closing_time.h"

#include <array>
#include <cstdint>

namespace abut {

/// The known motion of a body: its bounds, and its place at the time that they refer to.
struct Course {
    double since = 0;
    Vec3 origin;
    std::array<double, 9> linear{}; ///< of the body's transform
    double seen = 0;                ///< when the body was last found on its course
    Vec3 seen_origin;
    std::array<double, 9> seen_linear{};
    SpeedBounds bounds;
    double speed = 0;            ///< bound of a further velocity at the time `since`
    double reach = -1;           ///< no point of the body is farther from its origin; -1: not begun
    std::uint64_t placement = 0; ///< of the body at the time `since`
    std::uint32_t generation = 0, shape_version = 0;
    bool rests = true;     ///< the bounds allow no motion
    bool known = false;    ///< false: the body's pairs must be tested
    bool reshaped = false; ///< true: what is remembered of the body's pairs is void
};

/// Bounds of a body's motion from a later time on, as they follow from its course.
struct CourseNow {
    Vec3 velocity, acceleration;
    double speed = 0; ///< bound of a further velocity
    double acceleration_bound = 0;
    TurnBounds turn;
};

/// Lets the course begin anew at the body's current place. It notices a body with another shape.
void begin_course(Course& course, const Body& body, double now);
/// Whether the body is where its course allows it to be, and has come there from where it was last
/// seen as the course allows. In: same generation.
bool keeps_course(const Course& course, const Body& body, double now);
/// Returns true only if the body's course allows no motion and the body has not been moved.
inline bool stays(const Course& course, const Body& body) {
    return course.known && course.rests && course.placement == body.placement;
}
/// Notes the body's place. Needless while the motion is known exactly. In: the body keeps its course.
void note_place(Course& course, const Body& body, double now);
/// Whether bounds that are told now allow no motion that the course does not allow. In: the body
/// keeps its course.
bool follows(const Course& course, const SpeedBounds& bounds, double now);
/// Whether bounds that follow from the course are those of the course, which does not widen with
/// time. The course may then go on, so that tolerated rounding does not add up from call to call.
bool repeats(const Course& course, const SpeedBounds& bounds);
CourseNow course_at(const Course& course, double now);
/// Whether the body's motion is known exactly.
bool is_prescribed(const CourseNow& course);
bool is_prescribed(const Course& course);
RelativeMotion relative_motion(const CourseNow& a, const CourseNow& b);
bool is_at_rest(const CourseNow& course);
/// A box that encloses the body from now until the end, which is now + span. `box` is its current
/// box.
Box3 swept_box(const CourseNow& course, const Vec3& origin, const Box3& box, double span);

} // namespace abut
