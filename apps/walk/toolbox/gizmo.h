#pragma once

#include <abut/camera.h>

#include "vec.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

/// Handles around a part that is carried: three arrows to move it along an axis, and three rings to
/// turn it about one. Nothing here draws.
namespace abut::viewer {

enum class Handle : std::uint8_t { move_x, move_y, move_z, turn_x, turn_y, turn_z };
inline constexpr std::array kHandles{Handle::move_x, Handle::move_y, Handle::move_z,
                                     Handle::turn_x, Handle::turn_y, Handle::turn_z};
/// "move_x", …
const char* to_string(Handle handle);
bool is_move(Handle handle);
int axis_of(Handle handle); ///< 0 to 2

/// A point of the window, in pixels of the picture from its top left corner.
struct ScreenPoint {
    double x = 0, y = 0;
};

struct Gizmo {
    Vec3 middle;
    double size = 1; ///< length of the arrows, metres; the rings are a little larger
};

/// Returns a gizmo that has the same size on the screen wherever it is.
Gizmo gizmo_at(const Camera& camera, const Vec3& middle);

/// The line of a handle on the screen, without what is behind the eye.
std::vector<ScreenPoint> line_of(const Camera& camera, const Gizmo& gizmo, Handle handle);

/// A point by which the handle can be taken; none if it is behind the eye.
std::optional<ScreenPoint> grip_of(const Camera& camera, const Gizmo& gizmo, Handle handle);

/// The handle whose line is nearest to a point, within some pixels.
std::optional<Handle> handle_at(const Camera& camera, const Gizmo& gizmo, const ScreenPoint& at);

/// A handle that is dragged.
class GizmoDrag {
public:
    GizmoDrag(const Camera& camera, const Gizmo& gizmo, Handle handle, const ScreenPoint& at);

    /// How far the mouse has dragged since the beginning: metres along the axis, or radians about
    /// it. Where the mouse tells nothing (along the axis, or a ring from its edge), the last value.
    double amount(const Camera& camera, const ScreenPoint& at);
    [[nodiscard]] Handle handle() const { return handle_; }

private:
    [[nodiscard]] std::optional<double> place(const Camera& camera, const ScreenPoint& at) const;

    Handle handle_;
    Gizmo gizmo_;
    double start_ = 0, amount_ = 0;
};

} // namespace abut::viewer
