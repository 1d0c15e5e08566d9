#include <abut/deformable.h>

#include "core/parallel.h"
#include "deform/candidate_search.h"
#include "deform/impact_collector.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace abut {

namespace {

struct AllImpacts {
    std::vector<FeatureImpact>& list;

    void keep(const FeatureImpact& impact) { list.push_back(impact); }
    static bool is_done() { return false; }
};

void add(TestCounts& sum, const TestCounts& counts) {
    sum.vertex_face += counts.vertex_face;
    sum.edge_edge += counts.edge_edge;
}

void add(Impacts& sum, const Impacts& part) {
    sum.list.insert(sum.list.end(), part.list.begin(), part.list.end());
    sum.counters.triangle_pairs += part.counters.triangle_pairs;
    add(sum.counters.candidates, part.counters.candidates);
    add(sum.counters.elementary_tests, part.counters.elementary_tests);
    sum.counters.exact_fallbacks += part.counters.exact_fallbacks;
}

/// Where an impact with this key is in an unsorted list.
struct KeyedPlace {
    std::uint64_t key = 0;
    std::size_t place = 0;
    friend bool operator<(const KeyedPlace& a, const KeyedPlace& b) { return a.key < b.key; }
};

/// Sorts keys in place of impacts, which are large, and then moves each impact once.
void sort(std::vector<FeatureImpact>& list) {
    std::vector<KeyedPlace> order(list.size());
    for (std::size_t i = 0; i < list.size(); ++i)
        order[i] = {list_key(list[i]), i};
    parallel_sort(order.begin(), order.end());
    // Each round fills the places of one cycle of the permutation.
    for (std::size_t first = 0; first < list.size(); ++first) {
        if (order[first].place == first)
            continue;
        const FeatureImpact moved = list[first];
        std::size_t to = first;
        for (std::size_t from = order[to].place; from != first; from = order[to].place) {
            list[to] = list[from];
            order[to].place = to;
            to = from;
        }
        list[to] = moved;
        order[to].place = to;
    }
    // Schemes without representatives find some impacts several times.
    const auto last =
        std::unique(list.begin(), list.end(), [](const FeatureImpact& a, const FeatureImpact& b) {
            return list_key(a) == list_key(b);
        });
    list.erase(last, list.end());
}

Impacts find_impacts(const DeformableData& a, const DeformableData& b,
                     const ElementaryOptions& options, const Progress& progress) {
    require_valid(options);
    const StopScope stopping(progress);
    const CandidateSearch search(a, b, options.thickness);
    std::vector<Impacts> parts(search.tasks());
    search.for_each_task([&](std::size_t i) {
        AllImpacts keeper{parts[i].list};
        ImpactCollector<AllImpacts> collector(a, b, options, keeper);
        search.run(i, collector, &parts[i].counters);
        collector.finish();
        collector.count(parts[i].counters);
    });
    Impacts impacts;
    std::size_t count = 0;
    for (const Impacts& part : parts)
        count += part.list.size();
    impacts.list.reserve(count);
    for (Impacts& part : parts) {
        add(impacts, part);
        part.list = std::vector<FeatureImpact>(); // leaves room for one list, not for two
    }
    sort(impacts.list);
    return impacts;
}

} // namespace

Impacts self_impacts(const Deformable& surface, const ElementaryOptions& options,
                     const Progress& progress) {
    return find_impacts(surface.data(), surface.data(), options, progress);
}

Impacts impacts(const Deformable& a, const Deformable& b, const ElementaryOptions& options,
                const Progress& progress) {
    return find_impacts(a.data(), b.data(), options, progress);
}

} // namespace abut
