#include "input/keys.h"
#include "panels/panels.h"

#include <imgui.h>

namespace abut::viewer {

namespace {

constexpr float kHelpLeft = 350, kHelpTop = 10, kSaysAt = 105;

void show_line(const char* control, const char* says) {
    const float left = ImGui::GetCursorPosX();
    ImGui::TextUnformatted(control);
    ImGui::SameLine(left + kSaysAt);
    ImGui::TextUnformatted(says);
}

} // namespace

void show_help_panel(Tools& tools) {
    if (!tools.with_help)
        return;
    ImGui::SetNextWindowPos(ImVec2(kHelpLeft, kHelpTop), ImGuiCond_FirstUseEver);
    if (ImGui::Begin("Keys", &tools.with_help, ImGuiWindowFlags_AlwaysAutoResize)) {
        ImGui::BeginGroup();
        for (const KeyHelp& each : key_help())
            show_line(each.keys, each.says);
        ImGui::EndGroup();
        ImGui::Separator();
        ImGui::TextDisabled("Gamepad");
        for (const GamepadHelp& each : gamepad_help())
            show_line(each.control, each.says);
    }
    ImGui::End();
}

} // namespace abut::viewer
