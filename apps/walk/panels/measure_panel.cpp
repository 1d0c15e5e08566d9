#include "panels/panels.h"
#include "panels/widgets.h"

#include <imgui.h>

namespace abut::viewer {

void show_measure_panel(Session& session, Tools& tools) {
    Measure& measure = tools.measure;
    if (!begin_panel(tools, Panel::measure, "Measure"))
        return;
    ImGui::Checkbox("Clicks measure", &measure.on);
    const auto choice = [&](const char* text, Measured kind) {
        if (ImGui::RadioButton(text, measure.kind == kind)) {
            measure.kind = kind;
            measure.clear();
            session.changed = true;
        }
    };
    choice("part to part", Measured::parts);
    choice("point to part", Measured::point_part);
    choice("point to point", Measured::points);
    if (measure.on && measure.picks.size() != 2)
        ImGui::TextDisabled(measure.picks.empty() ? "click the first" : "click the second");
    if (!measure.result.empty())
        ImGui::TextWrapped("%s", measure.result.c_str());
    if (ImGui::Button("Clear")) {
        measure.clear();
        session.changed = true;
    }
}

} // namespace abut::viewer
