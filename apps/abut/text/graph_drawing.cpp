#include "text/graph_drawing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace abut::command {

namespace {

constexpr double kWidth = 1200, kMargin = 20;

/// The projection onto two of the axes, scaled to the page.
class Page {
public:
    explicit Page(const GraphReport& graph) {
        Box3 box;
        for (const GraphReport::Unit& unit : graph.units) {
            box.lower = {std::min(box.lower.x, unit.bounds.lower.x),
                         std::min(box.lower.y, unit.bounds.lower.y),
                         std::min(box.lower.z, unit.bounds.lower.z)};
            box.upper = {std::max(box.upper.x, unit.bounds.upper.x),
                         std::max(box.upper.y, unit.bounds.upper.y),
                         std::max(box.upper.z, unit.bounds.upper.z)};
        }
        lower_ = {box.lower.x, box.lower.y, box.lower.z};
        const std::array<double, 3> extent{box.upper.x - box.lower.x, box.upper.y - box.lower.y,
                                           box.upper.z - box.lower.z};
        const auto least = static_cast<std::size_t>(std::min_element(extent.begin(), extent.end()) -
                                                    extent.begin());
        across_ = least == 0 ? 1 : 0;
        down_ = least == 2 ? 1 : 2;
        if (extent.at(across_) < extent.at(down_))
            std::swap(across_, down_);
        scale_ = (kWidth - 2 * kMargin) / std::max(extent.at(across_), 1e-9);
        height_ = 2 * kMargin + scale_ * extent.at(down_);
    }
    [[nodiscard]] double height() const { return height_; }
    [[nodiscard]] std::array<double, 2> place(const Vec3& p) const {
        const std::array<double, 3> c{p.x, p.y, p.z};
        return {kMargin + scale_ * (c.at(across_) - lower_.at(across_)),
                kMargin + scale_ * (c.at(down_) - lower_.at(down_))};
    }

private:
    std::array<double, 3> lower_{};
    std::size_t across_ = 0, down_ = 2;
    double scale_ = 1, height_ = 0;
};

/// Returns the colour of a unit. Hues of consecutive units differ by the golden angle.
std::string colour(std::size_t unit) {
    return fmt::format("hsl({:.0f} 70% 42%)", std::fmod(137.508 * static_cast<double>(unit), 360));
}

} // namespace

std::string draw(const GraphReport& graph) {
    const bool empty = graph.units.empty();
    const Page page(graph);
    std::string text =
        fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" "
                    "width=\"{0:.0f}\" height=\"{1:.0f}\">\n"
                    "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
                    kWidth, empty ? kWidth / 4 : page.height());
    std::vector<std::string> paths(graph.units.size());
    for (const GraphReport::Line& line : graph.lines) {
        const auto [xa, ya] = page.place(line.a);
        const auto [xb, yb] = page.place(line.b);
        paths[line.unit] += fmt::format("M{:.1f} {:.1f}L{:.1f} {:.1f}", xa, ya, xb, yb);
    }
    for (std::size_t i = 0; i < paths.size(); ++i)
        if (!paths[i].empty())
            text +=
                fmt::format("<path d=\"{}\" stroke=\"{}\" stroke-width=\"0.7\" fill=\"none\"/>\n",
                            paths[i], colour(i));
    std::uint64_t most = 1;
    for (const GraphReport::Unit& unit : graph.units)
        most = std::max(most, unit.bytes);
    for (std::size_t i = 0; i < graph.units.size() && graph.units.size() > 1; ++i) {
        const GraphReport::Unit& unit = graph.units[i];
        const auto [x, y] = page.place(unit.middle);
        const double radius =
            4 + 14 * std::sqrt(static_cast<double>(unit.bytes) / static_cast<double>(most));
        text +=
            fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\" fill=\"white\" "
                        "fill-opacity=\"0.6\" stroke=\"{}\" stroke-width=\"2\"/>\n"
                        "<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"11\" text-anchor=\"middle\" "
                        "font-family=\"sans-serif\">{}</text>\n",
                        x, y, radius, colour(i), x, y + 4, i + 1);
    }
    return text + "</svg>\n";
}

} // namespace abut::command
