#include "view/selection/level_cut.h"

#include "math/vector.h"
#include "view/selection/occlusion_buffer.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace abut {

namespace {

/// In a full cut, items with less than this share of the error of the first item that did not fit
/// stay: what fills the last gaps changes from frame to frame, and shows nothing.
constexpr double kSmallest = 0.5;

float bounded_float(double value) {
    return static_cast<float>(std::min(value, double{std::numeric_limits<float>::max()}));
}

/// Largest number of entries of a cut.
std::size_t count_items(const LevelTree& tree) {
    std::size_t count = tree.nodes.size();
    for (const LevelNode& node : tree.nodes)
        if (node.instance != kNoChunk)
            count += tree.meshes[tree.instances[node.instance].mesh].levels - 1;
    return count;
}

} // namespace

ViewPoint::ViewPoint(const Camera& camera, const Vec3& origin)
    : pixels_at_one(1 / length_of_pixel(camera)), near(camera.near) {
    const CameraFrame frame(camera);
    frustum = Frustum(frame, camera.near, camera.far, origin);
    right_ = frame.right, up_ = frame.up, forward_ = frame.forward;
    slope_x_ = frame.slope_x, slope_y_ = frame.slope_y;
    const Vec3 from_origin = camera.eye - origin;
    eye = {from_origin.x, from_origin.y, from_origin.z};
}

double ViewPoint::stretch(const LevelNode& node) const {
    double x = 0, y = 0;
    for (unsigned corner = 0; corner < 8; ++corner) {
        const Vec3 d{((corner & 1U) != 0 ? node.upper[0] : node.lower[0]) - eye[0],
                     ((corner & 2U) != 0 ? node.upper[1] : node.lower[1]) - eye[1],
                     ((corner & 4U) != 0 ? node.upper[2] : node.lower[2]) - eye[2]};
        const double depth = dot(d, forward_);
        if (!(depth > 0)) {
            x = slope_x_, y = slope_y_;
            break;
        }
        x = std::max(x, std::abs(dot(d, right_)) / depth);
        y = std::max(y, std::abs(dot(d, up_)) / depth);
    }
    x = std::min(x, slope_x_), y = std::min(y, slope_y_);
    return 1 + x * x + y * y;
}

LevelCut::LevelCut(const LevelTree& tree)
    : items_(tree), uses_(tree.chunks.size()), held_(tree.chunks.size()) {
    entries_.reserve(count_items(tree));
    heap_.reserve(count_items(tree));
}

void LevelCut::choose(const ViewPoint& view, const CutLimits& limits, const NotDrawn& not_drawn) {
    forget();
    view_ = &view, limits_ = limits, not_drawn_ = not_drawn;
    if (items_.tree().nodes.empty())
        return;
    visit({}, Frustum::kAllPlanes);
    if (!entries_.empty()) {
        add(entries_[0]), hold(entries_[0]);
        push(0);
    }
    const auto is_less = [&](std::uint32_t a, std::uint32_t b) {
        return entries_[a].error != entries_[b].error ? entries_[a].error < entries_[b].error
                                                      : a > b;
    };
    while (!heap_.empty()) {
        std::pop_heap(heap_.begin(), heap_.end(), is_less);
        const std::uint32_t at = heap_.back();
        heap_.pop_back();
        if (double{entries_[at].error} < kSmallest * full_at_)
            break;
        if (!replace(at))
            continue;
        for (std::uint32_t i = 0; i < entries_[at].count; ++i) {
            const std::size_t before = heap_.size();
            push(entries_[at].first + i);
            if (heap_.size() > before)
                std::push_heap(heap_.begin(), heap_.end(), is_less);
        }
    }
    for (const CutEntry& entry : entries_)
        if (!entry.is_replaced)
            error_ = std::max(error_, double{entry.error});
}

/// Replaces an entry by its visible children, if the limits allow it.
bool LevelCut::replace(std::uint32_t at) {
    const CutEntry parent = entries_[at];
    const std::uint64_t outside = outside_, occluded = occluded_;
    const auto first = static_cast<std::uint32_t>(entries_.size());
    items_.for_each_finer(parent.item, [&](ViewItem item) { visit(item, parent.planes); });
    const auto count = static_cast<std::uint32_t>(entries_.size()) - first;
    if (not_drawn_.is_there && parent.chunk != kNoChunk &&
        !std::all_of(entries_.begin() + first, entries_.end(),
                     [&](const CutEntry& entry) { return is_there(entry.item); })) {
        entries_.resize(first);
        outside_ = outside, occluded_ = occluded;
        return false;
    }
    const std::uint64_t triangles = triangles_;
    const std::uint32_t draws = draws_;
    subtract(parent);
    for (std::uint32_t i = first; i < first + count; ++i)
        add(entries_[i]), hold(entries_[i]);
    // Fewer triangles are always allowed. An entry without a chunk of its own cannot stay.
    const bool fits = triangles_ <= std::max(limits_.triangles, triangles) &&
                      draws_ <= std::max(limits_.draws, draws) && held_bytes_ <= limits_.bytes;
    if (!fits && parent.chunk != kNoChunk) {
        for (std::uint32_t i = first; i < first + count; ++i)
            subtract(entries_[i]), release(entries_[i]);
        add(parent);
        entries_.resize(first);
        outside_ = outside, occluded_ = occluded;
        if (full_at_ == 0 && is_almost_full())
            full_at_ = parent.error;
        return false;
    }
    CutEntry& replaced = entries_[at];
    replaced.is_replaced = true;
    replaced.first = first, replaced.count = count;
    return true;
}

