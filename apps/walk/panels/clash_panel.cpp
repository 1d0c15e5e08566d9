#include <abut/error.h>

#include "panels/panels.h"

#include <imgui.h>

namespace abut::viewer {

namespace {

void read_clashes(Session& session, ClashList& list) {
    try {
        list.reviews = review_clashes(session.store);
        list.message = list.reviews.empty() ? "no clash job has finished" : "";
    } catch (const Error& error) {
        list.message = error.what();
    }
    list.is_read = true;
}

void mark(Session& session, ClashList& list, const MarkChanges& changes) {
    try {
        mark_clashes(open_store(session.path, {.read_only = false}), changes);
        read_clashes(session, list);
    } catch (const Error& error) {
        list.message = error.what();
    }
}

/// Returns whether the list has changed.
bool show_clash_row(Session& session, ClashList& list, const ListedClash& clash) {
    ImGui::PushID(clash_id_text(clash.id).c_str());
    char text[300];
    std::snprintf(text, sizeof text, "%-9s %-8s %8.4f m  %s | %s", to_string(clash.kind), // NOLINT
                  to_string(clash.status), clash.distance, clash.name[0].c_str(),
                  clash.name[1].c_str());
    if (ImGui::Selectable(text))
        session.show_clash(clash);
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
            mark(session, list, changes);
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
        read_clashes(session, list);
    if (!session.learn_ids(0.005))
        ImGui::TextDisabled("reading the names of parts ...");
    if (!list.message.empty())
        ImGui::TextWrapped("%s", list.message.c_str());
    if (ImGui::Button("Read again"))
        read_clashes(session, list);
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
