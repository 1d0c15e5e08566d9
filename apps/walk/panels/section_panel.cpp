#include "panels/panels.h"
#include "panels/widgets.h"

#include <imgui.h>

namespace abut::viewer {

namespace {

constexpr float kNearestPlane = 0.1F, kFarthestPlane = 50, kBoxStep = 0.05F; ///< metres

void show_new_planes(Session& session) {
    if (session.sections.size() >= kMostPlanes)
        return;
    if (ImGui::Button("Plane before the eye"))
        session.add_plane();
    static constexpr std::array kAcross{"x", "y", "z"};
    for (int i = 0; i < 3; ++i) {
        ImGui::SameLine();
        if (ImGui::Button(kAcross.at(static_cast<std::size_t>(i))))
            session.add_plane_across(i);
    }
    slide("distance", session.plane_distance, kNearestPlane, kFarthestPlane);
}

void show_planes(Session& session) {
    const Box3 bounds = session.view.bounds();
    for (std::size_t i = 0; i < session.sections.size(); ++i) {
        ImGui::PushID(static_cast<int>(i));
        SectionPlane& plane = session.sections[i];
        const double centre = dot(plane.normal, middle(bounds));
        auto at = static_cast<float>(plane.offset - centre);
        const auto half = static_cast<float>(diagonal(bounds) / 2);
        if (ImGui::SliderFloat("##offset", &at, -half, half, "%.2f m")) {
            plane.offset = centre + static_cast<double>(at);
            session.changed = true;
        }
        ImGui::SameLine();
        if (ImGui::SmallButton("turn")) {
            plane = {-1.0 * plane.normal, -plane.offset};
            session.changed = true;
        }
        ImGui::SameLine();
        const bool is_removed = ImGui::SmallButton("x");
        ImGui::PopID();
        if (is_removed) {
            session.sections.erase(session.sections.begin() + static_cast<std::ptrdiff_t>(i));
            session.changed = true;
            break;
        }
    }
}

void show_box(Session& session) {
    bool on = session.section_box.has_value();
    if (ImGui::Checkbox(session.chosen ? "Section box around the chosen part" : "Section box", &on))
        session.toggle_box();
    if (!session.section_box)
        return;
    Box3& box = *session.section_box;
    const auto drag = [&](const char* text, double& lower, double& upper) {
        auto low = static_cast<float>(lower), high = static_cast<float>(upper);
        if (ImGui::DragFloatRange2(text, &low, &high, kBoxStep)) {
            lower = static_cast<double>(low), upper = static_cast<double>(high);
            session.changed = true;
        }
    };
    drag("x##box", box.lower.x, box.upper.x);
    drag("y##box", box.lower.y, box.upper.y);
    drag("z##box", box.lower.z, box.upper.z);
}

} // namespace

void show_section_panel(Session& session, Tools& tools) {
    if (!begin_panel(tools, Panel::sections, "Sections"))
        return;
    show_new_planes(session);
    show_planes(session);
    show_box(session);
}

} // namespace abut::viewer
