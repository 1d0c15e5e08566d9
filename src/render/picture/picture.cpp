#include <abut/error.h>
#include <abut/picture.h>

#include "core/stop.h"
#include "math/vector.h"
#include "render/picture/framing.h"
#include "render/picture/picture_job.h"

#include <algorithm>
#include <map>
#include <string_view>
#include <utility>

namespace abut {

namespace {

constexpr std::uint32_t kMostPixels = 8192;

Vec3 middle_of(const Box3& box) {
    return is_empty(box) ? Vec3{} : 0.5 * box.lower + 0.5 * box.upper;
}

/// About the size of a common part: half of the median diagonal, within bounds of the whole.
double detail_of(const PictureModel& model) {
    std::vector<double> diagonals;
    for (const PicturePart& part : model.parts)
        if (!is_empty(part.view.box))
            diagonals.push_back(length(part.view.box.upper - part.view.box.lower));
    if (diagonals.empty())
        return 1;
    const auto median = diagonals.begin() + static_cast<std::ptrdiff_t>(diagonals.size() / 2);
    std::ranges::nth_element(diagonals, median);
    const double whole = length(model.bounds.upper - model.bounds.lower);
    const double detail = std::clamp(*median / 2, whole / 3000, whole / 25);
    return detail > 0 ? detail : 1;
}

const PictureOptions& checked(const PictureOptions& options) {
    if (options.width < 1 || options.height < 1 || options.width > kMostPixels ||
        options.height > kMostPixels)
        throw Error(ErrorCode::bad_argument, "a picture has 1 to 8192 pixels a side");
    if (options.sections.size() >= kMostSections)
        throw Error(ErrorCode::bad_argument, "a picture has at most 6 section planes");
    return options;
}

} // namespace

PictureStudio::PictureStudio(std::unique_ptr<PictureModel> shown)
    : model(std::move(shown)), renderer(model->parts.size(), middle_of(model->bounds)),
      stream(*model, middle_of(model->bounds)) {}
PictureStudio::~PictureStudio() {
    try {
        context.make_current();
    } catch (const Error&) { // current on another thread, which has the objects
    }
}

PictureJob::PictureJob(PictureStudio& studio, const PictureOptions& options)
    : model_(*studio.model), options_(checked(options)), renderer_(studio.renderer),
      stream_(studio.stream), opaque_(model_.parts.size(), true) {
    studio.context.make_current();
    const std::vector<Colour> colours = model_.colours(options.colour_by);
    for (std::uint32_t i = 0; i < model_.parts.size(); ++i)
        renderer_.set_state(i, {.colour = i < colours.size() ? colours[i] : Colour{200, 200, 200}});
}

RenderStyle PictureJob::style(bool with_ground) const {
    RenderStyle style;
    style.up = up_vector(model_.up);
    style.edges = options_.edges;
    style.ambient_occlusion = options_.ambient_occlusion;
    style.samples = options_.samples;
    style.detail = detail_of(model_);
    style.sections = options_.sections;
    style.section_box = options_.section_box;
    if (options_.distances) {
        const std::uint32_t from = find_part(model_, "", options_.distances->part);
        const PicturePart& part = model_.parts[from];
        style.distances = distances_from(from, Model(*model_.mesh(part.mesh)), part.world_from_mesh,
                                         options_.distances->reach);
    }
    if (options_.ground && with_ground && !is_empty(model_.bounds)) {
        const Box3& bounds = model_.bounds;
        const double diagonal = length(bounds.upper - bounds.lower);
        Vec3 middle = middle_of(bounds);
        // Slightly below, so that floors which lie on it are in front of it.
        const double drop = dot(style.up, middle - bounds.lower) + 1e-4 * diagonal;
        middle = middle - drop * style.up;
        if (diagonal > 0)
            style.ground = Ground{middle, 2.5 * diagonal};
    }
    return style;
}

Camera PictureJob::lens() const {
    Camera lens;
    lens.field_of_view = 0.7;
    lens.width = options_.width;
    lens.height = options_.height;
    return lens;
}

PictureScene PictureJob::aimed(NamedView view) {
    const ViewDirection direction = direction_of(view, model_.up);
    std::vector<Box3> boxes;
    boxes.reserve(model_.parts.size());
    for (const PicturePart& part : model_.parts)
        boxes.push_back(part.view.box);
    const Camera camera = fit_boxes(boxes, direction, lens());
    return {with_range(camera, model_.bounds), style(true), {}};
}

PictureScene PictureJob::aimed(const Camera& camera) {
    Camera sized = camera;
    sized.width = options_.width;
    sized.height = options_.height;
    return {with_range(sized, model_.bounds), style(true), {}};
}

PictureScene PictureJob::aimed(const PartAim& aim) {
    const std::uint32_t part = find_part(model_, "", aim.part);
    ghost_all_but(std::array{part});
    const ViewDirection direction = direction_of(NamedView::iso, model_.up);
    const Box3& box = model_.parts[part].view.box;
    const Camera camera =
        fit_boxes(std::array{grown(box, 0.1 * length(box.upper - box.lower))}, direction, lens());
    return {with_range(camera, model_.bounds), style(false), {}};
}

void PictureJob::ghost_all_but(std::span<const std::uint32_t> parts) {
    for (std::uint32_t i = 0; i < opaque_.size(); ++i) {
        opaque_[i] = std::ranges::find(parts, i) != parts.end();
        PartState state = renderer_.state(i);
        state.ghosted = !opaque_[i];
        renderer_.set_state(i, state);
    }
}

void PictureJob::draw(const PictureScene& scene) {
    const DrawnCamera camera(scene.camera);
    renderer_.begin(scene.camera, scene.style);
    stream_.visit(
        camera, opaque_, [&](const ViewFrame& frame) { renderer_.add(frame); }, options_.progress);
    if (!renderer_.has_ghosts())
        return;
    std::vector<bool> ghosts = ghosts_;
    if (ghosts.empty()) {
        ghosts = opaque_;
        ghosts.flip();
    }
    stream_.visit(
        camera, ghosts, [&](const ViewFrame& frame) { renderer_.add_ghosts(frame); },
        options_.progress);
}

PictureScene PictureJob::aimed(const SidesAim& aim) {
    std::map<std::pair<std::string_view, std::string_view>, std::uint32_t> numbers;
    for (std::uint32_t i = 0; i < model_.parts.size(); ++i)
        numbers.emplace(std::pair(std::string_view(model_.parts[i].view.file),
                                  std::string_view(model_.parts[i].view.id)),
                        i);
    const auto number_of = [&](const NamedPart& part) {
        const auto found = numbers.find({part.file, part.id});
        if (found == numbers.end())
            throw Error(ErrorCode::bad_argument,
                        "no part of " + part.file + " has the id '" + part.id + "'");
        return found->second;
    };
    ghosts_.assign(opaque_.size(), false);
    for (const NamedPart& part : aim.around)
        ghosts_[number_of(part)] = true;
    std::vector<std::uint32_t> shown;
    for (const std::vector<NamedPart>& side : aim.sides)
        for (const NamedPart& part : side)
            shown.push_back(number_of(part));
    ghost_all_but(shown);
    for (std::size_t side = 0; side < 2; ++side)
        for (const NamedPart& part : aim.sides.at(side)) {
            const std::uint32_t number = number_of(part);
            ghosts_[number] = false;
            renderer_.set_state(number, {.colour = side == 0 ? kSideA : kSideB});
        }
    Camera sized = aim.camera;
    sized.width = options_.width;
    sized.height = options_.height;
    return {with_range(sized, model_.bounds), style(false), {}};
}

PictureScene PictureJob::aimed() {
    return std::visit([&](const auto& aim) { return aimed(aim); }, options_.aim);
}

Picture PictureJob::run() {
    const PictureScene scene = aimed();
    draw(scene);
    Picture picture = renderer_.end_picture(scene.marks);
    if (options_.progress.report)
        options_.progress.report("draw", 1);
    return picture;
}

PictureMaker::PictureMaker(const std::vector<Scene>& models)
    : studio_(std::make_unique<PictureStudio>(picture_model(models))) {}
PictureMaker::PictureMaker(const Store& store)
    : studio_(std::make_unique<PictureStudio>(picture_model(store))) {}
PictureMaker::~PictureMaker() = default;

Picture PictureMaker::make(const PictureOptions& options) {
    const StopScope stop(options.progress);
    PictureOptions drawn = options;
    if (options.progress.report)
        drawn.progress.report = [&](std::string_view stage, double fraction) {
            options.progress.report(stage, fraction);
            studio_->context.make_current(); // the function may have drawn another picture
        };
    return PictureJob(*studio_, drawn).run();
}

Picture picture(const std::vector<Scene>& models, const PictureOptions& options) {
    return PictureMaker(models).make(options);
}

Picture picture(const Store& store, const PictureOptions& options) {
    return PictureMaker(store).make(options);
}

} // namespace abut
