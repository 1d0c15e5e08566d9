#include "massive/work/stored_parts.h"

#include <abut/error.h>

#include "clash/clash_identity.h"
#include "math/vector.h"
#include "rigid/model/model_data.h"
#include "store/database/property_table.h"
#include "store/database/row_hash.h"
#include "store/import/cut_mesh.h"
#include "volume/aabb.h"

#include <algorithm>
#include <bit>
#include <filesystem>
#include <numeric>

namespace abut {

namespace {

/// Adds the parts of a store to a rule table, some at a time, with the properties that it asks for.
class RuleFeeder {
public:
    RuleFeeder(StoreFile& store, RuleTable& rules) : store_(store), rules_(rules) {}

    /// In          model: with its index; the same until the next flush().
    ///             reach: as reach_of, of the part's mesh
    void add(const ModelRow& model, std::uint32_t index, const PartRow& part,
             const ModelPrecision& precision, const Vec3& reach) {
        rows_.push_back(part.part);
        parts_.push_back({part.id, part.name, part.type, 0, {}});
        model_ = &model, index_ = index;
        rules_.add_precision(index, precision.stated,
                             single_rounding(precision, reach, part.world_from_mesh));
        if (rows_.size() == kParts)
            flush();
    }
    void flush() {
        const Properties properties = store_.properties(rows_, rules_.names());
        for (std::uint32_t i = 0; i < parts_.size(); ++i)
            rules_.add({index_, model_->file, parts_[i].id, parts_[i].name, parts_[i].type,
                        &properties, i});
        rules_.forget_properties();
        rows_.clear();
        parts_.clear();
    }

    /// Hands on the relations of all parts.
    void add_relations(const StoredParts& stored) {
        std::vector<PartRelation> relations;
        std::optional<PartsByRow> by_row;
        store_.with_connection([&](Database& database) {
            for_each_relation(database, [&](std::int64_t a, std::int64_t b, RelationKind kind) {
                if (!by_row)
                    by_row.emplace(stored);
                const auto first = by_row->find(a), second = by_row->find(b);
                if (first && second)
                    relations.push_back({*first, *second, kind});
            });
        });
        rules_.add(relations, 0);
    }

private:
    static constexpr std::size_t kParts = 4096;

