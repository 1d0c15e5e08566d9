#include "view/level_view.h"

#include <abut/error.h>

#include "core/arguments.h"
#include "core/stop.h"
#include "core/stop_watch.h"
#include "math/vector.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace abut {

namespace {

/// The share of the renderer's memory that a cut with its ancestors, or a plan, may take.
constexpr std::uint64_t share_of(std::uint64_t gpu_memory) {
    return gpu_memory - gpu_memory / 8;
}

/// Chunks are read ahead for errors down to this share of the largest one of a cut. It is less than
/// what a full cut replaces, as the next cut may have a smaller error.
constexpr double kPlannedError = 0.35;

/// The share of the memory that occluders may take.
constexpr std::uint64_t occluder_memory(const ViewOptions& options) {
    return options.memory / 16;
}

LevelTree checked(LevelTree tree, const std::string& name) {
    check_level_tree(tree, name);
    return tree;
}

ViewOptions checked(const ViewOptions& options) {
    require(options.pixel_error > 0 && std::isfinite(options.pixel_error),
            "pixel error must be positive, and finite");
    require(options.look_ahead >= 0 && std::isfinite(options.look_ahead),
            "seconds to look ahead must not be negative, and finite");
    return options;
}

} // namespace

LevelView::LevelView(LevelTree tree, ChunkSource source, const std::string& name,
                     const ViewOptions& options, Reader reader)
    : tree_(checked(std::move(tree), name)), options_(checked(options)),
      table_(tree_.chunks.size()), residency_(tree_, table_, options.gpu_memory),
      occluders_(occluder_memory(options)), cut_(tree_), hidden_(tree_.parts.size()),
      marks_(tree_.chunks.size()), draw_of_(tree_.chunks.size()),
      loader_(tree_, table_, std::move(source),
              {name, room(name), share_of(options.gpu_memory), options.look_ahead,
               options.background && reader == Reader::background}) {
    table_bytes_ = options_.memory - room(name);
}

std::uint64_t LevelView::room(const std::string& name) const {
    std::uint64_t largest = 0;
    for (const ChunkSize& size : tree_.chunks)
        largest = std::max(largest, size.bytes() + kMostOccluderBytes);
    const std::uint64_t tables = tree_.bytes() + table_.bytes() + residency_.own_bytes() +
                                 cut_.bytes() + LoadPlan::most_bytes(tree_) + hidden_.size() / 8 +
                                 (marks_.capacity() + draw_of_.capacity()) * sizeof(std::uint32_t);
    const auto in_mib = [](std::uint64_t bytes) { return std::to_string((bytes >> 20) + 1); };
    if (tables + 2 * largest > options_.memory)
        throw Error(ErrorCode::bad_argument, name,
                    "viewing it needs at least " + in_mib(tables + 2 * largest) +
                        " MiB of memory: for the tree of levels and the largest chunk");
    const std::uint32_t root = tree_.nodes.empty() ? kNoChunk : tree_.nodes[0].chunk;
    const std::uint64_t least = root == kNoChunk ? 0 : tree_.chunks[root].bytes();
    if (least > share_of(options_.gpu_memory))
        throw Error(ErrorCode::bad_argument, name,
                    "viewing it needs at least " + in_mib(least + least / 7) +
                        " MiB of the renderer's memory: for the coarsest level");
    return options_.memory - tables;
}

CutLimits LevelView::limits() const {
    return {options_.pixel_error, options_.triangle_budget, options_.draw_budget,
            share_of(options_.gpu_memory)};
}

NotDrawn LevelView::not_drawn() const {
    return {&hidden_, has_occlusion_ && !occluders_.empty() ? &occlusion_ : nullptr};
}

const ViewFrame& LevelView::frame(const CameraMotion& motion) {
    const StopWatch watch;
    const ViewPoint view(motion.camera, tree_.origin);
    require(is_finite(motion.velocity) && is_finite(motion.turning),
            "velocity of the eye is not finite");
    loader_.throw_error();
    ++frame_number_;
    if (std::exchange(is_delivered_, false)) {
        uploads_.clear();
        residency_.drops().clear();
    }
    residency_.begin_frame(frame_number_);
    choose(motion.camera, view);
    if (options_.background)
        upload(motion);
    else
        upload_at_once();
    has_waited_ = false;
    draw(view);
    list_draws();
    finish(watch.seconds());
    return frame_;
}

/// Chooses the cut, and notes which of its chunks are missing.
void LevelView::choose(const Camera& camera, const ViewPoint& view) {
    if (has_occlusion_)
        occluders_.draw(occlusion_, camera, tree_.origin, hidden_);
    cut_.choose(view, limits(), not_drawn());
    statistics_.culled_by_frustum = cut_.outside();
    statistics_.culled_by_occlusion = cut_.occluded();
    list_chunks();
}

