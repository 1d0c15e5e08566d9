#include "panels/panels.h"

#include <fmt/format.h>
#include <imgui.h>

namespace abut::viewer {

void show_viewpoint_panel(Session& session, Tools& tools) {
    Viewpoints& viewpoints = tools.viewpoints;
    if (!ImGui::CollapsingHeader("Viewpoints and paths"))
        return;
    if (ImGui::Button("Save viewpoint"))
        record(viewpoints.saved, static_cast<double>(viewpoints.saved.points.size()),
               session.camera(), fmt::format("view {}", viewpoints.saved.points.size() + 1));
    for (const TourPoint& point : viewpoints.saved.points)
        if (ImGui::Selectable(point.name.c_str()))
            session.look(point.eye, point.forward);
    if (ImGui::Button(viewpoints.recording ? "Stop recording" : "Record a path")) {
        viewpoints.recording = !viewpoints.recording;
        viewpoints.replaying = false;
        if (viewpoints.recording)
            viewpoints.path = {}, viewpoints.clock = 0;
    }
    ImGui::SameLine();
    if (!viewpoints.path.points.empty() && !viewpoints.recording && ImGui::Button("Replay")) {
        viewpoints.replaying = true;
        viewpoints.clock = 0;
    }
    ImGui::Text("%s, %.1f s", viewpoints.file.c_str(), duration(viewpoints.path));
    if (ImGui::Button("Write"))
        tools.attempt([&] {
            write_tour(viewpoints.path, viewpoints.file);
            tools.message = viewpoints.file + " written";
        });
    ImGui::SameLine();
    if (ImGui::Button("Read"))
        tools.attempt([&] { viewpoints.path = read_tour(viewpoints.file); });
}

} // namespace abut::viewer
