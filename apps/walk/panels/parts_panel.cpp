#include "panels/panels.h"
#include "panels/widgets.h"

#include <imgui.h>

namespace abut::viewer {

namespace {

constexpr float kListHeight = 130;

void show_chosen(Session& session, Tools& tools) {
    if (!session.chosen) {
        ImGui::TextDisabled("Click a part to choose it.");
        return;
    }
    const std::uint32_t chosen = *session.chosen;
    const ViewPart part = session.facts(chosen);
    ImGui::TextWrapped("%s", session.name(chosen).c_str());
    ImGui::TextWrapped("type  %s", part.type.c_str());
    ImGui::TextWrapped("id    %s", part.id.c_str());
    ImGui::TextWrapped("file  %s", part.file.c_str());
    const Vec3 size = part.box.upper - part.box.lower;
    ImGui::Text("size  %.3f x %.3f x %.3f m", size.x, size.y, size.z);
    if (ImGui::Button("Go to"))
        session.look_at(session.box_of(chosen));
    ImGui::SameLine();
    if (ImGui::Button("Only this"))
        session.ghost_all_but({chosen});
    ImGui::SameLine();
    PartState state = session.state(chosen);
    if (ImGui::Button(state.hidden ? "Show" : "Hide")) {
        state.hidden = !state.hidden;
        session.set_state(chosen, state);
    }
    ImGui::SameLine();
    if (ImGui::Button("Show all"))
        session.show_all();
    if (ImGui::Button("Remove from this walk"))
        tools.attempt([&] { tools.remove_part(session, chosen); });
}

void show_found(Session& session, const Search& search) {
    if (!ImGui::BeginListBox("##found", ImVec2(-1, kListHeight)))
        return;
    for (const std::uint32_t index : search.found) {
        ImGui::PushID(static_cast<int>(index));
        if (ImGui::Selectable(session.name(index).c_str(), session.chosen == index)) {
            session.choose(index);
            session.look_at(session.box_of(index));
        }
        ImGui::PopID();
    }
    ImGui::EndListBox();
}

} // namespace

void show_parts_panel(Session& session, Tools& tools) {
    Search& search = tools.search;
    if (!begin_panel(tools, Panel::parts, "Parts", true))
        return;
    if (search.wants_keyboard)
        ImGui::SetKeyboardFocusHere();
    search.wants_keyboard = false;
    const std::string before = search.text.data();
    const bool is_entered =
        ImGui::InputTextWithHint("##search", "name, id or type", search.text.data(),
                                 search.text.size(), ImGuiInputTextFlags_EnterReturnsTrue);
    if (before != search.text.data())
        search.begin();
    search.goes_to_first |= is_entered;
    if (!search.found.empty())
        show_found(session, search);
    if (!search.is_over)
        ImGui::TextDisabled("searching ...");
    show_chosen(session, tools);
}

} // namespace abut::viewer