/// Returns whether a limit is reached but for an eighth.
bool LevelCut::is_almost_full() const {
    return triangles_ > limits_.triangles / 8 * 7 || draws_ > limits_.draws / 8 * 7 ||
           held_bytes_ > limits_.bytes / 8 * 7;
}

/// Returns whether chunks that are there can show an item.
bool LevelCut::is_there(ViewItem item) const {
    if (const std::uint32_t chunk = items_.chunk(item); chunk != kNoChunk)
        return not_drawn_.is_there(chunk);
    bool all = true;
    items_.for_each_finer(item, [&](ViewItem finer) { all = all && is_there(finer); });
    return all;
}

/// Appends an entry for an item, unless the item is not visible.
void LevelCut::visit(ViewItem item, std::uint32_t planes) {
    const LevelNode& node = items_.node(item);
    if (not_drawn_.hidden != nullptr && items_.is_instance(item) &&
        (*not_drawn_.hidden)[items_.instance(item).placed.part])
        return;
    if (item.level == 0) { // the finer levels of an instance are as visible as the first
        planes = view_->frustum.cut(node.lower, node.upper, planes);
        if (planes == Frustum::kOutside) {
            ++outside_;
            return;
        }
        if (not_drawn_.occlusion != nullptr &&
            not_drawn_.occlusion->hides(node.lower, node.upper)) {
            ++occluded_;
            return;
        }
    }
    const double distance = std::sqrt(distance_sq(node, view_->eye));
    CutEntry entry;
    entry.item = item;
    entry.chunk = items_.chunk(item);
    entry.error = bounded_float(view_->pixels(items_.error(item), node, distance));
    entry.distance = bounded_float(distance);
    entry.planes = planes;
    if (entry.chunk == kNoChunk)
        entry.error = items_.has_finer(item) ? std::numeric_limits<float>::infinity() : 0;
    entries_.push_back(entry);
}

/// Puts an entry at the end of the heap if its error shows and something finer exists.
void LevelCut::push(std::uint32_t at) {
    const CutEntry& entry = entries_[at];
    if (items_.has_finer(entry.item) && double{entry.error} > limits_.pixel_error)
        heap_.push_back(at);
}

void LevelCut::add(const CutEntry& entry) {
    if (entry.chunk == kNoChunk)
        return;
    triangles_ += items_.tree().chunks[entry.chunk].triangles;
    draws_ += uses_[entry.chunk]++ == 0 ? 1 : 0;
}

void LevelCut::subtract(const CutEntry& entry) {
    if (entry.chunk == kNoChunk)
        return;
    triangles_ -= items_.tree().chunks[entry.chunk].triangles;
    draws_ -= --uses_[entry.chunk] == 0 ? 1 : 0;
}

void LevelCut::hold(const CutEntry& entry) {
    if (entry.chunk != kNoChunk && held_[entry.chunk]++ == 0)
        held_bytes_ += items_.tree().chunks[entry.chunk].bytes();
}

void LevelCut::release(const CutEntry& entry) {
    if (entry.chunk != kNoChunk && --held_[entry.chunk] == 0)
        held_bytes_ -= items_.tree().chunks[entry.chunk].bytes();
}

void LevelCut::forget() {
    for (const CutEntry& entry : entries_)
        if (entry.chunk != kNoChunk)
            uses_[entry.chunk] = held_[entry.chunk] = 0;
    entries_.clear();
    heap_.clear();
    triangles_ = held_bytes_ = outside_ = occluded_ = 0;
    draws_ = 0;
    error_ = full_at_ = 0;
}

std::uint64_t LevelCut::bytes() const {
    return entries_.capacity() * sizeof(CutEntry) +
           (heap_.capacity() + uses_.capacity() + held_.capacity()) * sizeof(std::uint32_t);
}

} // namespace abut
