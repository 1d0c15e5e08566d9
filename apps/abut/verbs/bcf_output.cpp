#include "verbs/bcf_output.h"

#include <abut/error.h>
#include <abut/picture.h>

#include "arguments/interrupt.h"

#include <filesystem>

namespace abut::command {

namespace {

/// Pixels of a snapshot; the ratio is that of ViewpointOptions.
constexpr std::uint32_t kSnapshotWidth = 640, kSnapshotHeight = 400;

/// Draws the snapshots of viewpoints, as long as OpenGL is available.
class SnapshotMaker {
public:
    SnapshotMaker(const StoreClashReport& found, const std::optional<Store>& store,
                  std::vector<std::string>& warnings)
        : found_(found), store_(store), warnings_(warnings) {}

    std::string png_of(const ClashViewpoint& view) {
        if (!is_possible_)
            return "";
        throw_if_interrupted();
        try {
            if (!maker_ && store_)
                maker_.emplace(*store_);
            else if (!maker_)
                maker_.emplace(found_.models);
            return png_bytes(maker_->make(options_of(view)));
        } catch (const Error& error) {
            if (error.code() != ErrorCode::unsupported)
                throw;
            is_possible_ = false;
            warnings_.push_back(std::string("BCF without snapshots: ") + error.what());
            return "";
        }
    }

private:
    [[nodiscard]] NamedPart named(const ReportPart& part) const {
        const Scene& scene = found_.models.at(part.model);
        return {scene.file, scene.parts.at(part.part).id};
    }

    [[nodiscard]] PictureOptions options_of(const ClashViewpoint& view) const {
        SidesAim aim;
        aim.camera.eye = view.eye;
        aim.camera.forward = view.direction;
        aim.camera.up = view.up;
        aim.camera.field_of_view = view.fov;
        for (const ReportPart& part : view.side_a)
            aim.sides[0].push_back(named(part));
        for (const ReportPart& part : view.side_b)
            aim.sides[1].push_back(named(part));
        aim.around = view.near;
        PictureOptions options;
        options.aim = std::move(aim);
        options.width = kSnapshotWidth, options.height = kSnapshotHeight;
        options.ground = false;
        options.section_box = view.section_box;
        return options;
    }

    const StoreClashReport& found_;
    const std::optional<Store>& store_;
    std::vector<std::string>& warnings_;
    std::optional<PictureMaker> maker_; ///< made for the first picture
    bool is_possible_ = true;
};

BcfVersion parse_bcf_version(const std::string& text) {
    for (const BcfVersion version : {BcfVersion::v2_1, BcfVersion::v3_0})
        if (text == abut::to_string(version))
            return version;
    throw Error(ErrorCode::bad_argument, "--bcf-version", "'" + text + "' is neither 2.1 nor 3.0");
}

} // namespace

void add_bcf_options(CLI::App& app, const char* option, BcfArguments& arguments) {
    app.add_option(option, arguments.out,
                   "Write the groups of clashes as topics of a BCF file (docs/bcf.md); topics of "
                   "an earlier file are updated")
        ->check(not_empty("FILE"));
    app.add_option("--bcf-version", arguments.version, "Version of the BCF file: 2.1 or 3.0")
        ->check(not_empty("VERSION"))
        ->capture_default_str();
    app.add_option("--bcf-project", arguments.project, "Name of the project in the BCF file")
        ->check(not_empty("NAME"));
    app.add_option("--bcf-author", arguments.author, "Author of new topics in the BCF file")
        ->check(not_empty("NAME"))
        ->capture_default_str();
    app.add_flag("--no-snapshots", arguments.no_snapshots, "Write the BCF file without pictures");
    app.add_flag("--no-clipping", arguments.no_clipping,
                 "Write viewpoints without the planes of the section box");
}

BcfOutput::BcfOutput(const BcfArguments& arguments)
    : arguments_(arguments), version_(parse_bcf_version(arguments.version)) {
    const std::filesystem::path file(arguments.out);
    name_ = file.filename().string();
    if (name_.empty())
        throw Error(ErrorCode::bad_argument, arguments.out, "is a folder: a file is wanted");
    if (std::filesystem::exists(file))
        earlier_ = read_bcf(arguments.out);
    outputs_ = std::make_unique<OutputFiles>(file.parent_path(), std::vector{name_});
}

void BcfOutput::write(const StoreClashReport& found, const std::optional<Store>& store,
                      const Progress& progress, std::vector<std::string>& warnings) {
    SnapshotMaker snapshots(found, store, warnings);
    ClashBcfOptions options;
    options.author = arguments_.author;
    options.project = arguments_.project;
    options.clip = !arguments_.no_clipping;
    options.progress = progress;
    if (!arguments_.no_snapshots)
        options.snapshot = [&](const ClashViewpoint& view) { return snapshots.png_of(view); };
    BcfFile file =
        store ? clash_bcf(found, *store, options) : clash_bcf(found.report, found.models, options);
    if (earlier_)
        file = update_bcf(*earlier_, file);
    topics_ = file.topics.size();
    const InterruptScope scope(OnInterrupt::defer);
    outputs_->stage(name_, [&](const std::string& path) { write_bcf(file, path, version_); });
    throw_if_interrupted();
    outputs_->commit();
}

} // namespace abut::command
