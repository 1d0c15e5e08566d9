#include <abut/error.h>
#include <abut/surface_contacts.h>

#include "core/parallel.h"
#include "core/stop.h"
#include "deform/bodies/body_gap.h"
#include "deform/deformable_data.h"
#include "deform/rest/near_rules.h"
#include "geometry/point_triangle_distance.h"
#include "math/transform.h"
#include "volume/moving_box.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

namespace abut {

namespace {

/// A place on a triangle that is nearer than this to an edge or a vertex, as a share of the triangle,
/// belongs to that.
constexpr double kOnBorder = 1e-9;

/// How many vertices or triangles a thread takes at once.
constexpr std::size_t kPartsAtOnce = 256;

/// A query of one surface and one body.
class ContactSearch {
public:
    ContactSearch(const DeformableData& surface, const BodyGaps& body, double distance,
                  const NearOptions& options)
        : surface_(surface), body_(body), rules_(options.vertices, kBodyVertices, distance),
          at_end_(options.at_end) {}

    [[nodiscard]] std::optional<SurfaceContact> of_vertex(std::uint32_t vertex) const {
        const std::array<std::uint32_t, 1> ids{vertex};
        const double limit = rules_.limit(ids, {});
        const Vec3& p = at(vertex);
        if (!rules_.admit(ids, {}) || !overlap(Box3{p, p}, body_.bounds(), limit))
            return std::nullopt;
        const auto place = body_.of_point(p, limit);
        if (!place)
            return std::nullopt;
        return contact(Feature::vertex, vertex, {vertex, vertex, vertex}, {1, 0, 0}, limit, *place);
    }
    /// Appends the contact of a triangle or of the edge that holds its nearest place; nothing if that
    /// is a vertex. Of a triangle that the rules leave out, each edge stands for itself.
    void append_of_triangle(std::uint32_t id, std::vector<SurfaceContact>& list) const {
        const IndexTriangle& t = surface_.triangles[id];
        // At most that of the triangle, which has all vertices of its edges.
        const double most = rules_.limit(t, {});
        const Triangle corners{at(t[0]), at(t[1]), at(t[2])};
        Box3 box;
        for (const Vec3& corner : corners)
            extend(box, corner);
        if (!overlap(box, body_.bounds(), most))
            return;
        if (!rules_.admit(t, {})) {
            for (std::size_t k = 0; k < 3; ++k)
                append_of_edge({t[k], t[(k + 1) % 3]}, list);
        } else if (const auto place = body_.of_triangle(corners, most)) {
            if (const auto contact = inside(id, corners, *place))
                list.push_back(*contact);
        }
    }

private:
    /// A body has one vertex for the rules, without any data.
    static constexpr NearVertices kBodyVertices{};

    [[nodiscard]] const Vec3& at(std::uint32_t vertex) const {
        const MovingVertex& v = surface_.vertices[vertex];
        return at_end_ ? v.end : v.start;
    }
    void append_of_edge(std::array<std::uint32_t, 2> edge,
                        std::vector<SurfaceContact>& list) const {
        if (edge[1] < edge[0])
            std::swap(edge[0], edge[1]);
        const double limit = rules_.limit(edge, {});
        if (edge[0] == edge[1] || !rules_.admit(edge, {}))
            return;
        const Vec3 &p = at(edge[0]), &q = at(edge[1]), along = q - p;
        const auto place = body_.of_triangle({p, q, q}, limit);
        if (!place)
            return;
        const double share = dot(place->point - p, along) / length_sq(along);
        if (share > kOnBorder && share < 1 - kOnBorder) // not a vertex, nor without length
            list.push_back(contact(Feature::edge, edge_id(edge), {edge[0], edge[1], edge[1]},
                                   {1 - share, share, 0}, limit, *place));
    }
    /// The contact of the edge or face that has the place in its inside; nothing at a vertex.
    [[nodiscard]] std::optional<SurfaceContact> inside(std::uint32_t id, const Triangle& corners,
                                                       const PlaceNearBody& place) const {
        const IndexTriangle& t = surface_.triangles[id];
        std::array<double, 3> weights = nearest_on_triangle(place.point, corners).weights;
        std::array<std::size_t, 3> order{0, 1, 2};
        std::sort(order.begin(), order.end(),
                  [&](std::size_t i, std::size_t k) { return weights[i] > weights[k]; });
        if (weights[order[2]] > kOnBorder) {
            const double limit = rules_.limit(t, {});
            if (!rules_.admit(t, {}) || place.distance > limit)
                return std::nullopt;
            return contact(Feature::face, id, t, weights, limit, place);
        }
        if (weights[order[1]] <= kOnBorder)
            return std::nullopt;
        std::size_t first = order[0], second = order[1];
        if (t[second] < t[first])
            std::swap(first, second);
        const std::array<std::uint32_t, 2> edge{t[first], t[second]};
        const double limit = rules_.limit(edge, {});
        if (edge[0] == edge[1] || !rules_.admit(edge, {}) || place.distance > limit)
            return std::nullopt;
        const double sum = weights[first] + weights[second];
        return contact(Feature::edge, edge_id(edge), {edge[0], edge[1], edge[1]},
                       {weights[first] / sum, weights[second] / sum, 0}, limit, place);
    }
    [[nodiscard]] std::uint32_t edge_id(const std::array<std::uint32_t, 2>& edge) const {
        const auto& edges = surface_.features.edges;
        const auto found = std::lower_bound(
            edges.begin(), edges.end(), edge,
            [](const std::array<std::uint32_t, 2>& e, const std::array<std::uint32_t, 2>& f) {
                return std::tie(e[1], e[0]) < std::tie(f[1], f[0]);
            });
        return static_cast<std::uint32_t>(found - edges.begin());
    }
    [[nodiscard]] static SurfaceContact contact(Feature feature, std::uint32_t id,
                                                const std::array<std::uint32_t, 3>& vertices,
                                                const std::array<double, 3>& weights, double limit,
                                                const PlaceNearBody& place) {
        SurfaceContact contact;
        contact.feature = feature, contact.id = id;
        contact.vertices = vertices, contact.weights = weights;
        contact.distance = place.distance, contact.limit = limit;
        contact.point = place.point, contact.point_on_body = place.on_body;
        contact.normal = place.normal, contact.triangle = place.triangle;
        return contact;
    }

