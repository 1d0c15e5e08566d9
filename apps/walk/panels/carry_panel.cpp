#include "panels/panels.h"
#include "panels/widgets.h"

#include <imgui.h>

namespace abut::viewer {

namespace {

constexpr float kLargestCarryClearance = 2;        ///< metres
constexpr float kLeastTurn = 0.1F, kMostTurn = 90; ///< degrees
constexpr const char* kReportFile = "abut-walk-way.json";

void show_modes(Session& session, Carrying& carrying) {
    for (const CarryMode mode : {CarryMode::stop, CarryMode::slide, CarryMode::through}) {
        if (mode != CarryMode::stop)
            ImGui::SameLine();
        if (ImGui::RadioButton(to_string(mode), carrying.mode == mode))
            carrying.set_mode(session, mode);
    }
    slide("clearance##carry", carrying.clearance, kLeastTurn / 100, kLargestCarryClearance);
    auto step = static_cast<float>(carrying.turn_step);
    if (ImGui::SliderFloat("turn", &step, kLeastTurn, kMostTurn, "%.1f degrees"))
        carrying.turn_step = static_cast<double>(step);
}

void show_around(Session& session, const CarryStep& step) {
    if (step.blocked)
        ImGui::TextColored(kWarning, "blocked");
    if (step.waits)
        ImGui::TextDisabled("waits for parts that are being read");
    for (const WalkGap& gap : step.touched) {
        ImGui::TextWrapped("%.4f m deep in %s", -gap.distance, name_of(session, gap.part).c_str());
        if (gap.distance < 0)
            ImGui::TextDisabled("  way out: %.2f %.2f %.2f", gap.normal.x, gap.normal.y,
                                gap.normal.z);
    }
    for (const WalkGap& gap : step.near)
        ImGui::TextWrapped("%.4f m from %s", gap.distance, name_of(session, gap.part).c_str());
}

void show_hand(Session& session, Tools& tools) {
    Carrying& carrying = tools.carrying;
    if (ImGui::Button("Put down"))
        carrying.put_down(session);
    if (!carrying.carry)
        return;
    ImGui::SameLine();
    if (ImGui::Button("Straight"))
        carrying.straighten();
    ImGui::SameLine();
    if (ImGui::Button("Out"))
        tools.attempt([&] { (void)carrying.move_out(session); });
    ImGui::SameLine();
    if (ImGui::Button("Check its way"))
        tools.attempt([&] { carrying.check_way(session); });
    show_around(session, carrying.carry->state());
}

void show_file(Tools& tools) {
    Carrying& carrying = tools.carrying;
    if (carrying.is_reading()) {
        ImGui::ProgressBar(static_cast<float>(carrying.reading.fraction()), ImVec2(-70, 0),
                           carrying.reading.stage().c_str());
        ImGui::SameLine();
        if (ImGui::Button("Stop##reading"))
            carrying.reading.stop();
        return;
    }
    const bool is_entered = edit_text("##file", "a model file to carry", carrying.file);
    ImGui::SameLine();
    if ((ImGui::Button("Bring in") || is_entered) && !carrying.file.empty())
        carrying.bring_in(carrying.file);
}

void show_report(Session& session, Tools& tools) {
    const Carrying& carrying = tools.carrying;
    if (!carrying.report)
        return;
    const PathReport& report = *carrying.report;
    ImGui::Separator();
    ImGui::Text("way of %.2f m: %s", report.length, report.is_free() ? "free" : "not free");
    for (const PathContact& contact : report.contacts)
        ImGui::TextWrapped("meets %s", name_of(session, contact.impact.part).c_str());
    if (report.clearance.found)
        ImGui::TextWrapped("least clearance %.4f m, from %s", report.clearance.distance,
                           name_of(session, report.clearance.part).c_str());
    if (ImGui::Button("Write report"))
        tools.attempt([&] {
            carrying.write_report(session, kReportFile);
            tools.message = std::string(kReportFile) + " written";
        });
}

} // namespace

void show_carry_panel(Session& session, Tools& tools) {
    Carrying& carrying = tools.carrying;
    if (!begin_panel(tools, Panel::carry, "Carry"))
        return;
    show_modes(session, carrying);
    if (carrying.carry)
        show_hand(session, tools);
    else if (session.chosen && ImGui::Button("Take the chosen part"))
        tools.attempt([&] { carrying.take(session, *session.chosen); });
    show_file(tools);
    show_report(session, tools);
}

} // namespace abut::viewer
