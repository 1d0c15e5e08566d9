#include "panels/panels.h"
#include "panels/widgets.h"

#include <fmt/format.h>
#include <imgui.h>

namespace abut::viewer {

namespace {

constexpr std::size_t kMostShown = 100; ///< of the list of near parts
constexpr float kNearListHeight = 120;

void show_near(Session& session, const Proximity& proximity) {
    if (ImGui::BeginListBox("##near", ImVec2(-1, kNearListHeight))) {
        for (std::size_t i = 0; i < std::min(kMostShown, proximity.near.size()); ++i) {
            const WalkGap& gap = proximity.near[i];
            ImGui::PushID(static_cast<int>(i));
            const std::string text =
                fmt::format("{:.3f} m  {}", gap.distance, name_of(session, gap.part));
            if (ImGui::Selectable(text.c_str()))
                session.choose(session.index_of(gap.part));
            ImGui::PopID();
        }
        ImGui::EndListBox();
    }
    ImGui::Text("%zu parts", proximity.near.size());
}

} // namespace

void show_proximity_panel(Session& session, Tools& tools) {
    Proximity& proximity = tools.proximity;
    if (!ImGui::CollapsingHeader("Nearest", ImGuiTreeNodeFlags_DefaultOpen))
        return;
    session.changed |= ImGui::Checkbox("Live", &proximity.on);
    ImGui::SameLine();
    session.changed |= ImGui::Checkbox("Of the chosen part", &proximity.of_chosen);
    if (proximity.nearest) {
        ImGui::Text("%.4f m", proximity.nearest->distance);
        ImGui::TextWrapped("%s", name_of(session, proximity.nearest->part).c_str());
    }
    if (!proximity.complete)
        ImGui::TextDisabled("some parts are still being read");
    session.changed |= slide("reach", proximity.reach, 0.01F, 20);
    session.changed |= ImGui::Checkbox("Colour by distance", &proximity.colours);
    ImGui::SameLine();
    session.changed |= ImGui::Checkbox("List", &proximity.with_list);
    if (proximity.with_list)
        show_near(session, proximity);
}

} // namespace abut::viewer
