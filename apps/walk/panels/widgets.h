#pragma once

#include <abut/scene.h>

#include "toolbox/tools.h"

#include <imgui.h>
#include <string>

namespace abut::viewer {

inline ImVec4 to_imgui(const Colour& colour) {
    constexpr float kWhole = 255;
    return {static_cast<float>(colour.red) / kWhole, static_cast<float>(colour.green) / kWhole,
            static_cast<float>(colour.blue) / kWhole, 1};
}

inline const ImVec4 kWarning{0.85F, 0.2F, 0.15F, 1};

/// The header of a panel. Returns whether the panel is open. A panel whose tool was begun opens, and
/// is scrolled to.
inline bool begin_panel(Tools& tools, Panel panel, const char* title, bool is_open = false) {
    const bool opens = tools.opens == panel;
    if (opens)
        ImGui::SetNextItemOpen(true);
    const bool shown = ImGui::CollapsingHeader(title, is_open ? ImGuiTreeNodeFlags_DefaultOpen
                                                              : ImGuiTreeNodeFlags_None);
    if (opens) {
        ImGui::SetScrollHereY(0);
        tools.opens = Panel::none;
    }
    return shown;
}

/// A line for text that grows with it. Returns true when Enter was pressed.
inline bool edit_text(const char* label, const char* hint, std::string& text) {
    const auto grow = [](ImGuiInputTextCallbackData* data) {
        if (data->EventFlag == ImGuiInputTextFlags_CallbackResize) {
            auto& grown = *static_cast<std::string*>(data->UserData);
            grown.resize(static_cast<std::size_t>(data->BufTextLen));
            data->Buf = grown.data();
        }
        return 0;
    };
    return ImGui::InputTextWithHint(
        label, hint, text.data(), text.capacity() + 1,
        ImGuiInputTextFlags_CallbackResize | ImGuiInputTextFlags_EnterReturnsTrue, grow, &text);
}

/// A slider of a length. Returns whether it was changed.
inline bool slide(const char* label, double& metres, float least, float most,
                  const char* format = "%.2f m") {
    auto value = static_cast<float>(metres);
    if (!ImGui::SliderFloat(label, &value, least, most, format, ImGuiSliderFlags_Logarithmic))
        return false;
    metres = value;
    return true;
}

} // namespace abut::viewer
