#include "panels/panels.h"

#include <imgui.h>

namespace abut::viewer {

void show_import(const std::string& stage, double fraction) {
    constexpr float kWidth = 420;
    const ImVec2 whole = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos(ImVec2(whole.x / 2, whole.y / 2), ImGuiCond_Always, ImVec2(0.5F, 0.5F));
    ImGui::SetNextWindowSize(ImVec2(std::min(kWidth, whole.x), 0));
    ImGui::Begin("Abut##import", nullptr,
                 ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoResize |
                     ImGuiWindowFlags_NoTitleBar);
    ImGui::TextUnformatted("Preparing the model");
    ImGui::ProgressBar(static_cast<float>(fraction), ImVec2(-1, 0));
    ImGui::TextDisabled("%s", stage.empty() ? "reading ..." : stage.c_str());
    ImGui::TextDisabled("Esc stops; the next start goes on from here.");
    ImGui::End();
}

} // namespace abut::viewer
