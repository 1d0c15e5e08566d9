#include <abut/deformable.h>

#include "core/parallel.h"
#include "deform/candidate_search.h"
#include "deform/impact_collector.h"

#include <array>
#include <atomic>
#include <tuple>
#include <vector>

namespace abut {

namespace {

/// End times of the windows that are searched one after the other. Each begins at 0.
constexpr std::array<double, 3> kWindows{0x1p-6, 0x1p-2, 1};
/// Bounds how far a computed time may be below the first contact. An impact that is found within
/// this margin of a window's end may not be the earliest one.
constexpr double kTimeError = 0x1p-29;

struct EarliestImpact {
    std::optional<FeatureImpact> impact;

    void keep(const FeatureImpact& other) {
        const auto key = [](const FeatureImpact& i) { return std::tuple(i.time, list_key(i)); };
        if (!impact || key(other) < key(*impact))
            impact = other;
    }
    static bool is_done() { return false; }
};

/// The earliest impact among the candidates of a search whose boxes cover the motion until some
/// time. All impacts up to that time are among them.
std::optional<FeatureImpact> earliest(const DeformableData& a, const DeformableData& b,
                                      const CandidateSearch& search,
                                      const ElementaryOptions& options) {
    std::vector<EarliestImpact> parts(search.tasks());
    parallel_for(parts.size(), 1, [&](std::size_t i) {
        ImpactCollector<EarliestImpact> collector(a, b, options, parts[i]);
        search.run(i, collector);
        collector.finish();
    });
    EarliestImpact all;
    for (const EarliestImpact& part : parts)
        if (part.impact)
            all.keep(*part.impact);
    return all.impact;
}

std::optional<FeatureImpact> find_first(const DeformableData& a, const DeformableData& b,
                                        const ElementaryOptions& options,
                                        const Progress& progress) {
    require_valid(options);
    const StopScope stopping(progress);
    SweptTree swept_a = a.swept, swept_b;
    if (&a != &b)
        swept_b = b.swept;
    std::optional<FeatureImpact> first;
    for (const double until : kWindows) {
        refit(swept_a, a, until);
        if (&a != &b)
            refit(swept_b, b, until);
        first = earliest(
            a, b, CandidateSearch(a, swept_a, b, &a == &b ? swept_a : swept_b, options.thickness),
            options);
        if (first && first->time < until - kTimeError)
            break;
    }
    return first;
}

/// Whether any task has found an impact.
struct AnyImpact {
    std::atomic<bool>& found;

    void keep(const FeatureImpact&) { found = true; }
    [[nodiscard]] bool is_done() const { return found.load(std::memory_order_relaxed); }
};

bool is_free(const DeformableData& a, const DeformableData& b, const ElementaryOptions& options,
             const Progress& progress) {
    require_valid(options);
    const StopScope stopping(progress);
    const CandidateSearch search(a, a.swept, b, b.swept, options.thickness);
    std::atomic<bool> found = false;
    parallel_for(search.tasks(), 1, [&](std::size_t i) {
        AnyImpact keeper{found};
        if (keeper.is_done())
            return;
        ImpactCollector<AnyImpact> collector(a, b, options, keeper);
        search.run(i, collector);
        collector.finish();
    });
    return !found;
}

} // namespace

std::optional<FeatureImpact> self_time_of_impact(const Deformable& surface,
                                                 const ElementaryOptions& options,
                                                 const Progress& progress) {
    return find_first(surface.data(), surface.data(), options, progress);
}
std::optional<FeatureImpact> time_of_impact(const Deformable& a, const Deformable& b,
                                            const ElementaryOptions& options,
                                            const Progress& progress) {
    return find_first(a.data(), b.data(), options, progress);
}

bool is_free_of_self_impacts(const Deformable& surface, const ElementaryOptions& options,
                             const Progress& progress) {
    return is_free(surface.data(), surface.data(), options, progress);
}
bool is_free_of_impacts(const Deformable& a, const Deformable& b, const ElementaryOptions& options,
                        const Progress& progress) {
    return is_free(a.data(), b.data(), options, progress);
}

} // namespace abut
