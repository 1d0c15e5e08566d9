#include "rigid/solid/placed_blocks.h"

#include "geometry/point_triangle_distance.h"
#include "rigid/model/solid.h"

#include <algorithm>
#include <array>
#include <numbers>

namespace abut {

namespace {

constexpr std::uint32_t kLocalMask = (1U << ModelBlocks::kTriangleBits) - 1;

std::size_t block_of(std::uint32_t name) {
    return name >> ModelBlocks::kTriangleBits;
}

/// Returns a box that encloses the world positions of a box's points, as seen from the origin.
Box3 world_box_of(const Box3& box, const Transform& world, const Vec3& origin) {
    Box3 result;
    if (is_empty(box))
        return result;
    for (unsigned i = 0; i < 8; ++i)
        extend(result,
               apply(world, {i & 1U ? box.upper.x : box.lower.x, i & 2U ? box.upper.y : box.lower.y,
                             i & 4U ? box.upper.z : box.lower.z}) -
                   origin);
    // Far above the rounding of three products and sums. It does not depend on where the box is,
    // unless the box is far away for its size.
    const double margin =
        0x1p-48 * (sum_of_sizes(world) * std::max(max_abs(box.lower), max_abs(box.upper)) +
                   max_abs({world.m[9], world.m[10], world.m[11]}) + max_abs(origin));
    return grown(result, std::max(margin, 0x1p-24 * length(result.upper - result.lower)));
}

/// Returns whether a segment may meet a box: false is certain.
bool may_meet(const Vec3& from, const Vec3& to, const Box3& box) {
    const double margin =
        0x1p-40 * (max_abs(from) + max_abs(to) + max_abs(box.lower) + max_abs(box.upper));
    double begin = 0, end = 1;
    for (int axis = 0; axis < 3; ++axis) {
        const double p = component(from, axis), d = component(to, axis) - p;
        const double low = component(box.lower, axis) - margin,
                     high = component(box.upper, axis) + margin;
        if (std::abs(d) <= margin) {
            if (std::max(p, p + d) < low - margin || std::min(p, p + d) > high + margin)
                return false;
            continue;
        }
        const double s = (low - p) / d, t = (high - p) / d;
        begin = std::max(begin, std::min(s, t) - 0x1p-40);
        end = std::min(end, std::max(s, t) + 0x1p-40);
    }
    return begin <= end;
}

double distance_to(const Box3& box, const Vec3& p) {
    return length(max(max(box.lower - p, p - box.upper), {0, 0, 0}));
}

bool holds(const Box3& box, const Vec3& p) {
    return encloses(box, {p, p});
}

} // namespace

PlacedBlocks::PlacedBlocks(const ModelBlocks& blocks, const Transform& world_from_mesh,
                           const std::optional<Vec3>& origin)
    : blocks_(blocks), world_(world_from_mesh), origin_(origin) {
    require_finite(world_, "transform");
    boxes_.reserve(blocks.size());
    for (std::size_t i = 0; i < blocks.size(); ++i) {
        boxes_.push_back(world_box_of(blocks.box(i), world_, origin_.value_or(Vec3{})));
        box_.lower = min(box_.lower, boxes_.back().lower);
        box_.upper = max(box_.upper, boxes_.back().upper);
    }
    if (!is_empty(box_)) {
        middle_ = 0.5 * box_.lower + 0.5 * box_.upper;
        reach_ = length(0.5 * box_.upper - 0.5 * box_.lower) * (1 + 0x1p-40);
    }
    const auto& m = world_.m;
    mirrored_ =
        dot(cross(Vec3{m[0], m[1], m[2]}, Vec3{m[3], m[4], m[5]}), Vec3{m[6], m[7], m[8]}) < 0;
}

std::unique_ptr<WorldSolid> PlacedBlocks::seen_from(const Vec3& origin) const {
    auto seen = std::make_unique<PlacedBlocks>(blocks_, world_, origin);
    seen->known_ = known_;
    return seen;
}

std::shared_ptr<const PlacedBlocks::PlacedBlock> PlacedBlocks::placed(std::size_t i) const {
    if (last_ == nullptr || last_index_ != i) {
        last_.reset(); // it may free memory for the new one
        last_ = std::make_shared<const PlacedBlock>(blocks_.block(i), world_, origin_);
        last_index_ = i;
    }
    return last_;
}

std::uint32_t PlacedBlocks::name_of(std::uint32_t triangle) const {
    return std::lower_bound(known_.begin(), known_.end(), std::pair(triangle, 0U))->second;
}

std::vector<Vec3> PlacedBlocks::component_points() const {
    std::vector<Vec3> points = blocks_.solid().component_points;
    for (Vec3& p : points)
        p = to_world(p);
    return points;
}

Triangle PlacedBlocks::world_triangle(std::uint32_t triangle) const {
    const std::uint32_t name = name_of(triangle);
    return placed(block_of(name))->placed.world_triangle(name & kLocalMask);
}

std::vector<EdgeFace> PlacedBlocks::faces_around(std::uint32_t triangle, std::size_t edge) const {
    const std::uint32_t name = name_of(triangle);
    const Mesh& own = placed(block_of(name))->block->model.mesh();
    const auto& corners = own.triangles[name & kLocalMask];
    const Vec3 p = own.positions[corners[edge]], q = own.positions[corners[(edge + 1) % 3]];
    const Vec3 at = to_world(p);
    std::vector<EdgeFace> faces;
    for (std::size_t i = 0; i < size(); ++i) {
        if (!holds(blocks_.box(i), p) || !holds(blocks_.box(i), q))
            continue;
        const auto block = placed(i);
        const Mesh& mesh = block->block->model.mesh();
        block->placed.for_each_overlap({at, at}, [&](std::uint32_t slot) {
            const std::uint32_t local = block->placed.data().triangle_at(slot);
            if (bounds_nothing(block->block->numbers[local]))
                return;
            const auto& t = mesh.triangles[local];
            const Triangle v{mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]};
            if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0])
                return;
            for (std::size_t k = 0; k < 3; ++k) {
                const Vec3 &from = v[k], &to = v[(k + 1) % 3];
                if ((from == p && to == q) || (from == q && to == p))
                    faces.push_back({to_world(from), to_world(to), to_world(v[(k + 2) % 3])});
            }
        });
    }
    return faces;
}

