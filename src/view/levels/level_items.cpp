#include "view/levels/level_items.h"

#include <abut/error.h>

#include "core/stop.h"
#include "math/transform.h"
#include "store/database/row_hash.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace abut {

namespace {

/// A shared mesh has at most this number of triangles, so that it fits into one chunk.
constexpr std::uint64_t kMostSharedTriangles = 21845;
/// A mesh of fewer triangles is merged with its neighbours, which saves draw calls.
constexpr std::uint64_t kLeastSharedTriangles = 64;
/// Instances must save at least this number of stored triangles.
constexpr std::uint64_t kLeastSaved = 4096;
constexpr double kFarthest = 1e30;
/// Bytes of a part in the lists here, and in the tree.
constexpr std::uint64_t kPartBytes = 2 * sizeof(LevelItem) + 128;

struct MeshUse {
    MeshRow row;
    std::uint64_t parts = 0;
    std::uint32_t shared = 0xffffffff;
};

using MeshUses = std::unordered_map<std::int64_t, MeshUse>;

bool pays(const MeshUse& use) {
    return use.parts > 1 && use.row.blocks == 1 && use.row.triangles >= kLeastSharedTriangles &&
           use.row.triangles <= kMostSharedTriangles &&
           (use.parts - 1) * use.row.triangles >= kLeastSaved;
}

/// A point near the middle, which stays the same when the bounds change little.
Vec3 steady_middle(const Box3& bounds) {
    const double extent = max_abs(bounds.upper - bounds.lower);
    const double step = extent > 0 ? std::exp2(std::ceil(std::log2(extent)) - 2) : 1;
    const auto middle = [&](double a, double b) { return std::round((a + b) / 2 / step) * step; };
    return {middle(bounds.lower.x, bounds.upper.x), middle(bounds.lower.y, bounds.upper.y),
            middle(bounds.lower.z, bounds.upper.z)};
}

class ItemLister {
public:
    ItemLister(StoreFile& store, std::uint64_t memory) : store_(store), memory_(memory) {}

    LevelItems run() {
        store_.for_each_mesh([&](const MeshRow& mesh) {
            uses_[mesh.mesh] = {mesh, 0};
            result_.geometry_bytes += mesh.stored_bytes;
        });
        Box3 bounds;
        std::uint64_t count = 0;
        store_.for_each_part([&](const PartRow& part) {
            count_part(part, bounds);
            if (++count * kPartBytes > memory_)
                throw Error(ErrorCode::bad_argument, store_.path(),
                            "has too many parts for levels of detail in this memory");
        });
        if (!is_empty(bounds) &&
            !(max_abs(bounds.lower) <= kFarthest && max_abs(bounds.upper) <= kFarthest))
            throw Error(ErrorCode::unsupported, store_.path(),
                        "has parts beyond 1e30 m, which levels of detail cannot hold");
        if (!is_empty(bounds))
            result_.origin = steady_middle(bounds);
        list_shared();
        const PlaceCurve curve(is_empty(bounds) ? Box3{{}, {}} : bounds);
        store_.for_each_part([&](const PartRow& part) { add_items(part, curve); });
        std::sort(result_.parts.begin(), result_.parts.end());
        return std::move(result_);
    }

private:
    MeshUse& use_of(const PartRow& part) {
        const auto found = uses_.find(part.mesh);
        if (found == uses_.end())
            throw Error(ErrorCode::malformed, store_.path(),
                        "is damaged: part " + part.id + " refers to a mesh that is missing");
        return found->second;
    }

    void count_part(const PartRow& part, Box3& bounds) {
        if ((++polls_ & 1023) == 0)
            poll_stop();
        if (is_empty(part.box))
            return;
        extend(bounds, part.box.lower);
        extend(bounds, part.box.upper);
        ++use_of(part).parts;
    }

    void list_shared() {
        std::vector<std::int64_t> meshes;
        for (const auto& [mesh, use] : uses_)
            if (pays(use))
                meshes.push_back(mesh);
        std::sort(meshes.begin(), meshes.end());
        for (const std::int64_t mesh : meshes) {
            MeshUse& use = uses_[mesh];
            use.shared = static_cast<std::uint32_t>(result_.shared.size());
            const Box3& box = use.row.box;
            result_.shared.push_back(
                {mesh, {use.row.hash_low, use.row.hash_high}, 0.5 * (box.lower + box.upper)});
        }
    }

    void add_items(const PartRow& part, const PlaceCurve& curve) {
        if ((++polls_ & 1023) == 0)
            poll_stop();
        result_.parts.push_back(part.part);
        if (is_empty(part.box))
            return;
        const MeshUse& use = use_of(part);
        LevelItem item;
        item.part = part.part;
        item.shared = use.shared;
        item.size_class = size_class(part.box);
        item.place = curve.place(part.box);
        const std::uint64_t digest = RowHash()
                                         .add(part.part)
                                         .add(use.row.hash_low)
                                         .add(use.row.hash_high)
                                         .add(part.world_from_mesh.m)
                                         .value();
        if (use.row.blocks == 1) {
            item.triangles = static_cast<std::uint32_t>(use.row.triangles);
            item.digest = digest;
            result_.items.push_back(item);
            return;
        }
        std::uint64_t number = 0;
        for (const BlockRow& block : store_.blocks(use.row)) {
            item.block = block.block;
            item.triangles = static_cast<std::uint32_t>(block.triangles);
            item.digest = RowHash().add(digest).add(number++).value();
            item.place = curve.place(placed_box(block.box, part.world_from_mesh));
            if (block.triangles > 0)
                result_.items.push_back(item);
        }
    }

    static Box3 placed_box(const Box3& box, const Transform& place) {
        Box3 placed;
        for (int corner = 0; corner < 8; ++corner)
            extend(placed, apply(place, {(corner & 1) != 0 ? box.upper.x : box.lower.x,
                                         (corner & 2) != 0 ? box.upper.y : box.lower.y,
                                         (corner & 4) != 0 ? box.upper.z : box.lower.z}));
        return placed;
    }

    StoreFile& store_;
    std::uint64_t memory_;
    LevelItems result_;
    MeshUses uses_;
    std::uint32_t polls_ = 0;
};

} // namespace

LevelItems list_level_items(StoreFile& store, std::uint64_t memory) {
    return ItemLister(store, memory).run();
}

} // namespace abut
