#include "panels/panels.h"
#include "vec.h"

#include <imgui.h>

namespace abut::viewer {

namespace {

constexpr std::size_t kMostFound = 200;

void continue_search(Session& session, Search& search) {
    if (search.is_over)
        return;
    const FoundParts found =
        session.view.find_parts(search.text.data(), kMostFound - search.found.size(), search.next);
    search.found.insert(search.found.end(), found.parts.begin(), found.parts.end());
    search.next = found.next;
    search.is_over = found.next >= session.view.parts().size() || search.found.size() >= kMostFound;
}

void show_chosen(Session& session) {
    if (!session.chosen) {
        ImGui::TextDisabled("Click a part to choose it.");
        return;
    }
    const std::uint32_t chosen = *session.chosen;
    const ViewPart part = session.view.part(chosen);
    ImGui::TextWrapped("%s", part.name.empty() ? part.id.c_str() : part.name.c_str());
    ImGui::Text("type  %s", part.type.c_str());
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
    if (ImGui::Button("All"))
        session.ghost_all_but({});
    ImGui::SameLine();
    PartState state = session.state(chosen);
    if (ImGui::Button(state.hidden ? "Show" : "Hide")) {
        state.hidden = !state.hidden;
        session.set_state(chosen, state);
    }
}

} // namespace

void show_parts_panel(Session& session, Tools& tools) {
    Search& search = tools.search;
    if (!ImGui::CollapsingHeader("Parts", ImGuiTreeNodeFlags_DefaultOpen))
        return;
    if (ImGui::InputTextWithHint("##search", "name, id or type", search.text.data(),
                                 search.text.size())) {
        search.found.clear();
        search.next = 0;
        search.is_over = search.text[0] == '\0';
    }
    continue_search(session, search);
    if (!search.found.empty() && ImGui::BeginListBox("##found", ImVec2(-1, 130))) {
        for (const std::uint32_t index : search.found) {
            const ViewPart part = session.view.part(index);
            ImGui::PushID(static_cast<int>(index));
            const std::string& name = part.name.empty() ? part.id : part.name;
            if (ImGui::Selectable(name.c_str(), session.chosen == index)) {
                session.choose(index);
                session.look_at(session.box_of(index));
            }
            ImGui::PopID();
        }
        ImGui::EndListBox();
    }
    if (!search.is_over)
        ImGui::TextDisabled("searching ...");
    show_chosen(session);
}

} // namespace abut::viewer
