#include <abut/error.h>
#include <abut/mesh.h>
#include <abut/scene.h>

#include "arguments/interrupt.h"
#include "commands.h"
#include "pair/pieces_queries.h"
#include "text/properties_text.h"
#include "verbs/info_store.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <memory>

namespace abut::command {

namespace {

struct InfoArguments {
    std::vector<std::string> files;
    bool parts = false;
    bool verify = false;
    bool pieces = false;     ///< also describes the convex pieces of each mesh
    bool properties = false; ///< also lists the properties that parts have
    ReadOptions read;
};

/// The totals of a file over all its parts. `stored_triangles` counts each mesh only once.
struct FileInfo {
    std::size_t stored_triangles = 0;
    std::size_t closed_parts = 0;
    MeshReport sum; ///< over the parts; only counts and bounds are filled in
};

Vec3 apply(const Transform& t, const Vec3& p) {
    const auto& m = t.m;
    return {m[0] * p.x + m[3] * p.y + m[6] * p.z + m[9],
            m[1] * p.x + m[4] * p.y + m[7] * p.z + m[10],
            m[2] * p.x + m[5] * p.y + m[8] * p.z + m[11]};
}

void grow(Box3& box, const Vec3& lower, const Vec3& upper) {
    box.lower = {std::min(box.lower.x, lower.x), std::min(box.lower.y, lower.y),
                 std::min(box.lower.z, lower.z)};
    box.upper = {std::max(box.upper.x, upper.x), std::max(box.upper.y, upper.y),
                 std::max(box.upper.z, upper.z)};
}

Box3 world_bounds(const Mesh& mesh, const Transform& world_from_mesh) {
    Box3 box;
    for (const auto& triangle : mesh.triangles)
        for (const std::uint32_t corner : triangle) {
            const Vec3 p = apply(world_from_mesh, mesh.positions[corner]);
            grow(box, p, p);
        }
    return box;
}

/// Returns how far coordinates of a model may be off, in metres: by the precision that its file states, or
/// by single precision.
double rounding_of(const Scene& scene) {
    double rounding = scene.precision.stated;
    if (!scene.precision.single_meshes)
        return rounding;
    std::vector<double> reach; // of each mesh
    for (const Mesh& mesh : scene.meshes) {
        double& most = reach.emplace_back(0);
        for (const Vec3& p : mesh.positions)
            most = std::max({most, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    }
    for (const Part& part : scene.parts) {
        double stretch = 0;
        for (std::size_t i = 0; i < 9; ++i)
            stretch = std::max(stretch, std::abs(part.world_from_mesh.m.at(i)));
        rounding = std::max(rounding, 0x1p-24 * stretch * reach[part.mesh]);
    }
    return rounding;
}

std::vector<MeshReport> inspect_all(const std::vector<Mesh>& meshes) {
    std::vector<MeshReport> reports;
    reports.reserve(meshes.size());
    for (const Mesh& mesh : meshes)
        reports.push_back(inspect(mesh));
    return reports;
}

FileInfo sum_up(const Scene& scene, const std::vector<MeshReport>& reports) {
    FileInfo info;
    for (const Mesh& mesh : scene.meshes)
        info.stored_triangles += mesh.triangles.size();
    for (const Part& part : scene.parts) {
        const MeshReport& report = reports[part.mesh];
        info.closed_parts += report.closed ? 1 : 0;
        info.sum.triangles += report.triangles;
        info.sum.degenerate_triangles += report.degenerate_triangles;
        info.sum.duplicate_triangles += report.duplicate_triangles;
        info.sum.boundary_edges += report.boundary_edges;
        info.sum.nonmanifold_edges += report.nonmanifold_edges;
        info.sum.flipped_edges += report.flipped_edges;
        const Box3 box = world_bounds(scene.meshes[part.mesh], part.world_from_mesh);
        grow(info.sum.bounds, box.lower, box.upper);
    }
    return info;
}

nlohmann::ordered_json describe(const Box3& box) {
    return {{"lower", to_json(box.lower)}, {"upper", to_json(box.upper)}};
}

void add_counts(nlohmann::ordered_json& to, const MeshReport& report) {
    to["degenerate_triangles"] = report.degenerate_triangles;
    to["duplicate_triangles"] = report.duplicate_triangles;
    to["boundary_edges"] = report.boundary_edges;
    to["nonmanifold_edges"] = report.nonmanifold_edges;
    to["flipped_edges"] = report.flipped_edges;
}

nlohmann::ordered_json describe_parts(const Scene& scene, const std::vector<MeshReport>& reports) {
    nlohmann::ordered_json parts = nlohmann::ordered_json::array();
    for (std::uint32_t i = 0; i < scene.parts.size(); ++i) {
        const Part& part = scene.parts[i];
        const MeshReport& report = reports[part.mesh];
        nlohmann::ordered_json row{{"id", part.id},
                                   {"name", part.name},
                                   {"type", part.type},
                                   {"mesh", part.mesh},
                                   {"triangles", report.triangles},
                                   {"closed", report.closed},
                                   {"components", report.components}};
        add_counts(row, report);
        row["colour"] = part.colour ? nlohmann::ordered_json(to_string(*part.colour)) : nullptr;
        row["bounds"] = describe(world_bounds(scene.meshes[part.mesh], part.world_from_mesh));
        row["properties"] = properties_json(scene, i);
        parts.push_back(std::move(row));
    }
    return parts;
}

nlohmann::ordered_json describe(const Scene& scene, const std::vector<MeshReport>& reports,
                                const FileInfo& info, bool with_parts) {
    nlohmann::ordered_json file{{"file", scene.file},
                                {"unit", scene.unit},
                                {"up", abut::to_string(scene.up)},
                                {"parts", scene.parts.size()},
                                {"meshes", scene.meshes.size()},
                                {"triangles", info.sum.triangles},
                                {"stored_triangles", info.stored_triangles},
                                {"closed_parts", info.closed_parts}};
    add_counts(file, info.sum);
    file["bounds"] = describe(info.sum.bounds);
    file["notes"] = to_json(scene.notes);
    file["project"] = scene.project;
    file["map_from_project"] = scene.map_from_project.m;
    if (with_parts) {
        file["part_list"] = describe_parts(scene, reports);
        file["relations"] = relations_json(scene);
    }
    return file;
}

std::string table(const Scene& scene, const std::vector<MeshReport>& reports, const FileInfo& info,
                  bool with_parts) {
    std::string text =
        fmt::format("{}\n"
                    "  frame       {:>12}  up; metres ({} in a unit of the file)\n"
                    "  parts       {:>12}  ({} closed), {} meshes\n"
                    "  triangles   {:>12}  ({} stored)\n"
                    "  degenerate  {:>12}  triangles of zero area\n"
                    "  duplicate   {:>12}  triangles\n"
                    "  edges       {:>12}  boundary, {} non-manifold, {} flipped\n"
                    "  bounds      {}\n",
                    shown(scene.file), abut::to_string(scene.up), number(scene.unit),
                    grouped(scene.parts.size()), grouped(info.closed_parts),
                    grouped(scene.meshes.size()), grouped(info.sum.triangles),
                    grouped(info.stored_triangles), grouped(info.sum.degenerate_triangles),
                    grouped(info.sum.duplicate_triangles), grouped(info.sum.boundary_edges),
                    grouped(info.sum.nonmanifold_edges), grouped(info.sum.flipped_edges),
                    box_text(info.sum.bounds.lower, info.sum.bounds.upper, rounding_of(scene)));
    text += in_words(scene.notes, "  ");
    if (!with_parts)
        return text;
    text += fmt::format("\n  {:>9} {:>6} {:>10} {:>9} {:>8} {:>12} {:>7}  part\n", "triangles",
                        "closed", "degenerate", "duplicate", "boundary", "non-manifold", "flipped");
    constexpr std::size_t kNumbers = 71; // columns in front of a part's name
    const auto columns = static_cast<std::size_t>(columns_of(stdout));
    for (const Part& part : scene.parts) {
        const MeshReport& report = reports[part.mesh];
        const std::string name =
            shown(part.name) + (part.type.empty() ? "" : "  ") + shown(part.type);
        const bool is_narrow = columns > 0 && columns < kNumbers + name.size();
        text +=
            fmt::format("  {:>9} {:>6} {:>10} {:>9} {:>8} {:>12} {:>7}{}{}\n", report.triangles,
                        report.closed ? "yes" : "no", report.degenerate_triangles,
                        report.duplicate_triangles, report.boundary_edges, report.nonmanifold_edges,
                        report.flipped_edges, is_narrow ? "\n      " : "  ", name);
    }
    return text;
}

nlohmann::ordered_json all_pieces(const Scene& scene) {
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    for (const Mesh& mesh : scene.meshes)
        rows.push_back(describe_pieces(mesh));
    return rows;
}

std::string pieces_table(const nlohmann::ordered_json& rows) {
    std::string text = fmt::format("\n  {:>9} {:>9} {:>9}  convex pieces by mesh\n", "pieces",
                                   "triangles", "largest");
    for (const auto& row : rows) {
        const auto triangles = grouped(row["triangles"].get<std::uint64_t>());
        text +=
            row.contains("error")
                ? fmt::format("  {:>9} {:>9} {:>9}  {}\n", "-", triangles, "-",
                              shown(row["error"].get<std::string>()))
                : fmt::format("  {:>9} {:>9} {:>9}\n", grouped(row["pieces"].get<std::uint64_t>()),
                              triangles, grouped(row["largest"].get<std::uint64_t>()));
    }
    return text;
}

int run(const InfoArguments& arguments, const CommonOptions& common) {
    const auto stores = static_cast<std::size_t>(
        std::count_if(arguments.files.begin(), arguments.files.end(), looks_like_store));
    if (stores == arguments.files.size())
        return describe_stores(arguments.files,
                               {arguments.verify, arguments.parts, arguments.properties}, common);
    if (stores > 0)
        throw Error(ErrorCode::bad_argument, "info takes models or stores, not both at once");
    if (arguments.verify)
        throw Error(ErrorCode::bad_argument, "--verify applies only to stores");
    ProgressBar bar(common.progress_style());
    std::vector<Scene> scenes;
    {
        const InterruptScope scope(OnInterrupt::ask);
        ReadOptions read = arguments.read;
        read.progress = bar.progress();
        scenes = read_scenes(parse_model_paths(arguments.files), read);
    }
    throw_if_interrupted();
    bar.finish();

    nlohmann::ordered_json files = nlohmann::ordered_json::array();
    std::string text;
    for (const Scene& scene : scenes) {
        const std::vector<MeshReport> reports = inspect_all(scene.meshes);
        const FileInfo info = sum_up(scene, reports);
        const nlohmann::ordered_json pieces =
            arguments.pieces ? all_pieces(scene) : nlohmann::ordered_json();
        if (common.json) {
            files.push_back(describe(scene, reports, info, arguments.parts));
            if (arguments.pieces)
                files.back()["convex_pieces"] = pieces;
            if (arguments.properties)
                files.back()["properties"] = to_json(property_uses({&scene, 1}));
        } else {
            text += (text.empty() ? "" : "\n") + table(scene, reports, info, arguments.parts);
            if (arguments.pieces)
                text += pieces_table(pieces);
            if (arguments.properties)
                text += command::table(property_uses({&scene, 1}));
        }
    }
    if (common.json)
        print_json(dump({{"files", std::move(files)}}));
    else if (!common.quiet)
        print_text(text);
    return kExitDone;
}

} // namespace

Subcommand add_info(CLI::App& root, CommonOptions& common) {
    auto arguments = std::make_shared<InfoArguments>();
    CLI::App* app =
        add_subcommand(root, common,
                       {"info",
                        kModels,
                        "The contents of models or stores: parts, triangles, bounds, defects",
                        {{"abut info model.glb --parts", "totals, and a row for each part"},
                         {"abut info model.glb --properties",
                          "the storeys, systems and property sets of the parts"},
                         {"abut info site.abut --verify", "checks a whole store for damage"}},
                        ""});
    app->add_option("MODEL", arguments->files, fmt::format("Models ({}), or stores", kModelHelp))
        ->required();
    app->add_flag("--parts", arguments->parts,
                  "Print a row for each part; with --json also its properties and relations");
    app->add_flag("--properties", arguments->properties,
                  "List the properties that parts have, with their most frequent values");
    app->add_flag("--verify", arguments->verify,
                  "For stores: check every page, row and mesh block");
    app->add_flag("--pieces", arguments->pieces, "Print the number of convex pieces of each mesh");
    add_read_options(*app, arguments->read);
    return {app, [arguments, &common] { return run(*arguments, common); }};
}

} // namespace abut::command
