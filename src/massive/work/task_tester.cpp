#include "massive/work/task_tester.h"

#include "clash/clash_identity.h"
#include "core/parallel.h"
#include "core/resources.h"

#include <tbb/task_arena.h>
#include <utility>

namespace abut {

TaskTester::TaskTester(StoreFile& store, const std::vector<ModelRow>& models, std::uint64_t budget,
                       std::uint64_t blocks_budget, std::uint64_t hierarchies_room)
    : store_(store), reader_(store, hierarchies_room), cache_(reader_, budget),
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
    return loaded;
}

TaskResult TaskTester::test(const Loaded& loaded, const std::function<void()>& on_pair) const {
    const Task& task = loaded.task;
    std::vector<PairAnswer> found(task.pairs.size());
    const auto test_one = [&](std::size_t k) {
        found[k] = this->test(loaded, task.pairs[k]);
        on_pair();
    };
    // Pairs of whole meshes have all their data in memory. Pairs with a large mesh read blocks
    // while they are tested; they come in an order in which neighbouring pairs share blocks.
    std::vector<bool> is_large(task.pairs.size());
    for (const std::uint32_t k : task.large_pairs)
        is_large[k] = true;
    parallel_for(task.pairs.size(), 1, [&](std::size_t k) {
        if (!is_large[k])
            test_one(k);
    });
    tbb::task_arena arena(loaded.threads);
    arena.execute([&] {
        parallel_for(task.large_pairs.size(), 1,
                     [&](std::size_t i) { test_one(task.large_pairs[i]); });
    });
    TaskResult result;
    result.unit = task.unit;
    result.pairs = task.pairs.size();
    std::vector<bool> is_named(task.parts.size());
    for (std::uint32_t k = 0; k < found.size(); ++k) {
        if (!found[k].clash)
            continue;
        result.clashes.push_back({k, std::move(*found[k].clash), found[k].left_out});
        if (found[k].left_out)
            continue;
        for (const std::uint32_t part : {task.pairs[k].a, task.pairs[k].b}) {
            const PartRow& row = loaded.parts[part];
            if (!is_named[part])
                result.named.push_back({row.part, {row.id, row.name, row.type, 0, {}}});
            is_named[part] = true;
        }
    }
    return result;
}

PairAnswer TaskTester::test(const Loaded& loaded, const Task::Pair& pair) const {
    const PartRow &a = loaded.parts[pair.a], &b = loaded.parts[pair.b];
    const auto use = [&](std::uint32_t part) { return loaded.task.parts[part]; };
    const std::string &file_a = files_[use(pair.a).model], &file_b = files_[use(pair.b).model];
    const Task::Terms& terms = loaded.task.terms.at(pair.terms);
    const auto placed = [&](const PartRow& row, std::uint32_t part) {
        const std::uint32_t mesh = use(part).mesh;
        const auto whole = static_cast<std::uint32_t>(loaded.models.size());
        return ClashPart{mesh < whole ? loaded.models[mesh] : nullptr,
                         mesh < whole ? nullptr : loaded.large[mesh - whole], row.world_from_mesh,
                         row.box};
    };
    PairTerms numbers = terms.numbers;
    numbers.touch = pair.touch;
    numbers.rounding = pair.rounding;
    PairAnswer answer = test_pair(placed(a, pair.a), a.id, placed(b, pair.b), b.id, numbers);
    if (answer.clash) {
        answer.clash->rule = terms.rule;
        answer.clash->severity = terms.severity;
        answer.clash->id = clash_identity(file_a, a.id, file_b, b.id, answer.clash->kind);
    }
    return answer;
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
