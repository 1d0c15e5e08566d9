// Finds the impacts of two layers of cloth with a culling of its own: a sweep along x.
// Representative triangles turn its triangle pairs into feature pairs, each once.
//
//     abut-any-culling

#include <abut/representatives.h>

#include "program.h"

#include <algorithm>
#include <numeric>

namespace {

using abut::Vec3;

/// Two square layers of cloth as one mesh; the upper one falls through the lower one.
abut::Mesh two_layers(std::vector<Vec3>& end) {
    constexpr std::uint32_t kSide = 20;
    abut::Mesh cloth;
    for (std::uint32_t i = 0; i < 2 * kSide * kSide; ++i) {
        const std::uint32_t layer = i / (kSide * kSide), column = i % kSide,
                            row = i / kSide % kSide;
        const double x = column + 0.3 * layer, y = row + 0.4 * layer, z = layer;
        cloth.positions.push_back({x, y, z});
        end.push_back({x, y, -z});
        if (column == 0 || row == 0)
            continue; // no square to the left and in front
        cloth.triangles.push_back({i - kSide - 1, i - kSide, i});
        cloth.triangles.push_back({i - kSide - 1, i, i - 1});
    }
    return cloth;
}

/// The culling: pairs of triangles whose ways overlap along x. Any tree or grid does as well.
std::vector<abut::TrianglePair> sweep(const abut::Mesh& cloth, const std::vector<Vec3>& end) {
    std::vector<double> low, high;
    for (const auto& [a, b, c] : cloth.triangles) {
        const std::initializer_list<double> x{cloth.positions[a].x,
                                              cloth.positions[b].x,
                                              cloth.positions[c].x,
                                              end[a].x,
                                              end[b].x,
                                              end[c].x};
        low.push_back(std::min(x));
        high.push_back(std::max(x));
    }
    std::vector<std::uint32_t> order(low.size());
    std::iota(order.begin(), order.end(), 0U);
    std::sort(order.begin(), order.end(), [&](auto i, auto k) { return low[i] < low[k]; });
    std::vector<abut::TrianglePair> pairs;
    for (std::size_t i = 0; i < order.size(); ++i)
        for (std::size_t k = i + 1; k < order.size() && low[order[k]] <= high[order[i]]; ++k)
            pairs.push_back({order[i], order[k]});
    return pairs;
}

int run(int, char**) {
    std::vector<Vec3> end;
    const abut::Mesh cloth = two_layers(end);
    const std::vector<abut::TrianglePair> pairs = sweep(cloth, end);

    abut::Representatives surface(cloth.positions.size(), cloth.triangles);
    surface.set_motion(cloth.positions, end); // boxes of features reject most pairs
    const std::vector<abut::FeatureTest> tests = abut::self_feature_tests(surface, pairs);

    std::vector<abut::ElementaryPair> elementary;
    for (const abut::FeatureTest& test : tests) {
        abut::ElementaryPair& pair = elementary.emplace_back();
        pair.kind = test.kind;
        for (std::size_t i = 0; i < 4; ++i) {
            pair.start[i] = cloth.positions[test.vertices[i]];
            pair.end[i] = end[test.vertices[i]];
        }
    }
    std::size_t impacts = 0;
    for (const abut::ElementaryImpact& impact : abut::elementary_impacts(elementary))
        impacts += impact.meet ? 1 : 0;
    std::printf("%zu triangle pairs, %zu tests, %zu impacts\n", pairs.size(), tests.size(),
                impacts);
    return 0;
}

} // namespace

int main(int argc, char** argv) {
    return run_program("abut-any-culling", run, argc, argv);
}