/// Returns whether the chunk was not marked before in this pass.
bool LevelView::mark(std::uint32_t chunk) {
    return chunk != kNoChunk && std::exchange(marks_[chunk], pass_) != pass_;
}

void LevelView::list_chunks() {
    wanted_.clear();
    request_.wanted.clear();
    if (!tree_.nodes.empty() && tree_.nodes[0].chunk != kNoChunk)
        table_.touch(tree_.nodes[0].chunk, frame_number_); // the root always stays
    ++pass_;
    for (const CutEntry& entry : cut_.entries())
        if (mark(entry.chunk)) {
            table_.touch(entry.chunk, frame_number_);
            if (table_.state(entry.chunk) != ChunkState::resident)
                request_.wanted.push_back(entry.chunk);
        }
    ++pass_;
    for (const CutEntry& entry : cut_.entries())
        if (!entry.is_replaced && mark(entry.chunk))
            wanted_.push_back(entry.chunk);
}

/// Takes what the other thread has read, and tells it what is missing.
void LevelView::upload(const CameraMotion& motion) {
    const std::uint64_t most = has_waited_ ? options_.gpu_memory : options_.upload_budget;
    std::uint64_t bytes = 0;
    std::vector<std::uint32_t> first;
    for (const std::uint32_t chunk : request_.wanted) {
        const std::uint64_t size = tree_.chunks[chunk].bytes();
        if (table_.state(chunk) != ChunkState::staged)
            continue;
        if (!first.empty() && bytes + size > most)
            break;
        first.push_back(chunk);
        bytes += size;
    }
    if (residency_.make_room(bytes, frame_number_) < bytes)
        first.clear(), bytes = 0; // only without a coarsest chunk: then a cut has no limit
    const std::uint64_t others = std::min(most - std::min(most, bytes), loader_.staged_bytes());
    const std::uint64_t room = residency_.make_room(bytes + others, loader_.plan_frame());
    request_.motion = motion;
    request_.pixel_error = std::max(options_.pixel_error, kPlannedError * cut_.error());
    request_.frame = frame_number_;
    auto taken = loader_.exchange(first, std::min(others, room - bytes), request_, has_waited_);
    is_request_refused_ = !taken;
    if (!taken)
        return;
    counters_ = taken->counters;
    for (ReadChunk& chunk : taken->chunks)
        take(std::move(chunk));
}

void LevelView::take(ReadChunk chunk) {
    residency_.add(chunk.chunk);
    occluders_.add(chunk.chunk, std::move(chunk.occluders));
    uploads_.push_back({chunk.chunk, std::move(chunk.data)});
}

/// Reads all that is missing, as far as the memory allows.
void LevelView::upload_at_once() {
    loader_.forget_taken();
    for (const std::uint32_t chunk : wanted_) {
        const ChunkState state = table_.state(chunk);
        if (state != ChunkState::absent)
            continue;
        poll_stop();
        const std::uint64_t bytes = tree_.chunks[chunk].bytes();
        if (residency_.make_room(bytes, frame_number_) < bytes)
            break;
        auto loaded = loader_.read_now(chunk);
        if (!loaded)
            break;
        take(std::move(*loaded));
    }
    counters_ = loader_.counters();
}

void LevelView::draw(const ViewPoint& view) {
    std::uint64_t failed = 0;
    statistics_.wanted = wanted_.size();
    statistics_.missing = 0;
    for (const std::uint32_t chunk : wanted_) {
        statistics_.missing += table_.state(chunk) == ChunkState::resident ? 0 : 1;
        failed += table_.state(chunk) == ChunkState::failed ? 1 : 0;
    }
    frame_.loaded = statistics_.missing == failed;
    const auto is_there = [&](std::uint32_t chunk) {
        return table_.state(chunk) == ChunkState::resident;
    };
    drawn_.choose(cut_.entries(), is_there);
    bool is_cut = !drawn_.has_hole();
    frame_.pixel_error = 0;
    for (const std::uint32_t at : drawn_.drawn()) {
        const CutEntry& entry = cut_.entries()[at];
        is_cut = is_cut && !entry.is_replaced;
        frame_.pixel_error = std::max(frame_.pixel_error, double{entry.error});
    }
    frame_.complete = is_cut && frame_.pixel_error <= options_.pixel_error;
    if (!is_cut)
        fit_budgets(view);
}

