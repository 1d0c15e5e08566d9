#include "panels/panels.h"

#include <imgui.h>

namespace abut::viewer {

void show_viewpoint_panel(Session& session, Tools& tools) {
    Viewpoints& viewpoints = tools.viewpoints;
    if (!ImGui::CollapsingHeader("Viewpoints and paths"))
        return;
    if (ImGui::Button("Save viewpoint"))
        viewpoints.save(session);
    for (std::size_t i = 0; i < viewpoints.saved.points.size(); ++i)
        if (ImGui::Selectable(viewpoints.saved.points[i].name.c_str()))
            viewpoints.visit(session, i);
    if (ImGui::Button(viewpoints.recording ? "Stop recording" : "Record a path"))
        viewpoints.toggle_recording();
    ImGui::SameLine();
    if (!viewpoints.path.points.empty() && !viewpoints.recording && ImGui::Button("Replay"))
        viewpoints.replay();
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
