#include "panels/panels.h"

#include <fmt/format.h>
#include <imgui.h>

namespace abut::viewer {

void show_status_line(Session& session, Tools& tools) {
    static constexpr std::array kMoves{"walk", "fly", "orbit"};
    constexpr float kHeight = 28, kTextUp = 22, kLeft = 10;
    const ViewStatistics& view = session.view.statistics();
    const WalkerState& person = session.walker->state();
    const std::string text = fmt::format(
        "{}{}  {:.1f} m/s   {:.0f} ms   {} triangles, {} draws   {} missing   query {:.2f} ms   {}",
        kMoves.at(static_cast<std::size_t>(session.move)),
        person.waits     ? " (waits)"
        : person.blocked ? " (blocked)"
                         : "",
        session.speed, tools.frame_milliseconds, view.triangles, view.draw_calls, view.missing,
        tools.proximity.milliseconds, tools.message);
    const ImGuiIO& io = ImGui::GetIO();
    ImDrawList* const drawing = ImGui::GetForegroundDrawList();
    drawing->AddRectFilled(ImVec2(0, io.DisplaySize.y - kHeight), io.DisplaySize,
                           IM_COL32(240, 240, 240, 200));
    drawing->AddText(ImVec2(kLeft, io.DisplaySize.y - kTextUp), IM_COL32(30, 34, 40, 255),
                     text.c_str());
}

} // namespace abut::viewer
