#include "panels/panels.h"

#include <imgui.h>

namespace abut::viewer {

void show_proximity_panel(Session& session, Tools& tools) {
    Proximity& proximity = tools.proximity;
    if (!ImGui::CollapsingHeader("Nearest", ImGuiTreeNodeFlags_DefaultOpen))
        return;
    ImGui::Checkbox("Live", &proximity.on);
    ImGui::SameLine();
    ImGui::Checkbox("Of the chosen part", &proximity.of_chosen);
    if (proximity.nearest) {
        ImGui::Text("%.4f m", proximity.nearest->distance);
        ImGui::TextWrapped("%s", name_of(session, proximity.nearest->part).c_str());
    }
    if (!proximity.complete)
        ImGui::TextDisabled("some parts are still being read");
    ImGui::Checkbox("List what is within", &proximity.with_list);
    if (!proximity.with_list)
        return;
    auto reach = static_cast<float>(proximity.reach);
    if (ImGui::SliderFloat("##reach", &reach, 0.01F, 20, "%.2f m", ImGuiSliderFlags_Logarithmic))
        proximity.reach = reach;
    constexpr std::size_t kMostShown = 100;
    if (ImGui::BeginListBox("##near", ImVec2(-1, 120))) {
        for (std::size_t i = 0; i < std::min(kMostShown, proximity.near.size()); ++i) {
            const WalkGap& gap = proximity.near[i];
            ImGui::PushID(static_cast<int>(i));
            char text[200];
            std::snprintf(text, sizeof text, "%.3f m  %s", gap.distance, // NOLINT
                          name_of(session, gap.part).c_str());
            if (ImGui::Selectable(text))
                session.choose(session.view.index_of(gap.part.number));
            ImGui::PopID();
        }
        ImGui::EndListBox();
    }
    ImGui::Text("%zu parts", proximity.near.size());
}

} // namespace abut::viewer