    StoreFile& store_;
    RuleTable& rules_;
    std::vector<std::int64_t> rows_;
    std::vector<Part> parts_;
    const ModelRow* model_ = nullptr;
    std::uint32_t index_ = 0;
};

/// Reads the table of meshes. Returns by mesh whether it bounds no solid.
///
/// In          reach: receives reach_of each mesh; null if it is not wanted.
std::vector<bool> gather_meshes(StoreFile& store, StoredParts& result, std::vector<Vec3>* reach) {
    std::vector<MeshRow> large;
    std::vector<bool> is_surface;
    store.for_each_mesh([&](const MeshRow& mesh) {
        StoredMesh stored{mesh.mesh};
        is_surface.push_back(mesh.triangles > 0 && mesh.closed == false);
        if (is_whole(mesh.vertices, mesh.triangles)) {
            stored.bytes =
                static_cast<std::uint32_t>(most_model_bytes(mesh.triangles, mesh.vertices));
            stored.stored_bytes = static_cast<std::uint32_t>(mesh.stored_bytes);
        } else {
            result.large.push_back({static_cast<std::uint32_t>(result.meshes.size()), mesh.blocks});
            large.push_back(mesh);
        }
        result.meshes.push_back(stored);
        if (reach != nullptr)
            reach->push_back(reach_of(mesh.box));
    });
    result.meshes.shrink_to_fit(); // the table stays in memory for the whole job
    for (std::size_t i = 0; i < large.size(); ++i)
        for (const StoredBlock& block : stored_blocks(store, large[i])) {
            result.large[i].largest_block = std::max(result.large[i].largest_block, block.bytes);
            result.large[i].bytes += block.bytes;
        }
    return is_surface;
}

} // namespace

StoredParts gather_parts(StoreFile& store, RuleTable* rules) {
    StoredParts result;
    std::vector<Vec3> reach; // by mesh, if rules ask for it
    const std::vector<bool> is_surface =
        gather_meshes(store, result, rules == nullptr ? nullptr : &reach);
    result.models = store.models();
    // A part's row takes more bytes of the file than kLeastRow. The bound keeps a damaged number of
    // parts from reserving too much memory.
    constexpr std::uint64_t kLeastRow = 64;
    const std::uint64_t most_parts = std::filesystem::file_size(store.path()) / kLeastRow;
    std::uint64_t parts = 0;
    for (const ModelRow& model : result.models) {
        if (model.importing)
            throw Error(ErrorCode::bad_argument, store.path(),
                        "is incomplete: the import of " + model.file + " has not ended");
        parts += std::min(model.parts, most_parts);
    }
    result.parts.reserve(std::min(parts, most_parts));
    result.boxes.reserve(result.parts.capacity());
    std::optional<RuleFeeder> feeder =
        rules == nullptr ? std::nullopt : std::make_optional<RuleFeeder>(store, *rules);
    for (std::uint32_t m = 0; m < result.models.size(); ++m) {
        const ModelPrecision precision = store.precision(result.models[m].model);
        result.precisions.push_back(precision);
        store.for_each_part(result.models[m], [&](const PartRow& part) {
            // The meshes are sorted by number.
            const auto mesh =
                std::ranges::lower_bound(result.meshes, part.mesh, {}, &StoredMesh::mesh);
            if (mesh == result.meshes.end() || mesh->mesh != part.mesh)
                throw Error(ErrorCode::malformed, store.path(),
                            "is damaged: part " + part.id + " shows a mesh that is missing");
            const auto number = static_cast<std::uint32_t>(mesh - result.meshes.begin());
            if (is_surface[number] && result.surfaces.count++ < kNamedSurfaces)
                result.surfaces.first.push_back({m, part.id, part.name, part.type});
            result.boxes.push_back(part.box);
            result.parts.push_back({part.part, number, m,
                                    static_cast<std::uint32_t>(std::min<std::uint64_t>(
                                        part.generation, kLastGeneration))});
            if (feeder)
                feeder->add(result.models[m], m, part, precision, reach[result.parts.back().mesh]);
        });
        if (feeder)
            feeder->flush();
    }
    if (feeder)
        feeder->add_relations(result);
    return result;
}

Hash128 parts_key(const std::vector<ModelRow>& models) {
    RowHash hash;
    for (const ModelRow& model : models)
        hash.add(model.model).add(model.file).add(model.parts).add(model.parts_sum);
    return hash.value_128();
}

void require_parts(const std::vector<ModelRow>& models, const Hash128& key,
                   const std::string& store) {
    if (parts_key(models) != key || std::ranges::any_of(models, &ModelRow::importing))
        throw Error(ErrorCode::unreadable, store,
                    "has been changed by an import while the job was under way: run it again");
}

PartsByRow::PartsByRow(const StoredParts& stored)
    : parts_(stored.parts), order_(stored.parts.size()) {
    std::iota(order_.begin(), order_.end(), 0U);
    std::ranges::sort(order_, {}, [&](std::uint32_t i) { return parts_[i].row; });
}

std::optional<std::uint32_t> PartsByRow::find(std::int64_t row) const {
    const auto at =
        std::ranges::lower_bound(order_, row, {}, [&](std::uint32_t i) { return parts_[i].row; });
    if (at == order_.end() || parts_[*at].row != row)
        return std::nullopt;
    return *at;
}

std::uint64_t StoredParts::bytes() const {
    std::uint64_t sum = parts.capacity() * sizeof(StoredPart) + boxes.capacity() * sizeof(Box3) +
                        meshes.capacity() * sizeof(StoredMesh) +
                        large.capacity() * sizeof(StoredLargeMesh);
    for (const StoredLargeMesh& mesh : large)
        sum += mesh.blocks * (sizeof(StoredBlock) + sizeof(Box3));
    return sum;
}

const StoredLargeMesh* StoredParts::find_large(std::uint32_t mesh) const {
    if (meshes[mesh].bytes != 0)
        return nullptr;
    return &*std::ranges::lower_bound(large, mesh, {}, &StoredLargeMesh::mesh);
}

PairCell StoredParts::cell_of(const IndexPair& pair) const {
    const StoredLargeMesh* const of_a = find_large(parts[pair.a()].mesh);
    const StoredLargeMesh* const of_b = find_large(parts[pair.b()].mesh);
    const bool a_counts = of_b == nullptr || (of_a != nullptr && of_a->blocks >= of_b->blocks);
    const std::uint32_t part = a_counts ? pair.a() : pair.b(),
                        other = a_counts ? pair.b() : pair.a();
    const Box3& box = boxes[other];
    const Vec3 middle = 0.5 * box.lower + 0.5 * box.upper;
    // The key has three bits for each level of cells. Blocks lie on a surface, which meets about 4
    // of the 8 cells of a level: so 3/2 bits of the key are kept per bit of the number of blocks.
    const auto bits = static_cast<unsigned>(std::bit_width((a_counts ? of_a : of_b)->blocks));
    return {part, middle, spatial_key(boxes[part], middle, middle, middle) >> (63 - 3 * bits / 2)};
}

std::vector<IndexPair> find_candidates(const StoredParts& stored, const RuleTable& rules,
                                       const ClashOptions& options, LeftOutCounts* left_out) {
    const bool across = stored.models.size() > 1 && !options.self;
    const auto filter = [&](std::uint32_t i, std::uint32_t j) {
        return !across || stored.parts[i].model != stored.parts[j].model;
    };
    std::vector<IndexPair> pairs =
        overlapping_boxes(stored.boxes, rules.largest_reach(stored.boxes), filter);
    if (!rules.leaves_out() && !rules.reach_varies())
        return pairs;
    const auto out_of_reach = [&](const IndexPair& pair) {
        const PairDecision decision = rules.decide(pair.a(), pair.b());
        if (!decision.reach.holds(stored.boxes[pair.a()], stored.boxes[pair.b()]))
            return true;
        if (!decision.terms && left_out != nullptr)
            ++left_out->at(static_cast<std::size_t>(decision.reason));
        return !decision.terms;
    };
    pairs.erase(std::remove_if(pairs.begin(), pairs.end(), out_of_reach), pairs.end());
    return pairs;
}

} // namespace abut
