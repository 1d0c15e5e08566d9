#include "panels/panels.h"

#include <imgui.h>

namespace abut::viewer {

namespace {

/// Returns whether the list has changed.
bool show_clash_row(Session& session, ClashList& list, const ListedClash& clash) {
    ImGui::PushID(clash_id_text(clash.id).c_str());
    char text[300];
    std::snprintf(text, sizeof text, "%-9s %-8s %8.4f m  %s | %s", to_string(clash.kind), // NOLINT
                  to_string(clash.status), clash.distance, clash.name[0].c_str(),
                  clash.name[1].c_str());
    if (ImGui::Selectable(text, list.shown == clash.id))
        list.wanted = clash;
    if (ImGui::IsItemHovered())
        ImGui::SetTooltip("%s\n%s", clash.name[0].c_str(), clash.name[1].c_str());
    bool has_changed = false;
    if (ImGui::BeginPopupContextItem()) {
        MarkChanges changes;
        if (ImGui::MenuItem("reviewed"))
            changes.reviewed = {clash.id};
        if (ImGui::MenuItem("approved"))
            changes.approved = {clash.id};
        if (ImGui::MenuItem("clear the mark"))
            changes.cleared = {clash.id};
        if (!changes.reviewed.empty() || !changes.approved.empty() || !changes.cleared.empty()) {
            list.mark(session, changes);
            has_changed = true;
        }
        ImGui::EndPopup();
    }
    ImGui::PopID();
    return has_changed;
}

} // namespace

void show_clash_panel(Session& session, Tools& tools) {
    ClashList& list = tools.clashes;
    if (!ImGui::CollapsingHeader("Clashes"))
        return;
    if (!list.is_read)
        list.read(session);
    if (list.wanted)
        ImGui::TextDisabled("reading the names of parts ...");
    if (!list.message.empty())
        ImGui::TextWrapped("%s", list.message.c_str());
    if (ImGui::Button("Read again"))
        list.read(session);
    ImGui::SameLine();
    if (ImGui::Button("No ghosts"))
        session.ghost_all_but({});
    ImGui::TextDisabled("click: fly to; right click: set the status");
    if (ImGui::BeginListBox("##clashes", ImVec2(-1, 180))) {
        for (const ClashReview& review : list.reviews) {
            bool has_changed = false;
            for (const ListedClash& clash : review.clashes)
                has_changed = has_changed || show_clash_row(session, list, clash);
            if (has_changed)
                break; // `review` is gone
        }
        ImGui::EndListBox();
    }
}

} // namespace abut::viewer
