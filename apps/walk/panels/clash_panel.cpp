#include "panels/panels.h"
#include "panels/widgets.h"

#include <algorithm>
#include <cstddef>
#include <fmt/format.h>
#include <imgui.h>
#include <vector>

namespace abut::viewer {

namespace {

constexpr float kClashListHeight = 160, kLargestClearance = 1; ///< pixels; metres

void show_job(Session& session, ClashList& list) {
    if (list.job.is_running()) {
        ImGui::ProgressBar(static_cast<float>(list.job.fraction()), ImVec2(-70, 0),
                           list.job.stage().c_str());
        ImGui::SameLine();
        if (ImGui::Button("Stop"))
            list.job.stop();
        return;
    }
    auto clearance = static_cast<float>(list.clearance);
    if (ImGui::SliderFloat("clearance", &clearance, 0, kLargestClearance, "%.3f m"))
        list.clearance = static_cast<double>(clearance);
    if (ImGui::Button("Look for clashes"))
        list.run_job(session);
    ImGui::SameLine();
    if (ImGui::Button("Read again"))
        list.read(session);
}

void show_row(ClashList& list, const ListedClash& clash) {
    ImGui::PushID(clash_id_text(clash.id).c_str());
    std::string text =
        fmt::format("{:<9} {:<8} {:8.4f} m  {} | {}", to_string(clash.kind),
                    to_string(clash.status), clash.distance, clash.name[0], clash.name[1]);
    std::ranges::replace(text, '\n', ' '); // all rows are equally high
    if (ImGui::Selectable(text.c_str(), list.shown == clash.id))
        list.wanted = clash;
    if (ImGui::IsItemHovered())
        ImGui::SetTooltip("%s\n%s%s%s", clash.name[0].c_str(), clash.name[1].c_str(),
                          clash.note.empty() ? "" : "\n", clash.note.c_str());
    ImGui::PopID();
}

void show_list(ClashList& list) {
    if (!ImGui::BeginListBox("##clashes", ImVec2(-1, kClashListHeight)))
        return;
    std::vector<const ListedClash*> rows;
    for (const ClashReview& review : list.reviews)
        for (const ListedClash& clash : review.clashes)
            if (list.with_resolved || clash.status != ClashStatus::resolved)
                rows.push_back(&clash);
    // Only the rows in view are made: there may be 100,000.
    ImGuiListClipper clipper;
    clipper.Begin(static_cast<int>(rows.size()), ImGui::GetTextLineHeightWithSpacing());
    while (clipper.Step())
        for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i)
            show_row(list, *rows[static_cast<std::size_t>(i)]);
    ImGui::EndListBox();
}

/// Status and note of the clash that is shown.
void show_marks(Session& session, Tools& tools) {
    ClashList& list = tools.clashes;
    if (!list.shown)
        return;
    ImGui::TextDisabled("clash %s", clash_id_text(*list.shown).c_str());
    if (ImGui::Button("Reviewed"))
        tools.attempt([&] { list.mark(session, ClashStatus::reviewed); });
    ImGui::SameLine();
    if (ImGui::Button("Approved"))
        tools.attempt([&] { list.mark(session, ClashStatus::approved); });
    ImGui::SameLine();
    if (ImGui::Button("No mark"))
        tools.attempt([&] { list.clear_mark(session); });
    if (tools.note_wants_keyboard)
        ImGui::SetKeyboardFocusHere();
    if (edit_text("note", "Enter keeps it", list.note))
        tools.attempt([&] { list.write_note(session); });
}

} // namespace

void show_clash_panel(Session& session, Tools& tools) {
    ClashList& list = tools.clashes;
    if (begin_panel(tools, Panel::clashes, "Clashes")) {
        if (!list.is_read)
            list.read(session);
        show_job(session, list);
        if (list.wanted)
            ImGui::TextDisabled("finding a view ...");
        if (!list.message.empty())
            ImGui::TextWrapped("%s", list.message.c_str());
        ImGui::Text("%zu clashes", list.count());
        ImGui::SameLine();
        ImGui::Checkbox("resolved, too", &list.with_resolved);
        show_list(list);
        show_marks(session, tools);
    }
    tools.note_wants_keyboard = false;
}

} // namespace abut::viewer
