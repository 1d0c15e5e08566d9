#include "massive/work/piece_tester.h"

#include "clash/clash_identity.h"
#include "clash/classify_by_id.h"
#include "core/parallel.h"
#include "core/resources.h"

#include <tbb/task_arena.h>
#include <utility>

namespace abut {

PieceTester::PieceTester(StoreFile& store, const ClashOptions& options,
                         const std::vector<ModelRow>& models, std::uint64_t budget,
                         std::uint64_t blocks_budget, std::uint64_t hierarchies_room)
    : store_(store), options_(options), reader_(store, hierarchies_room), cache_(reader_, budget),
      large_(reader_, blocks_budget), read_before_(store.bytes_read()) {
    for (const ModelRow& model : models)
        files_.push_back(model.file);
}

PieceTester::Loaded PieceTester::load(WorkPiece piece) {
    Loaded loaded;
    loaded.piece = std::move(piece);
    loaded.models = cache_.load(loaded.piece);
    for (const std::int64_t mesh : loaded.piece.large)
        loaded.large.push_back(&large_.open(mesh));
    loaded.threads = large_.threads();
    loaded.parts.resize(loaded.piece.parts.size());
    parallel_for(loaded.parts.size(), 64,
                 [&](std::size_t i) { loaded.parts[i] = store_.part(loaded.piece.parts[i].row); });
    auto rules = std::make_unique<RuleTable>(options_);
    for (std::size_t i = 0; i < loaded.parts.size(); ++i) {
        const PartRow& part = loaded.parts[i];
        const std::uint32_t model = loaded.piece.parts[i].model;
        rules->add({model, files_[model], part.id, part.name, part.type});
    }
    loaded.rules = std::move(rules);
    return loaded;
}

PieceResult PieceTester::test(const Loaded& loaded, const std::function<void()>& on_pair) const {
    const WorkPiece& piece = loaded.piece;
    std::vector<std::optional<Clash>> found(piece.pairs.size());
    const auto test = [&](std::size_t k) {
        found[k] = test_pair(loaded, piece.pairs[k]);
        on_pair();
    };
    // Pairs of whole meshes have all their data in memory. Pairs with a large mesh read blocks
    // while they are tested; they come in an order in which neighbouring pairs share blocks.
    std::vector<bool> is_large(piece.pairs.size());
    for (const std::uint32_t k : piece.large_pairs)
        is_large[k] = true;
    parallel_for(piece.pairs.size(), 1, [&](std::size_t k) {
        if (!is_large[k])
            test(k);
    });
    tbb::task_arena arena(loaded.threads);
    arena.execute([&] {
        parallel_for(piece.large_pairs.size(), 1,
                     [&](std::size_t i) { test(piece.large_pairs[i]); });
    });
    PieceResult result;
    result.unit = piece.unit;
    result.pairs = piece.pairs.size();
    std::vector<bool> is_named(piece.parts.size());
    for (std::uint32_t k = 0; k < found.size(); ++k) {
        if (!found[k])
            continue;
        result.clashes.push_back({k, std::move(*found[k])});
        for (const std::uint32_t part : {piece.pairs[k].a, piece.pairs[k].b}) {
            const PartRow& row = loaded.parts[part];
            if (!is_named[part])
                result.named.push_back({row.part, {row.id, row.name, row.type, 0, {}}});
            is_named[part] = true;
        }
    }
    return result;
}

std::optional<Clash> PieceTester::test_pair(const Loaded& loaded,
                                            const WorkPiece::Pair& pair) const {
    const PartRow &a = loaded.parts[pair.a], &b = loaded.parts[pair.b];
    const auto use = [&](std::uint32_t part) { return loaded.piece.parts[part]; };
    const std::string &file_a = files_[use(pair.a).model], &file_b = files_[use(pair.b).model];
    const PairTerms terms = *loaded.rules->terms(pair.a, pair.b); // every candidate pair has terms
    const auto placed = [&](const PartRow& row, std::uint32_t part) {
        const std::uint32_t mesh = use(part).mesh;
        const auto whole = static_cast<std::uint32_t>(loaded.models.size());
        return ClashPart{mesh < whole ? loaded.models[mesh] : nullptr,
                         mesh < whole ? nullptr : loaded.large[mesh - whole], row.world_from_mesh,
                         row.box};
    };
    std::optional<Clash> clash = classify_by_id(placed(a, pair.a), a.id, placed(b, pair.b), b.id,
                                                terms.clearance, terms.touch);
    if (clash) {
        if (terms.rule != nullptr)
            clash->rule = terms.rule->name;
        clash->id = clash_identity(file_a, a.id, file_b, b.id, clash->kind);
    }
    return clash;
}

OutOfCoreCounters::Worker PieceTester::figures() const {
    return {.mesh_loads = cache_.loads(),
            .blocks = large_.cache().distinct().size(),
            .block_loads = large_.cache().loads(),
            .block_bytes_needed = large_.bytes_needed(),
            .hierarchies_found = reader_.found(),
            .bytes_read = store_.bytes_read() - read_before_,
            .peak_bytes = cache_.peak_bytes() + large_.cache().peak_bytes(),
            .processor_seconds = processor_seconds(),
            .peak_rss_mb = peak_resident_mib()};
}

} // namespace abut
