#pragma once

#include <abut/camera.h>
#include <abut/types.h>

#include <string>
#include <vector>

/// Saved viewpoints, and paths of a camera that are recorded and replayed.
namespace abut {

/// Where the camera is at a time.
struct TourPoint {
    double seconds = 0;
    Vec3 eye{0, 0, 0}, forward{0, 1, 0}, up{0, 0, 1}; ///< as in Camera
    std::string name{};                               ///< of a saved viewpoint; empty for others
    friend bool operator==(const TourPoint&, const TourPoint&) = default;
};

/// Points in the order of their times. A list of saved viewpoints is a tour, too.
struct Tour {
    std::vector<TourPoint> points;
    friend bool operator==(const Tour&, const Tour&) = default;
};

/// Returns the time of the last point; 0 if there is none.
double duration(const Tour& tour);

/// Returns the camera at a time: the position on a Catmull-Rom spline through the points, and
/// directions turned evenly from one point to the next. Before the first and after the last point,
/// the camera stands still.
///
/// In          lens: field of view, size of the picture and clipping distances.
/// Degenerate  Two points at one time are a cut: from that time on, the second one counts.
/// Errors      Error{bad_argument} if the tour has no points, or if a point is not valid (see
///             read_tour) or `seconds` is not a number.
Camera camera_at(const Tour& tour, double seconds, const Camera& lens = {});

/// Appends a point, unless the last one without a name is less than 1/30 second older.
///
/// Errors      Error{bad_argument} if the time is before that of the last point, or if the camera
///             is not valid.
void record(Tour& tour, double seconds, const Camera& camera, const std::string& name = {});

/// Reads a tour from JSON: {"abut_tour": 1, "points": [{"seconds": 0, "eye": [x, y, z],
/// "forward": [x, y, z], "up": [x, y, z], "name": "…"}, …]}. `name` may be missing.
///
/// Errors      Error, naming the file: file_not_found, unreadable; malformed, naming the point, if
///             the file is not such a text, a number is not finite or a coordinate beyond 1e18, a
///             direction is zero or parallel to `up`, or times decrease; unsupported for another
///             version.
Tour read_tour(const std::string& path);

/// Writes a tour as JSON, atomically. `read_tour` then returns the same tour.
///
/// Errors      Error, naming the file: bad_argument if read_tour would refuse the tour;
///             cannot_write.
void write_tour(const Tour& tour, const std::string& path);

} // namespace abut
