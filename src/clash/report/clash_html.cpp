#include <abut/clash.h>

#include "clash/building/scenes_source.h"
#include "clash/report/clash_page.h"
#include "clash/report/page_data.h"
#include "clash/report/report_page.h"
#include "core/atomic_file.h"
#include "math/vector.h"

#include <algorithm>

namespace abut {

namespace {

/// Appends the template up to the marker, then removes that text and the marker from `html`.
void append_until(std::string& out, std::string_view& html, std::string_view marker) {
    const std::size_t at = html.find(marker);
    out += html.substr(0, at);
    html.remove_prefix(at + marker.size());
}

/// Packs the parts that clash and what is around them.
PackedBuilding building_of(const ClashReport& report, const PartNumbers& numbers,
                           const BuildingSource& source, const ClashPageOptions& options) {
    std::vector<std::uint32_t> clashing;
    std::unordered_map<std::uint32_t, std::uint32_t> number_of;
    for (const auto& [model, part] : numbers.places()) {
        number_of.emplace(source.part_of_report(model, part), clashing.size());
        clashing.push_back(source.part_of_report(model, part));
    }
    std::vector<Vec3> points;
    for (const Clash& clash : report.clashes)
        for (const Vec3& point : {clash.point_a, clash.point_b})
            if (is_finite(point))
                points.push_back(point);
    // Base64 takes 4 characters for 3 bytes.
    return pack_building(source,
                         {.clashing = clashing,
                          .points = points,
                          .most_bytes = options.building_bytes / 4 * 3,
                          .progress = options.progress},
                         number_of);
}

/// Stands at the foot of a page that would have a 3D view if this build of the library had one.
constexpr std::string_view kNoView =
    "<p class=\"keys\" id=\"no-view\">No building in 3D: the program that wrote this page was "
    "built without "
    "three.js, which tools/install_dependencies build installs.</p>\n";

bool has_geometry(const std::vector<Scene>& models) {
    return std::ranges::any_of(models, [](const Scene& model) { return !model.meshes.empty(); });
}

} // namespace

void write_clash_page(const ClashReport& report, const std::vector<Scene>& models,
                      const BuildingSource* source, const std::string& path,
                      const ClashPageOptions& options) {
    const PartNumbers numbers(report, models);
    PackedBuilding building;
    const bool wants_view =
        source != nullptr && !report.clashes.empty() && options.building_bytes > 0;
    if (wants_view && !report_page::scene.empty())
        building = building_of(report, numbers, *source, options);
    std::string out;
    std::string_view html = report_page::html;
    append_until(out, html, "@STYLE@");
    out += report_page::style;
    append_until(out, html, "@DATA@");
    out += page_data(report, models, numbers, building);
    append_until(out, html, "@SCRIPT@");
    out += report_page::script;
    append_until(out, html, "@BUILDING@");
    if (!building.bytes.empty()) {
        out += "<script type=\"text/plain\" id=\"building\">";
        out += base64(building.bytes);
        out += "</script>\n<script type=\"module\">";
        out += report_page::scene;
        out += "</script>\n";
    } else if (wants_view && report_page::scene.empty())
        out += kNoView;
    out += html;
    write_file_atomically(path, out);
}

void write_clash_html(const ClashReport& report, const std::vector<Scene>& models,
                      const std::string& path, const ClashPageOptions& options) {
    if (!has_geometry(models) || options.building_bytes == 0)
        return write_clash_page(report, models, nullptr, path, options);
    const ScenesSource source(models, report.frame.up);
    write_clash_page(report, models, &source, path, options);
}

void write_clash_html(const ClashReport& report, const std::vector<Scene>& models,
                      const std::string& path) {
    write_clash_html(report, models, path, ClashPageOptions{});
}

} // namespace abut
