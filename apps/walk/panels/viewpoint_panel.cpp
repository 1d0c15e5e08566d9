#include "panels/panels.h"
#include "panels/widgets.h"

#include <imgui.h>

namespace abut::viewer {

namespace {

void show_saved(Session& session, Tools& tools) {
    Viewpoints& viewpoints = tools.viewpoints;
    if (ImGui::Button("Save viewpoint"))
        tools.attempt([&] { viewpoints.save(session); });
    for (std::size_t i = 0; i < viewpoints.saved.points.size(); ++i) {
        ImGui::PushID(static_cast<int>(i));
        const bool is_removed = ImGui::SmallButton("x");
        ImGui::SameLine();
        if (ImGui::SmallButton("go"))
            viewpoints.visit(session, i);
        ImGui::SameLine();
        std::string name = viewpoints.saved.points[i].name;
        ImGui::SetNextItemWidth(-1);
        if (edit_text("##name", "name", name))
            tools.attempt([&] { viewpoints.rename(i, name); });
        ImGui::PopID();
        if (is_removed) {
            tools.attempt([&] { viewpoints.remove(i); });
            break;
        }
    }
}

} // namespace

void show_viewpoint_panel(Session& session, Tools& tools) {
    Viewpoints& viewpoints = tools.viewpoints;
    if (!begin_panel(tools, Panel::viewpoints, "Viewpoints and paths"))
        return;
    show_saved(session, tools);
    if (ImGui::Button(viewpoints.recording ? "Stop recording" : "Record a path"))
        viewpoints.toggle_recording();
    ImGui::SameLine();
    if (!viewpoints.path.points.empty() && !viewpoints.recording && ImGui::Button("Replay"))
        viewpoints.replay(session);
    ImGui::Text("path of %.1f s", duration(viewpoints.path));
    (void)edit_text("##path", "file of the path", viewpoints.file);
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
