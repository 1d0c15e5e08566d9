#include "panels/panels.h"

#include <cmath>
#include <imgui.h>

namespace abut::viewer {

namespace {

constexpr float kArrowWidth = 3, kRingWidth = 2, kGrown = 2; ///< pixels
constexpr float kTip = 13, kTipHalf = 5.5F;                  ///< of an arrow, pixels

ImU32 colour_of(Handle handle, bool is_bright) {
    static constexpr std::array<ImU32, 3> kAxes{
        IM_COL32(214, 52, 44, 235), IM_COL32(54, 158, 62, 235), IM_COL32(46, 98, 214, 235)};
    return is_bright ? IM_COL32(255, 176, 0, 255)
                     : kAxes.at(static_cast<std::size_t>(axis_of(handle)));
}

void draw_tip(ImDrawList& drawing, const ImVec2& from, const ImVec2& to, ImU32 colour) {
    const float x = to.x - from.x, y = to.y - from.y, along = std::hypot(x, y);
    if (along < kTip)
        return; // it points at the eye
    const ImVec2 way{x / along, y / along};
    drawing.AddTriangleFilled({to.x + way.x * kTip, to.y + way.y * kTip},
                              {to.x - way.y * kTipHalf, to.y + way.x * kTipHalf},
                              {to.x + way.y * kTipHalf, to.y - way.x * kTipHalf}, colour);
}

} // namespace

void show_gizmo(const Session& session, const Tools& tools) {
    const Carrying& carrying = tools.carrying;
    if (!carrying.carry)
        return;
    ImDrawList& drawing = *ImGui::GetBackgroundDrawList();
    const Camera camera = session.camera();
    const Gizmo gizmo = carrying.gizmo(session);
    // The picture may have more pixels than the window has positions.
    const ImGuiIO& io = ImGui::GetIO();
    const float scale = io.DisplaySize.x / static_cast<float>(camera.width);
    for (const Handle handle : kHandles) {
        const bool is_bright =
            carrying.drag ? carrying.drag->handle() == handle : carrying.hovered == handle;
        const ImU32 colour = colour_of(handle, is_bright);
        std::vector<ImVec2> line;
        for (const ScreenPoint& point : line_of(camera, gizmo, handle))
            line.emplace_back(scale * static_cast<float>(point.x),
                              scale * static_cast<float>(point.y));
        if (line.size() < 2)
            continue;
        drawing.AddPolyline(line.data(), static_cast<int>(line.size()), colour, 0,
                            (is_move(handle) ? kArrowWidth : kRingWidth) +
                                (is_bright ? kGrown : 0));
        if (is_move(handle))
            draw_tip(drawing, line.front(), line.back(), colour);
    }
}

} // namespace abut::viewer
