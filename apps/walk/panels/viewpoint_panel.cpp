#include <abut/error.h>

#include "panels/panels.h"

#include <fmt/format.h>
#include <functional>
#include <imgui.h>

namespace abut::viewer {

namespace {

/// Runs work, and shows its error or what was done.
void attempt(Viewpoints& viewpoints, const std::string& done, const std::function<void()>& work) {
    try {
        work();
        viewpoints.message = done;
    } catch (const Error& error) {
        viewpoints.message = error.what();
    }
}

} // namespace

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
        attempt(viewpoints, "written", [&] { write_tour(viewpoints.path, viewpoints.file); });
    ImGui::SameLine();
    if (ImGui::Button("Read"))
        attempt(viewpoints, "read", [&] { viewpoints.path = read_tour(viewpoints.file); });
    if (!viewpoints.message.empty())
        ImGui::TextWrapped("%s", viewpoints.message.c_str());
}

} // namespace abut::viewer