    const DeformableData& surface_;
    const BodyGaps& body_;
    NearRules rules_;
    bool at_end_;
};

std::vector<bool> used_vertices(const DeformableData& surface) {
    std::vector<bool> used(surface.vertices.size());
    for (const IndexTriangle& t : surface.triangles)
        for (const std::uint32_t vertex : t)
            used[vertex] = true;
    return used;
}

/// Appends the contacts of features 0 to count, in parallel, in their order.
template <typename Append>
void find_contacts(std::size_t count, const Append& append_contacts,
                   std::vector<SurfaceContact>& list) {
    const std::size_t chunks = (count + kPartsAtOnce - 1) / kPartsAtOnce;
    std::vector<std::vector<SurfaceContact>> parts(chunks);
    parallel_for(chunks, 1, [&](std::size_t chunk) {
        poll_stop();
        const std::size_t end = std::min(count, (chunk + 1) * kPartsAtOnce);
        for (std::size_t i = chunk * kPartsAtOnce; i < end; ++i)
            append_contacts(static_cast<std::uint32_t>(i), parts[chunk]);
    });
    for (const std::vector<SurfaceContact>& part : parts)
        list.insert(list.end(), part.begin(), part.end());
}

} // namespace

std::vector<SurfaceContact> within(const Deformable& surface, const RigidShape& body,
                                   const Pose& world_from_body, double distance,
                                   const NearOptions& options) {
    const DeformableData& data = surface.data();
    require_valid_near(distance, true, options.vertices_b);
    require_valid_vertices(options.vertices, data);
    const Transform world = world_from_body;
    const StopScope stopping(options.progress);
    const auto gaps = make_body_gaps(body, world);
    const ContactSearch search(data, *gaps, distance, options);
    const std::vector<bool> used = used_vertices(data);
    std::vector<SurfaceContact> list;
    find_contacts(
        data.vertices.size(),
        [&](std::uint32_t vertex, std::vector<SurfaceContact>& part) {
            if (!used[vertex])
                return;
            if (const auto contact = search.of_vertex(vertex))
                part.push_back(*contact);
        },
        list);
    const auto vertices = static_cast<std::ptrdiff_t>(list.size());
    find_contacts(
        data.triangles.size(),
        [&](std::uint32_t id, std::vector<SurfaceContact>& part) {
            search.append_of_triangle(id, part);
        },
        list);
    // Triangles that share an edge may both be nearest there. The nearer place is kept.
    const auto key = [](const SurfaceContact& c) {
        return std::tuple(static_cast<int>(c.feature), c.id);
    };
    std::sort(list.begin() + vertices, list.end(),
              [&](const SurfaceContact& c, const SurfaceContact& d) {
                  return std::tuple(key(c), c.distance) < std::tuple(key(d), d.distance);
              });
    list.erase(std::unique(list.begin() + vertices, list.end(),
                           [&](const SurfaceContact& c, const SurfaceContact& d) {
                               return key(c) == key(d);
                           }),
               list.end());
    return list;
}

} // namespace abut
