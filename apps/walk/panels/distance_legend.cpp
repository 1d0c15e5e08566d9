#include "panels/panels.h"
#include "panels/widgets.h"

#include <fmt/format.h>
#include <imgui.h>

namespace abut::viewer {

void show_distance_legend(const Session& session) {
    if (!session.distances)
        return;
    constexpr int kSteps = 32;
    constexpr float kWidth = 200, kHeight = 12, kRight = 20, kTop = 20, kTextDown = 15;
    ImDrawList* const drawing = ImGui::GetForegroundDrawList();
    const float left = ImGui::GetIO().DisplaySize.x - kWidth - kRight;
    drawing->AddRectFilled({left - 10, kTop - 8}, {left + kWidth + 10, kTop + 34},
                           IM_COL32(250, 250, 250, 215), 4);
    for (int i = 0; i < kSteps; ++i) {
        const float from = left + kWidth * static_cast<float>(i) / kSteps;
        const Colour colour = distance_colour((i + 0.5) / kSteps);
        drawing->AddRectFilled({from, kTop}, {from + kWidth / kSteps + 1, kTop + kHeight},
                               IM_COL32(colour.red, colour.green, colour.blue, 255));
    }
    const double reach = session.distances->reach;
    const auto label = [&](float part) {
        const std::string text = fmt::format("{:.3g} m", reach * static_cast<double>(part));
        const float shift = part * ImGui::CalcTextSize(text.c_str()).x;
        drawing->AddText({left + part * kWidth - shift, kTop + kTextDown},
                         IM_COL32(30, 34, 40, 255), text.c_str());
    };
    label(0);
    label(0.5F);
    label(1);
}

} // namespace abut::viewer
