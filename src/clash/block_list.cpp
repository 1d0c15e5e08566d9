#include "clash/block_list.h"

#include "core/hash.h"

#include <algorithm>
#include <array>
#include <span>
#include <tuple>

namespace abut {

namespace {

bool less(const Vec3& p, const Vec3& q) {
    return std::tie(p.x, p.y, p.z) < std::tie(q.x, q.y, q.z);
}

/// Returns the sum of the hashes of all world triangles, which does not depend on their order.
Hash128 hash_of(const BlockList& part) {
    const Vec3 zero{0, 0, 0};
    Hash128 sum;
    for (std::size_t i = 0; i < part.size(); ++i) {
        if (is_empty(part.box(i)))
            continue;
        const BlockList::Held held = part.hold(i);
        const Mesh& mesh = held.model->mesh();
        for (const auto& t : mesh.triangles) {
            Triangle w;
            for (std::size_t k = 0; k < 3; ++k) // -0 becomes 0
                w.at(k) = apply(part.part().world_from_mesh, mesh.positions[t.at(k)]) + zero;
            std::sort(w.begin(), w.end(), less);
            const Hash128 hash = hash_128(std::as_bytes(std::span(w)));
            sum.low += hash.low, sum.high += hash.high;
        }
    }
    return sum;
}

} // namespace

bool same_triangles(const BlockList& a, const BlockList& b) {
    return a.part().box == b.part().box && a.triangles() == b.triangles() &&
           hash_of(a) == hash_of(b);
}

} // namespace abut