bool LevelView::is_over_budget() {
    std::uint64_t triangles = 0, draws = 0;
    ++pass_;
    for (const std::uint32_t at : drawn_.drawn()) {
        const std::uint32_t chunk = cut_.entries()[at].chunk;
        triangles += tree_.chunks[chunk].triangles;
        draws += mark(chunk) ? 1 : 0;
    }
    return triangles > options_.triangle_budget || draws > options_.draw_budget;
}

/// A stand-in also covers what is not visible, so it may have more triangles than what it stands
/// for. Then the cut is chosen among the chunks that are there.
void LevelView::fit_budgets(const ViewPoint& view) {
    if (!is_over_budget())
        return;
    const auto is_there = [&](std::uint32_t chunk) {
        return table_.state(chunk) == ChunkState::resident;
    };
    NotDrawn of_these = not_drawn();
    of_these.is_there = is_there;
    cut_.choose(view, limits(), of_these);
    drawn_.choose(cut_.entries(), is_there);
    frame_.pixel_error = 0;
    for (const std::uint32_t at : drawn_.drawn())
        frame_.pixel_error = std::max(frame_.pixel_error, double{cut_.entries()[at].error});
}

/// Makes the draw calls: one for each chunk, with all its instances.
void LevelView::list_draws() {
    draws_.clear(), distances_.clear(), instances_.clear();
    const ViewItems items(tree_);
    ++pass_;
    std::uint64_t triangles = 0;
    for (const std::uint32_t at : drawn_.drawn()) {
        const CutEntry& entry = cut_.entries()[at];
        triangles += tree_.chunks[entry.chunk].triangles;
        if (mark(entry.chunk)) {
            draw_of_[entry.chunk] = static_cast<std::uint32_t>(draws_.size());
            draws_.push_back({entry.chunk, 0, 0});
            distances_.push_back(entry.distance);
        }
        const std::uint32_t draw = draw_of_[entry.chunk];
        distances_[draw] = std::min(distances_[draw], entry.distance);
        draws_[draw].instances += items.is_instance(entry.item) ? 1 : 0;
    }
    std::uint32_t count = 0;
    for (ChunkDraw& draw : draws_)
        draw.first_instance = std::exchange(count, count + std::exchange(draw.instances, 0));
    instances_.resize(count);
    for (const std::uint32_t at : drawn_.drawn()) {
        const CutEntry& entry = cut_.entries()[at];
        if (!items.is_instance(entry.item))
            continue;
        ChunkDraw& draw = draws_[draw_of_[entry.chunk]];
        instances_[draw.first_instance + draw.instances++] = items.instance(entry.item).placed;
    }
    std::sort(draws_.begin(), draws_.end(), [&](const ChunkDraw& a, const ChunkDraw& b) {
        const float to_a = distances_[draw_of_[a.chunk]];
        const float to_b = distances_[draw_of_[b.chunk]];
        return to_a != to_b ? to_a < to_b : a.chunk < b.chunk;
    });
    statistics_.triangles = triangles;
    statistics_.draw_calls = draws_.size();
}

void LevelView::finish(double seconds) {
    // An upload of a frame that failed may have been dropped since.
    std::erase_if(uploads_, [&](const ChunkUpload& upload) {
        return table_.state(upload.chunk) != ChunkState::resident;
    });
    for (const std::uint32_t chunk : residency_.drops())
        if (table_.state(chunk) != ChunkState::resident)
            occluders_.remove(chunk);
    frame_.uploads = uploads_;
    frame_.drops = residency_.drops();
    frame_.draws = draws_;
    frame_.instances = instances_;
    is_delivered_ = true;
    statistics_.lookups += statistics_.wanted;
    statistics_.misses += statistics_.missing;
    statistics_.bytes_loaded = counters_.bytes_loaded;
    statistics_.bytes = table_bytes_ + counters_.bytes;
    statistics_.peak_bytes = table_bytes_ + counters_.peak_bytes;
    statistics_.gpu_bytes = residency_.bytes();
    statistics_.peak_gpu_bytes = residency_.peak_bytes();
    statistics_.seconds_selecting = seconds;
}

Box3 LevelView::bounds() const {
    Box3 box;
    if (tree_.nodes.empty())
        return box;
    const auto& [lower, upper] = std::tie(tree_.nodes[0].lower, tree_.nodes[0].upper);
    extend(box, tree_.origin + Vec3{lower[0], lower[1], lower[2]});
    extend(box, tree_.origin + Vec3{upper[0], upper[1], upper[2]});
    return box;
}

void LevelView::wait() {
    if (std::exchange(is_request_refused_, false))
        loader_.ask(request_);
    loader_.wait();
    has_waited_ = true;
}

void LevelView::set_hidden(std::uint32_t part, bool hidden) {
    require(part < hidden_.size(), "there is no part " + std::to_string(part));
    hidden_[part] = hidden;
}

} // namespace abut
