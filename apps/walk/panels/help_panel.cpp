#include "panels/panels.h"

#include <fmt/format.h>
#include <imgui.h>

namespace abut::viewer {

namespace {

struct Key {
    const char *keys, *says;
};
constexpr Key kKeys[]{{"W A S D", "go"},
                      {"E, Q", "up, down (fly)"},
                      {"Space", "jump"},
                      {"Ctrl", "duck"},
                      {"Shift", "five times as fast"},
                      {"wheel", "speed; in orbit: distance"},
                      {"right drag", "look around"},
                      {"click", "choose a part, or measure"},
                      {"1, 2, 3", "walk, fly, orbit"},
                      {"F", "go to the chosen part"},
                      {"H", "hide the chosen part; U shows all"},
                      {"G", "ghosts: all but the chosen part"},
                      {"M", "clicks measure"},
                      {"C", "take the chosen part, put it down"},
                      {"X", "carry: stop, slide, through"},
                      {"N", "go to the next clash"},
                      {"K", "a section plane before the eye"},
                      {"V, B", "save a viewpoint; go to the next saved one"},
                      {"R, L", "record a path; replay it"},
                      {"P", "write the picture"},
                      {"Tab", "panels"},
                      {"F1", "these keys"},
                      {"Esc", "choose nothing; twice: end"}};

} // namespace

void show_help_panel(Tools& tools) {
    if (!tools.with_help)
        return;
    ImGui::SetNextWindowPos(ImVec2(360, 30), ImGuiCond_FirstUseEver);
    if (ImGui::Begin("Keys", &tools.with_help, ImGuiWindowFlags_AlwaysAutoResize))
        for (const Key& key : kKeys) {
            ImGui::Text("%s", key.keys);
            ImGui::SameLine(110);
            ImGui::TextUnformatted(key.says);
        }
    ImGui::End();
}

void show_status_line(Session& session, Tools& tools) {
    static constexpr const char* kMoves[]{"walk", "fly", "orbit"};
    const ViewStatistics& view = session.view.statistics();
    const WalkerState& person = session.walker->state();
    const std::string text = fmt::format(
        "{}{}  {:.1f} m/s   {:.0f} ms   {} triangles, {} draws   {} missing   query {:.2f} ms   {}",
        kMoves[static_cast<int>(session.move)], // NOLINT
        person.waits     ? " (waits)"
        : person.blocked ? " (blocked)"
                         : "",
        session.speed, tools.frame_milliseconds, view.triangles, view.draw_calls, view.missing,
        tools.proximity.milliseconds, tools.message);
    const ImGuiIO& io = ImGui::GetIO();
    ImDrawList* const drawing = ImGui::GetForegroundDrawList();
    drawing->AddRectFilled(ImVec2(0, io.DisplaySize.y - 28), io.DisplaySize,
                           IM_COL32(240, 240, 240, 200));
    drawing->AddText(ImVec2(10, io.DisplaySize.y - 22), IM_COL32(30, 34, 40, 255), text.c_str());
}

} // namespace abut::viewer
