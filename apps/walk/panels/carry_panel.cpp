#include "panels/panels.h"

#include <imgui.h>

namespace abut::viewer {

namespace {

void show_carried(Session& session, Tools& tools) {
    Carrying& carrying = tools.carrying;
    const CarryStep& step = carrying.carry->state();
    if (step.blocked)
        ImGui::TextColored(ImVec4(0.9F, 0.2F, 0.15F, 1), "blocked");
    if (step.waits)
        ImGui::TextDisabled("waits for parts that are being read");
    for (const WalkGap& gap : step.touched)
        ImGui::TextWrapped("%.4f m deep in %s", -gap.distance, name_of(session, gap.part).c_str());
    for (const WalkGap& gap : step.near)
        ImGui::TextWrapped("%.4f m from %s", gap.distance, name_of(session, gap.part).c_str());
    if (ImGui::Button("Put down"))
        carrying.put_down(session);
    ImGui::SameLine();
    if (ImGui::Button("Check its way"))
        tools.attempt([&] { carrying.check_way(session); });
}

} // namespace

void show_carry_panel(Session& session, Tools& tools) {
    Carrying& carrying = tools.carrying;
    if (!ImGui::CollapsingHeader("Carry"))
        return;
    const auto choice = [&](const char* text, CarryMode mode) {
        if (ImGui::RadioButton(text, carrying.mode == mode))
            carrying.mode = mode;
    };
    choice("stop", CarryMode::stop);
    ImGui::SameLine();
    choice("slide", CarryMode::slide);
    ImGui::SameLine();
    choice("through", CarryMode::through);
    if (carrying.carry)
        show_carried(session, tools);
    else if (session.chosen && ImGui::Button("Take the chosen part"))
        tools.attempt([&] { carrying.take(session, *session.chosen); });
    if (!carrying.report)
        return;
    const PathReport& report = *carrying.report;
    ImGui::Text("way of %.2f m, %zu contacts", report.length, report.contacts.size());
    for (const PathContact& contact : report.contacts)
        ImGui::TextWrapped("meets %s", name_of(session, contact.impact.part).c_str());
    if (report.clearance.found)
        ImGui::TextWrapped("least clearance %.4f m, from %s", report.clearance.distance,
                           name_of(session, report.clearance.part).c_str());
}

} // namespace abut::viewer
