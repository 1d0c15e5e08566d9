#include "massive/work/unit_size.h"

#include <algorithm>
#include <utility>

namespace abut {

namespace {

/// Units that each worker should get. All workers wait for the last unit, so up to 1 / kUnits of
/// the time is lost. More units would cost more, because each is committed on its own, and smaller
/// units share less with the next.
constexpr std::uint64_t kUnits = 32;
/// The least size of a unit, worth some milliseconds of work. A smaller one is not worth a message
/// and a commit.
constexpr std::uint64_t kLeastBytes = std::uint64_t{2} << 20;
constexpr std::uint64_t kLeastPairs = 512;

WorkUnit unit_of(std::vector<IndexPair> pairs, const WorkUnit& of, const StoredParts& stored) {
    WorkUnit unit;
    unit.pairs = std::move(pairs);
    unit.cut = of.cut;
    unit.alone = of.alone;
    for (const IndexPair& pair : unit.pairs)
        for (const std::uint32_t part : {pair.a(), pair.b()})
            if (const std::uint32_t mesh = stored.parts[part].mesh;
                stored.find_large(mesh) == nullptr)
                unit.meshes.push_back(mesh);
    std::ranges::sort(unit.meshes);
    unit.meshes.erase(std::unique(unit.meshes.begin(), unit.meshes.end()), unit.meshes.end());
    for (const std::uint32_t mesh : unit.meshes)
        unit.bytes += stored.meshes[mesh].bytes;
    return unit;
}

} // namespace

std::uint64_t unit_budget(const StoredParts& stored, std::span<const IndexPair> pairs,
                          std::uint64_t most, std::size_t workers) {
    if (workers == 1)
        return most;
    std::vector<bool> needed(stored.meshes.size());
    std::uint64_t all = 0, largest_pair = 0;
    const auto need = [&](std::uint32_t mesh) -> std::uint64_t {
        if (!needed[mesh])
            all += stored.meshes[mesh].bytes;
        needed[mesh] = true;
        return stored.meshes[mesh].bytes;
    };
    for (const IndexPair& pair : pairs) {
        const std::uint32_t a = stored.parts[pair.a()].mesh, b = stored.parts[pair.b()].mesh;
        const std::uint64_t bytes = a == b ? need(a) : need(a) + need(b);
        if (bytes <= most)
            largest_pair = std::max(largest_pair, bytes);
    }
    return std::min(most, std::max({largest_pair, kLeastBytes, all / (kUnits * workers)}));
}

std::vector<WorkUnit> split_long_units(std::vector<WorkUnit> units, const StoredParts& stored,
                                       std::size_t workers) {
    if (workers == 1)
        return units;
    std::uint64_t pairs = 0;
    for (const WorkUnit& unit : units)
        pairs += unit.pairs.size();
    const std::uint64_t most = std::max(kLeastPairs, pairs / (kUnits * workers));
    std::vector<WorkUnit> result;
    for (WorkUnit& unit : units) {
        const std::uint64_t count = unit.pairs.size(), shares = (count + most - 1) / most;
        if (shares <= 1) {
            result.push_back(std::move(unit));
            continue;
        }
        const auto at = [&](std::uint64_t share) {
            return unit.pairs.begin() + static_cast<std::ptrdiff_t>(share * count / shares);
        };
        for (std::uint64_t i = 0; i < shares; ++i)
            result.push_back(unit_of({at(i), at(i + 1)}, unit, stored));
    }
    return result;
}

} // namespace abut
