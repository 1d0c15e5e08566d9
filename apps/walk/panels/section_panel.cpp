#include "panels/panels.h"
#include "vec.h"

#include <imgui.h>

namespace abut::viewer {

namespace {

void show_planes(Session& session) {
    const Box3 bounds = session.view.bounds();
    if (session.sections.size() < kMostPlanes && ImGui::Button("Plane before the eye"))
        session.add_plane();
    for (std::size_t i = 0; i < session.sections.size(); ++i) {
        ImGui::PushID(static_cast<int>(i));
        SectionPlane& plane = session.sections[i];
        const double centre = dot(plane.normal, middle(bounds));
        auto at = static_cast<float>(plane.offset - centre);
        const auto half = static_cast<float>(diagonal(bounds) / 2);
        if (ImGui::SliderFloat("##offset", &at, -half, half, "%.2f m")) {
            plane.offset = centre + at;
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
    if (ImGui::Checkbox("Section box", &on)) {
        Box3 box = session.view.bounds();
        if (session.chosen)
            box = session.box_of(*session.chosen);
        const double margin = session.chosen ? 1 : 0;
        const Vec3 by{margin, margin, margin};
        session.section_box =
            on ? std::optional(Box3{box.lower - by, box.upper + by}) : std::nullopt;
        session.changed = true;
    }
    if (!session.section_box)
        return;
    Box3& box = *session.section_box;
    const auto drag = [&](const char* text, double& lower, double& upper) {
        auto low = static_cast<float>(lower), high = static_cast<float>(upper);
        if (ImGui::DragFloatRange2(text, &low, &high, 0.05F)) {
            lower = low, upper = high;
            session.changed = true;
        }
    };
    drag("x", box.lower.x, box.upper.x);
    drag("y", box.lower.y, box.upper.y);
    drag("z", box.lower.z, box.upper.z);
}

} // namespace

void show_section_panel(Session& session) {
    if (!ImGui::CollapsingHeader("Sections and colours"))
        return;
    show_planes(session);
    show_box(session);
    for (const ColourBy by : kColourings) {
        if (ImGui::RadioButton(to_string(by), session.colour_by == by))
            session.colour(by);
        if (by != kColourings.back())
            ImGui::SameLine();
    }
    session.changed |= ImGui::Checkbox("Edges", &session.with_edges);
    ImGui::SameLine();
    session.changed |= ImGui::Checkbox("Ground", &session.with_ground);
    ImGui::SameLine();
    session.changed |= ImGui::Checkbox("Occlusion", &session.with_occlusion);
}

} // namespace abut::viewer
