#include <abut/clash_review.h>
#include <abut/error.h>
#include <abut/picture.h>

#include "arguments/choice.h"
#include "arguments/interrupt.h"
#include "arguments/output_files.h"
#include "commands.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <memory>

namespace abut::command {

namespace {

struct PictureArguments {
    std::vector<std::string> files; ///< models, or one store
    std::string out, clash, part, eye, look, section_box;
    std::string size = "1600x1000";
    NamedView view = NamedView::iso;
    ColourBy colour_by = ColourBy::material;
    std::string distances_from;
    double clearance = 0, reach = 1;
    bool plain = false;
    ReadOptions read;
};

constexpr std::array<Named<NamedView>, 7> kViews{{{"iso", NamedView::iso},
                                                  {"front", NamedView::front},
                                                  {"back", NamedView::back},
                                                  {"left", NamedView::left},
                                                  {"right", NamedView::right},
                                                  {"top", NamedView::top},
                                                  {"bottom", NamedView::bottom}}};
constexpr std::array<Named<ColourBy>, 6> kColours{{{"material", ColourBy::material},
                                                   {"type", ColourBy::type},
                                                   {"file", ColourBy::file},
                                                   {"part", ColourBy::part},
                                                   {"storey", ColourBy::storey},
                                                   {"clash", ColourBy::clash}}};

/// What is drawn: exactly one of both.
struct PictureInput {
    std::vector<Scene> models;
    std::optional<Store> store;
};

Error no_such_clash(const std::string& id, const std::string& hint) {
    return {ErrorCode::bad_argument, "--clash", "there is no clash " + id + hint};
}

PairAim clash_in_store(const Store& store, const std::string& file, std::uint64_t id) {
    for (const ClashReview& review : review_clashes(store))
        for (const ListedClash& clash : review.clashes)
            if (clash.id == id && clash.status != ClashStatus::resolved)
                return {clash.file, clash.part, std::nullopt};
    throw no_such_clash(clash_id_text(id), " in the last job of " + file);
}

PairAim clash_in_models(std::vector<Scene>& models, double clearance, std::uint64_t id,
                        const Progress& progress) {
    into_one_frame(models);
    const ClashReport report = find_clashes(models, {.clearance = clearance, .progress = progress});
    for (const Clash& clash : report.clashes)
        if (clash.id == id) {
            PairAim aim;
            for (std::size_t side = 0; side < 2; ++side) {
                const Scene& scene = models.at(clash.model.at(side));
                aim.file.at(side) = scene.file;
                aim.part.at(side) = scene.parts.at(clash.part.at(side)).id;
            }
            aim.points = {clash.point_a, clash.point_b};
            return aim;
        }
    throw no_such_clash(clash_id_text(id), " (a clearance clash needs --clearance)");
}

/// The camera of --eye and --look, with the up direction of the input.
Camera camera_of(const PictureArguments& arguments, UpAxis up) {
    Camera camera;
    camera.eye = parse_point("--eye", arguments.eye);
    const Vec3 look = parse_point("--look", arguments.look);
    camera.forward = {look.x - camera.eye.x, look.y - camera.eye.y, look.z - camera.eye.z};
    camera.up = {up == UpAxis::x ? 1.0 : 0, up == UpAxis::y ? 1.0 : 0, up == UpAxis::z ? 1.0 : 0};
    const Vec3& f = camera.forward;
    const double across = std::abs(up == UpAxis::x ? f.y : f.x) + // zero: it looks up or down
                          std::abs(up == UpAxis::z ? f.y : f.z);
    if (f == Vec3{})
        throw Error(ErrorCode::bad_argument, "--look", "is the same point as --eye");
    if (across == 0)
        camera.up = up == UpAxis::z ? Vec3{0, 1, 0} : Vec3{0, 0, -1};
    return camera;
}

/// A number of pixels; 0 if the text is none from 1 to 8192.
std::uint32_t parse_side(std::string_view text) {
    std::uint32_t value = 0;
    const char* end = text.data() + text.size();
    const auto [rest, fault] = std::from_chars(text.data(), end, value);
    return fault == std::errc() && rest == end && value <= 8192 ? value : 0;
}

void set_size(const std::string& text, PictureOptions& options) {
    const std::size_t cross = std::min(text.find('x'), text.size());
    options.width = parse_side(std::string_view(text).substr(0, cross));
    options.height = parse_side(std::string_view(text).substr(std::min(cross + 1, text.size())));
    if (options.width == 0 || options.height == 0)
        throw Error(ErrorCode::bad_argument, "--size",
                    "'" + text + "' is not WIDTHxHEIGHT, each from 1 to 8192");
}

/// Checks all that can be checked before a model is read.
PictureOptions options_of(const PictureArguments& arguments) {
    PictureOptions options;
    set_size(arguments.size, options);
    options.colour_by = arguments.colour_by;
    options.aim = arguments.view;
    options.ground = options.edges = options.ambient_occlusion = !arguments.plain;
    if (!arguments.section_box.empty()) {
        const std::vector<double> b =
            parse_numbers("--section-box", arguments.section_box, "x0,y0,z0,x1,y1,z1", 6);
        options.section_box = Box3{{b[0], b[1], b[2]}, {b[3], b[4], b[5]}};
    }
    if (!arguments.distances_from.empty())
        options.distances = PartDistances{arguments.distances_from, arguments.reach};
    if (!arguments.eye.empty())
        (void)camera_of(arguments, UpAxis::z);
    if (!arguments.clash.empty() && !parse_clash_id(arguments.clash))
        throw Error(ErrorCode::bad_argument, "--clash",
                    "'" + arguments.clash + "' is not a clash id: 16 hexadecimal digits");
    return options;
}

PictureInput read(const PictureArguments& arguments, const Progress& progress) {
    if (arguments.files.size() == 1 && is_store(arguments.files.front()))
        return {{}, open_store(arguments.files.front())};
    for (const std::string& file : arguments.files)
        if (is_store(file))
            throw Error(ErrorCode::bad_argument, file,
                        "is a store, and can be drawn only on its own");
    ReadOptions read = arguments.read;
    read.progress = progress;
    return {read_scenes(parse_model_paths(arguments.files), read), std::nullopt};
}

Picture draw(const PictureArguments& arguments, PictureOptions options, ProgressBar& bar) {
    const InterruptScope scope(OnInterrupt::ask);
    options.progress = bar.progress();
    PictureInput input = read(arguments, options.progress);
    const auto up_of = [&] {
        return input.store ? summary(*input.store).up : input.models.front().up;
    };
    if (!arguments.eye.empty())
        options.aim = camera_of(arguments, up_of());
    if (!arguments.part.empty())
        options.aim = PartAim{arguments.part};
    if (!arguments.clash.empty()) {
        const std::uint64_t id = parse_clash_id(arguments.clash).value();
        options.aim =
            input.store ? clash_in_store(*input.store, arguments.files.front(), id)
                        : clash_in_models(input.models, arguments.clearance, id, options.progress);
    }
    return input.store ? picture(*input.store, options) : picture(input.models, options);
}

int run(const PictureArguments& arguments, const CommonOptions& common) {
    const PictureOptions options = options_of(arguments);
    const std::filesystem::path file(arguments.out);
    if (!file.has_filename() || file.extension() != ".png")
        throw Error(ErrorCode::bad_argument, arguments.out,
                    "cannot be written: a picture is written as FILE.png");
    const std::string name = file.filename().string();
    OutputFiles outputs(file.parent_path(), {name});
    const Stopwatch watch;
    ProgressBar bar(common.progress_style());
    const Picture drawn = draw(arguments, options, bar);
    throw_if_interrupted();
    {
        const InterruptScope scope(OnInterrupt::defer);
        outputs.stage(name, [&](const std::string& path) { write_png(drawn, path); });
        throw_if_interrupted();
        outputs.commit();
    }
    bar.finish();
    if (common.json)
        print_json(dump({{"models", arguments.files},
                         {"picture", outputs.path(name)},
                         {"width", drawn.width},
                         {"height", drawn.height},
                         {"seconds", watch.seconds()},
                         {"peak_rss_mib", peak_resident_mib()}}));
    else if (!common.quiet)
        print_text(fmt::format("{}  {} x {} pixels\n", shown(outputs.path(name)), drawn.width,
                               drawn.height));
    return kExitDone;
}

void add_aims(CLI::App& app, PictureArguments& arguments) {
    add_choice(app, "--view", arguments.view, kViews, "Direction from which the whole is seen");
    CLI::Option* view = app.get_option("--view");
    CLI::Option* clash =
        app.add_option("--clash", arguments.clash,
                       "Show a clash, by its id: both parts in red and blue, the rest as ghosts")
            ->check(not_empty("ID"));
    CLI::Option* part = app.add_option("--part", arguments.part,
                                       "Show a part, by its id or name; the rest as ghosts")
                            ->check(not_empty("NAME"));
    CLI::Option* eye = app.add_option("--eye", arguments.eye, "Where the camera is: x,y,z")
                           ->check(not_empty("POINT"));
    CLI::Option* look = app.add_option("--look", arguments.look, "A point that it looks at: x,y,z")
                            ->check(not_empty("POINT"));
    eye->needs(look);
    look->needs(eye);
    for (CLI::Option* one : {view, clash, part, eye})
        for (CLI::Option* other : {view, clash, part, eye})
            if (one != other)
                one->excludes(other);
    add_length(app, "--clearance", arguments.clearance,
               "With --clash and models: the clearance of the job that found it");
}

} // namespace

Subcommand add_picture(CLI::App& root, CommonOptions& common) {
    auto arguments = std::make_shared<PictureArguments>();
    CLI::App* app =
        add_subcommand(root, common,
                       {"picture",
                        kModels,
                        "Draw a picture of models or of a store",
                        {{"abut picture design.glb pipes.glb --out site.png", "all of two models"},
                         {"abut picture site.abut --clash 0123456789abcdef --out clash.png",
                          "a clash of a store's last job, by its id in a report"}},
                        ""});
    app->add_option("MODEL", arguments->files, fmt::format("Models ({}), or one store", kModelHelp))
        ->required();
    app->add_option("--out", arguments->out, "The picture: FILE.png")
        ->required()
        ->check(not_empty("FILE"));
    add_aims(*app, *arguments);
    app->add_option("--size", arguments->size, "Size in pixels (default 1600x1000)")
        ->check(not_empty("WxH"));
    add_choice(*app, "--color-by", arguments->colour_by, kColours,
               "What gives parts their colours");
    app->add_option("--section-box", arguments->section_box,
                    "Cut away what lies outside of a box: x0,y0,z0,x1,y1,z1")
        ->check(not_empty("BOX"));
    CLI::Option* from =
        app->add_option("--distances-from", arguments->distances_from,
                        "Colour surfaces by their distance from a part, by its id or name")
            ->check(not_empty("NAME"));
    add_length(*app, "--reach", arguments->reach,
               "With --distances-from: the distance up to which there are colours");
    app->get_option("--reach")->needs(from);
    app->add_flag("--plain", arguments->plain, "No edges, ground and ambient occlusion");
    add_read_options(*app, arguments->read);
    return {app, [arguments, &common] { return run(*arguments, common); }};
}

} // namespace abut::command
