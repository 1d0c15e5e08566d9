/// abut-make-report FOLDER COUNT [statuses|rules|building]: writes report.html, report.json and report.csv of
/// COUNT made-up clashes. Some names would break pages that do not escape text. With `statuses`,
/// the clashes have statuses as from a store; with `rules`, also groups, the cells of a matrix,
/// severities and volumes. With `building`, they are found between parts with geometry. The same arguments give the same files.
#include <abut/clash.h>
#include <abut/error.h>

#include "made_building.h"

#include <cstdio>
#include <cstdlib>
#include <fmt/format.h>
#include <random>
#include <string>

namespace {

using abut::Clash;
using abut::ClashKind;
using abut::ClashReport;
using abut::Part;
using abut::Scene;

constexpr const char* kHostileNames[] = {
    "</script><script>document.title='broken in'</script>",
    "<img src=x onerror=\"document.title='broken in'\">",
    "=HYPERLINK(\"https://example.org\",\"open\")",
    "name, with \"quotes\"\nand a second line",
    "ill-formed \xC3\x28 bytes",
    "\u202Eright to left",
    "<!--<script>",
    "@DATA@ @SCRIPT@ @STYLE@",
};

struct Product {
    const char* name;
    const char* type;
};

constexpr Product kBuilding[] = {
    {"Basic Wall:Exterior - Brick on Block", "IfcWallStandardCase"},
    {"Basic Wall:Interior - Partition (92mm Stud)", "IfcWallStandardCase"},
    {"Floor:Finish Floor - Wood", "IfcSlab"},
    {"Concrete-Rectangular-Column:300 x 450mm", "IfcColumn"},
    {"UB-Universal Beam:305x165x40UB", "IfcBeam"},
    {"M_Fixed:4835mm x 2420mm", "IfcWindow"},
    {"M_Single-Flush:0915 x 2134mm", "IfcDoor"},
};
constexpr Product kServices[] = {
    {"Pipe Types:Standard", "IfcFlowSegment"},
    {"Rectangular Duct:Mitered Elbows / Tees", "IfcFlowSegment"},
    {"M_Pipe Elbow:Standard", "IfcFlowFitting"},
    {"M_Supply Diffuser:600 x 600 Face", "IfcFlowTerminal"},
    {"Cable Tray with Fittings:Channel", "IfcCableCarrierSegment"},
    {"", "IfcBuildingElementProxy"},
    {"M_Toilet-Domestic-3D", ""},
};

template <std::size_t N>
Scene make_scene(const std::string& file, const Product (&products)[N], std::size_t parts,
                 std::mt19937& random) {
    constexpr char kDigits[] = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_$";
    Scene scene;
    scene.file = file;
    for (std::size_t i = 0; i < parts; ++i) {
        const Product& product = products[random() % N];
        Part part;
        for (int digit = 0; digit < 22; ++digit)
            part.id += kDigits[random() % 64];
        part.name = *product.name == 0 ? "" : fmt::format("{}:{}", product.name, 100000 + i);
        part.type = product.type;
        if (i < std::size(kHostileNames))
            part.name = kHostileNames[i];
        scene.parts.push_back(part);
    }
    return scene;
}

double distance_of(ClashKind kind, double share) {
    switch (kind) {
    case ClashKind::hard:
        return share < 0.05 ? -1e-9 : -0.0005 - 0.35 * share * share; // a few nanometres deep
    case ClashKind::contained:
        return -0.02 - share;
    case ClashKind::clearance:
        return 0.05 * share;
    case ClashKind::touch:
    case ClashKind::duplicate:
    case ClashKind::undecided:
        break;
    }
    return 0;
}

ClashReport make_report(const std::vector<Scene>& models, std::size_t count, std::mt19937& random) {
    // std::uniform_real_distribution is not used, because its values differ between standard
    // libraries.
    const auto share = [&] { return random() / 4294967296.0; };
    const auto point = [&] { return abut::Vec3{80 * share(), 45 * share(), 18 * share()}; };
    ClashReport report;
    for (const Scene& model : models)
        report.models.push_back({model.file, model.parts.size(), model.parts.size() * 262});
    report.clearance = 0.05;
    report.candidates = count * 7 / 2;
    for (std::size_t i = 0; i < count; ++i) {
        constexpr ClashKind kOften[] = {
            ClashKind::hard,      ClashKind::hard,  ClashKind::clearance, ClashKind::clearance,
            ClashKind::clearance, ClashKind::touch, ClashKind::touch,     ClashKind::hard};
        Clash clash;
        clash.kind = kOften[random() % std::size(kOften)];
        if (i % 97 == 5)
            clash.kind = i % 2 == 0 ? ClashKind::contained : ClashKind::duplicate;
        clash.id = (std::uint64_t{random()} << 32) | random();
        clash.model = {0, static_cast<std::uint32_t>(1 + random() % (models.size() - 1))};
        for (std::size_t side = 0; side < 2; ++side)
            clash.part[side] =
                static_cast<std::uint32_t>(random() % models[clash.model[side]].parts.size());
        clash.distance = distance_of(clash.kind, share());
        clash.point_a = point();
        clash.point_b = point();
        clash.direction = {0.6, 0, -0.8};
        if (clash.kind == ClashKind::hard || clash.kind == ClashKind::touch)
            clash.triangle_pairs = 1 + random() % 240;
        if (i % 1000 == 7)
            clash.rule = "pipes through slabs";
        ++report.counts[static_cast<std::size_t>(clash.kind)];
        report.clashes.push_back(clash);
    }
    report.seconds = {0.912, 0.281, 0.043, 0.418, 1.671};
    report.peak_rss_mib = 412.3;
    return report;
}

/// Adds statuses as from a store, and a tenth as many resolved clashes.
void add_statuses(ClashReport& report, const std::vector<Scene>& models) {
    report.statuses.emplace();
    for (std::size_t i = 0; i < report.clashes.size(); ++i) {
        Clash& clash = report.clashes[i];
        clash.status = abut::kClashStatuses.at(i % 7 % 4);
        if (*clash.status == abut::ClashStatus::approved)
            clash.note = kHostileNames[i % std::size(kHostileNames)];
        ++report.statuses->at(static_cast<std::size_t>(*clash.status));
        if (i % 10 != 0)
            continue;
        abut::ListedClash gone;
        gone.id = ~clash.id;
        gone.kind = clash.kind;
        gone.status = abut::ClashStatus::resolved;
        gone.resolved = 1'700'000'000 - static_cast<std::int64_t>(i);
        for (std::size_t side = 0; side < 2; ++side) {
            const Part& part = models[clash.model.at(side)].parts[clash.part.at(side)];
            gone.part.at(side) = part.id;
            gone.name.at(side) = part.name;
            gone.file.at(side) = models[clash.model.at(side)].file;
        }
        report.resolved.push_back(gone);
    }
    report.statuses->at(static_cast<std::size_t>(abut::ClashStatus::resolved)) =
        report.resolved.size();
}

/// Gives the clashes cells of a matrix, severities and volumes, as find_clashes would, then groups.
void add_rules(ClashReport& report, const std::vector<Scene>& models) {
    ClashReport::Matrix matrix;
    matrix.groups = {"structure", "services", "<b>openings</b>"};
    matrix.cells = {{0, 0, false, 0, "", {}},
                    {0, 1, true, 0.05, "high", {}},
                    {1, 1, true, 0.025, "low", {}},
                    {1, 2, true, 0, "", {}}};
    for (std::size_t i = 0; i < report.clashes.size(); ++i) {
        Clash& clash = report.clashes[i];
        if (clash.kind == ClashKind::hard)
            clash.volume = 1e-6 * static_cast<double>(1 + i % 900);
        if (i % 5 == 4) {
            clash.rule = "pipes through slabs";
            continue;
        }
        ClashReport::Matrix::Cell& cell = matrix.cells[i % 5 < 3 ? 1 : 2];
        clash.rule = matrix.groups[cell.a] + " / " + matrix.groups[cell.b];
        clash.severity = cell.severity;
        ++cell.counts.at(static_cast<std::size_t>(clash.kind));
    }
    report.matrix = matrix;
    report.left_out.at(static_cast<std::size_t>(abut::LeftOut::off)) = 1234;
    const abut::GroupOptions options;
    report.grouping = options.by;
    report.groups = group_clashes(report, models, options);
    for (abut::ClashGroup& group : report.groups)
        group.change = abut::GroupChange::active;
    report.history = {{1'700'000'000, {400, 90, 5, 4, 300}, {799, 0, 0, 0, 0}, {30, 0, 0, 0, 0}},
                      {1'700'600'000, report.counts, *report.statuses, {4, 22, 2, 1, 3}}};
}

} // namespace

int main(int argc, char** argv) try {
    if (argc != 3 && argc != 4) {
        fmt::print(stderr, "usage: abut-make-report FOLDER COUNT [statuses|rules|building]\n");
        return 2;
    }
    const std::string folder = argv[1], kind = argc == 4 ? argv[3] : "";
    const std::size_t count = std::strtoull(argv[2], nullptr, 10);
    std::mt19937 random(20);
    std::vector<Scene> models;
    ClashReport report;
    if (kind == "building") {
        models = MadeBuilding(count, {std::begin(kHostileNames), std::end(kHostileNames)}).models;
        report = find_clashes(models, {});
    } else {
        models.push_back(
            make_scene("models/hospital_structure.glb", kBuilding, 300 + count / 20, random));
        models.push_back(
            make_scene("models/hospital_plumbing.glb", kServices, 200 + count / 10, random));
        models.push_back(
            make_scene("models/hospital_sprinklers.glb", kServices, 200 + count / 30, random));
        report = make_report(models, count, random);
    }
    if (kind == "statuses" || kind == "rules")
        add_statuses(report, models);
    if (kind == "rules")
        add_rules(report, models);
    write_clash_html(report, models, folder + "/report.html");
    write_clash_json(report, models, folder + "/report.json");
    write_clash_csv(report, models, folder + "/report.csv");
} catch (const abut::Error& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
}
