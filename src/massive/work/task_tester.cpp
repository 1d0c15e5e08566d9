#include "massive/work/task_tester.h"

#include "clash/clash_identity.h"
#include "clash/classify_pair.h"
#include "core/parallel.h"
#include "core/resources.h"

#include <tbb/task_arena.h>
#include <utility>

namespace abut {

TaskTester::TaskTester(StoreFile& store, const ClashOptions& options,
                       const std::vector<ModelRow>& models, std::uint64_t budget,
                       std::uint64_t blocks_budget, std::uint64_t hierarchies_room)
    : store_(store), options_(options), reader_(store, hierarchies_room), cache_(reader_, budget),
      large_(reader_, blocks_budget), read_before_(store.bytes_read()) {
    for (const ModelRow& model : models)
        files_.push_back(model.file);
}

TaskTester::Loaded TaskTester::load(Task task) {
    Loaded loaded;
    loaded.task = std::move(task);
    loaded.models = cache_.load(loaded.task);
    for (const std::int64_t mesh : loaded.task.large)
        loaded.large.push_back(&large_.open(mesh));
    loaded.threads = large_.threads();
    loaded.parts.resize(loaded.task.parts.size());
    parallel_for(loaded.parts.size(), 64,
                 [&](std::size_t i) { loaded.parts[i] = store_.part(loaded.task.parts[i].row); });
    auto rules = std::make_unique<RuleTable>(options_);
    for (std::size_t i = 0; i < loaded.parts.size(); ++i) {
        const PartRow& part = loaded.parts[i];
        const std::uint32_t model = loaded.task.parts[i].model;
        rules->add({model, files_[model], part.id, part.name, part.type});
    }
    loaded.rules = std::move(rules);
    return loaded;
}

TaskResult TaskTester::test(const Loaded& loaded, const std::function<void()>& on_pair) const {
    const Task& task = loaded.task;
    std::vector<std::optional<Clash>> found(task.pairs.size());
    const auto test = [&](std::size_t k) {
        found[k] = test_pair(loaded, task.pairs[k]);
        on_pair();
    };
    // Pairs of whole meshes have all their data in memory. Pairs with a large mesh read blocks
    // while they are tested; they come in an order in which neighbouring pairs share blocks.
    std::vector<bool> is_large(task.pairs.size());
    for (const std::uint32_t k : task.large_pairs)
        is_large[k] = true;
    parallel_for(task.pairs.size(), 1, [&](std::size_t k) {
        if (!is_large[k])
            test(k);
    });
    tbb::task_arena arena(loaded.threads);
    arena.execute([&] {
        parallel_for(task.large_pairs.size(), 1, [&](std::size_t i) { test(task.large_pairs[i]); });
    });
    TaskResult result;
    result.unit = task.unit;
    result.pairs = task.pairs.size();
    std::vector<bool> is_named(task.parts.size());
    for (std::uint32_t k = 0; k < found.size(); ++k) {
        if (!found[k])
            continue;
        result.clashes.push_back({k, std::move(*found[k])});
        for (const std::uint32_t part : {task.pairs[k].a, task.pairs[k].b}) {
            const PartRow& row = loaded.parts[part];
            if (!is_named[part])
                result.named.push_back({row.part, {row.id, row.name, row.type, 0, {}}});
            is_named[part] = true;
        }
    }
    return result;
}

std::optional<Clash> TaskTester::test_pair(const Loaded& loaded, const Task::Pair& pair) const {
    const PartRow &a = loaded.parts[pair.a], &b = loaded.parts[pair.b];
    const auto use = [&](std::uint32_t part) { return loaded.task.parts[part]; };
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

OutOfCoreCounters::Worker TaskTester::figures() const {
    return {.mesh_loads = cache_.loads(),
            .blocks = large_.cache().distinct().size(),
            .block_loads = large_.cache().loads(),
            .block_bytes_needed = large_.bytes_needed(),
            .hierarchies_found = reader_.found(),
            .bytes_read = store_.bytes_read() - read_before_,
            .peak_bytes = cache_.peak_bytes() + large_.cache().peak_bytes(),
            .processor_seconds = processor_seconds(),
            .peak_rss_mib = peak_resident_mib()};
}

} // namespace abut