const PlacedBoundary& PlacedBlocks::placed_boundary() const {
    if (!boundary_)
        boundary_.emplace(blocks_.solid().boundary, world_, origin_);
    return *boundary_;
}

bool PlacedBlocks::on_surface(const Vec3& point) const {
    return is_on_triangle(point) && placed_boundary().is_near(point);
}

bool PlacedBlocks::is_on_triangle(const Vec3& point) const {
    for (std::size_t i = 0; i < size(); ++i)
        if (holds(boxes_[i], point) && placed(i)->placed.on_surface(point))
            return true;
    return false;
}

PlacedBlocks::Nearest PlacedBlocks::nearest(const Vec3& point, const NearestSearch& search) const {
    if (boundary() != nullptr)
        return nearest_point(placed_boundary().placed(), point, search);
    Nearest best;
    NearestSearch left = search;
    left.seed = nullptr;
    if (search.seed != nullptr) {
        const ClosestPoints c = point_triangle_distance(point, world_slot(*search.seed));
        if (c.distance_sq < search.bound * search.bound) {
            best = {std::sqrt(c.distance_sq), c.b, *search.seed};
            left.bound = best.distance;
        }
    }
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t i = 0; i < size(); ++i)
        if (const double least = distance_to(boxes_[i], point);
            !is_empty(boxes_[i]) && least * (1 - 0x1p-40) <= left.bound)
            order.emplace_back(least, i);
    std::sort(order.begin(), order.end());
    for (const auto& [least, i] : order) {
        if (best.distance <= search.enough)
            break;
        if (least * (1 - 0x1p-40) * (1 + search.slack) > left.bound)
            break;
        const Nearest found = nearest_point(placed(i)->placed, point, left);
        if (found.distance < best.distance) {
            best = {found.distance, found.point, name(i, found.slot)};
            left.bound = best.distance;
        }
    }
    return best;
}

Triangle PlacedBlocks::world_slot(std::uint32_t slot) const {
    if (boundary() != nullptr)
        return placed_boundary().placed().world_slot(slot);
    return placed(block_of(slot))->placed.world_slot(slot & kLocalMask);
}

std::uint32_t PlacedBlocks::triangle_at(std::uint32_t slot) const {
    if (boundary() != nullptr)
        return placed_boundary().triangle_at(slot);
    const auto block = placed(block_of(slot));
    return block->block->numbers[block->placed.data().triangle_at(slot & kLocalMask)];
}

WorldSolid::Bounds PlacedBlocks::bounds() const {
    return {{}, {}, is_empty(box_) ? Aabb() : Aabb(box_)};
}

void PlacedBlocks::for_each_block(const Box3& region,
                                  const std::function<bool(const Block&)>& visit) const {
    for (std::size_t i = 0; i < size(); ++i) {
        if (is_empty(boxes_[i]) || !overlap(boxes_[i], region))
            continue;
        const auto block = placed(i);
        if (!visit({block->placed, block->block->numbers, boxes_[i]}))
            return;
    }
}

void PlacedBlocks::for_each_surface_block(const Box3& region,
                                          const std::function<bool(const Block&)>& visit) const {
    if (boundary() == nullptr)
        for_each_block(region, visit);
    else
        visit({placed_boundary().placed(), boundary()->source, box_});
}

bool PlacedBlocks::bounds_nothing(std::uint32_t triangle) const {
    const std::vector<std::int8_t>& weights = blocks_.solid().weights;
    return !weights.empty() && weights[triangle] == 0;
}

std::optional<int> PlacedBlocks::crossings(const Vec3& from, const Vec3& to) const {
    const std::vector<std::int8_t>& weights = blocks_.solid().weights;
    std::vector<std::int8_t> of_block;
    int sum = 0;
    for (std::size_t i = 0; i < size(); ++i) {
        if (is_empty(boxes_[i]) || !may_meet(from, to, boxes_[i]))
            continue;
        const auto block = placed(i);
        of_block.clear();
        if (!weights.empty())
            for (const std::uint32_t number : block->block->numbers)
                of_block.push_back(weights[number]);
        const std::optional<int> count =
            abut::crossings(block->placed, from, to, nullptr, of_block);
        if (!count)
            return std::nullopt;
        sum += *count;
    }
    if (!is_oriented())
        return sum;
    const int side = weights.empty() ? blocks_.solid().outward : 1;
    return sum * (mirrored_ ? -side : side);
}

double PlacedBlocks::winding(const Vec3& point) const {
    // This is asked for every part in the box of a terrain, so all blocks are read only of a solid.
    if (!bounds_solid())
        return 0;
    double sum = 0;
    for (std::size_t i = 0; i < size(); ++i) {
        if (is_empty(boxes_[i]))
            continue;
        const auto block = placed(i);
        for (std::uint32_t t = 0; t < block->block->numbers.size(); ++t)
            if (const int times = is_oriented() ? weight(block->block->numbers[t]) : 1; times != 0)
                sum += times * half_solid_angle(block->placed.world_triangle(t), point);
    }
    return sum / (2 * std::numbers::pi);
}

} // namespace abut
