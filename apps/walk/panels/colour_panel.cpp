#include "panels/panels.h"
#include "panels/widgets.h"

#include <fmt/format.h>
#include <imgui.h>

namespace abut::viewer {

namespace {

constexpr float kLegendHeight = 120, kSwatch = 14;
constexpr int kInARow = 3;

/// Each group of parts with its colour. A click shows its parts alone.
void show_legend(Session& session) {
    const std::vector<PartColouring::Group>& legend = session.colouring.legend;
    if (legend.empty() || !ImGui::BeginListBox("##legend", ImVec2(-1, kLegendHeight)))
        return;
    for (std::size_t i = 0; i < legend.size(); ++i) {
        ImGui::PushID(static_cast<int>(i));
        ImGui::ColorButton("##colour", to_imgui(legend[i].colour),
                           ImGuiColorEditFlags_NoTooltip | ImGuiColorEditFlags_NoDragDrop,
                           ImVec2(kSwatch, kSwatch));
        ImGui::SameLine();
        if (ImGui::Selectable(fmt::format("{} ({})", legend[i].word, legend[i].parts).c_str()))
            session.ghost_all_but_group(static_cast<std::uint32_t>(i));
        ImGui::PopID();
    }
    ImGui::EndListBox();
    if (ImGui::Button("No ghosts"))
        session.ghost_all_but({});
}

} // namespace

void show_colour_panel(Session& session) {
    if (!ImGui::CollapsingHeader("Colours"))
        return;
    int place = 0;
    for (const ColourBy by : kColourings) {
        if (place++ % kInARow != 0)
            ImGui::SameLine();
        if (ImGui::RadioButton(to_string(by), session.colour_by == by))
            session.colour(by);
    }
    show_legend(session);
    session.changed |= ImGui::Checkbox("Edges", &session.with_edges);
    ImGui::SameLine();
    session.changed |= ImGui::Checkbox("Ground", &session.with_ground);
    ImGui::SameLine();
    session.changed |= ImGui::Checkbox("Occlusion", &session.with_occlusion);
}

} // namespace abut::viewer
