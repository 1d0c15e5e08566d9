#include "view/simplify/simplify_surface.h"

#include "core/disjoint_sets.h"
#include "core/stop.h"
#include "math/rounding.h"
#include "view/simplify/deviation.h"
#include "view/simplify/packed_normal.h"
#include "view/simplify/piece_choice.h"
#include "view/simplify/shading.h"

#include <algorithm>
#include <meshoptimizer.h>
#include <numeric>
#include <tuple>

namespace abut {

namespace {

/// A surface whose vertices are joined where part and position are equal.
struct JoinedSurface {
    std::vector<std::uint32_t> first;   ///< by joined vertex: its first in `members`; one more
    std::vector<std::uint32_t> members; ///< vertices of the surface, sorted by joined vertex
    std::vector<unsigned int> indices;  ///< three joined vertices for each triangle
};

JoinedSurface join(const LevelSurface& surface) {
    JoinedSurface joined;
    const auto key = [&](std::uint32_t i) {
        const SurfaceVertex& v = surface.vertices[i];
        return std::tuple(v.part, v.position.x, v.position.y, v.position.z, i);
    };
    joined.members.resize(surface.vertices.size());
    std::iota(joined.members.begin(), joined.members.end(), 0U);
    std::sort(joined.members.begin(), joined.members.end(),
              [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
    std::vector<unsigned int> number_of(surface.vertices.size());
    for (std::uint32_t i = 0; i < joined.members.size(); ++i) {
        const SurfaceVertex& v = surface.vertices[joined.members[i]];
        const SurfaceVertex* last = i > 0 ? &surface.vertices[joined.members[i - 1]] : nullptr;
        if (last == nullptr || last->part != v.part || !(last->position == v.position))
            joined.first.push_back(i);
        number_of[joined.members[i]] = static_cast<unsigned int>(joined.first.size() - 1);
    }
    joined.first.push_back(static_cast<std::uint32_t>(joined.members.size()));
    for (const auto& t : surface.triangles) {
        for (const std::uint32_t v : t)
            joined.indices.push_back(number_of[v]);
    }
    return joined;
}

/// The vertex at a joined vertex whose normal is nearest to that of a face.
std::uint32_t vertex_of_face(const LevelSurface& surface, const JoinedSurface& joined,
                             unsigned int joined_vertex, const Vec3& face) {
    std::uint32_t best = joined.members[joined.first[joined_vertex]];
    double most = -2;
    for (std::uint32_t m = joined.first[joined_vertex]; m < joined.first[joined_vertex + 1]; ++m) {
        const std::uint32_t member = joined.members[m];
        const double agrees = dot(face, unpack_normal(surface.vertices[member].normal));
        if (agrees > most)
            most = agrees, best = member;
    }
    return best;
}

/// The vertices of a simplified triangle: of each joined vertex the one whose normal is nearest to
/// that of the face.
std::array<std::uint32_t, 3> vertices_of_face(const LevelSurface& surface,
                                              const JoinedSurface& joined,
                                              const std::array<unsigned int, 3>& corners) {
    const auto position = [&](unsigned int v) -> const Vec3& {
        return surface.vertices[joined.members[joined.first[v]]].position;
    };
    const Vec3 &a = position(corners[0]), &b = position(corners[1]), &c = position(corners[2]);
    const Vec3 face = normalized_or_zero(cross(b - a, c - a));
    std::array<std::uint32_t, 3> vertices{};
    for (std::size_t k = 0; k < 3; ++k)
        vertices.at(k) = vertex_of_face(surface, joined, corners.at(k), face);
    return vertices;
}

/// Writes the simplified triangles with, at each vertex, the normal that is nearest to the face.
LevelSurface with_normals(const LevelSurface& from, const JoinedSurface& joined,
                          const std::vector<unsigned int>& indices) {
    LevelSurface to;
    to.parts = from.parts;
    std::vector<std::uint32_t> number_of(from.vertices.size(), 0xffffffff);
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        auto& triangle = to.triangles.emplace_back(
            vertices_of_face(from, joined, {indices[i], indices[i + 1], indices[i + 2]}));
        for (std::uint32_t& vertex : triangle) {
            std::uint32_t& number = number_of[vertex];
            if (number == 0xffffffff) {
                number = static_cast<std::uint32_t>(to.vertices.size());
                to.vertices.push_back(from.vertices[vertex]);
            }
            vertex = number;
        }
    }
    return to;
}

/// A set of triangles of one part that are connected through vertices.
struct Piece {
    std::uint32_t part = 0;
    std::vector<std::uint32_t> vertices; ///< joined vertices
    ShadedTriangles surface;
};

struct Pieces {
    std::vector<Piece> all;
    std::vector<std::uint32_t> of_vertex; ///< by joined vertex
};

constexpr int kPasses = 3; ///< each halves the triangles
/// An added error is not looked for below this share of the error that is there already.
constexpr double kLeastShare = 0.125;

class SurfaceSimplifier {
public:
    explicit SurfaceSimplifier(const LevelSurface& surface)
        : surface_(surface), joined_(join(surface)) {
        for (std::size_t v = 0; v + 1 < joined_.first.size(); ++v)
            positions_.push_back(surface.vertices[joined_.members[joined_.first[v]]].position);
        find_pieces();
        scale_positions();
    }

    SimplifiedSurface run(std::uint32_t target) {
        passes_.push_back(joined_.indices);
        std::vector<std::uint32_t> count(pieces_.all.size(), 0);
        for (std::size_t i = 0; i < joined_.indices.size(); i += 3)
            ++count[piece_of(joined_.indices[i])];
        for (std::size_t p = 0; p < pieces_.all.size(); ++p)
            if (count[p] > 0)
                add_form(p, 0, {count[p], 0});
        if (joined_.indices.size() / 3 > target) {
            int pass = 1;
            for (; pass <= kPasses && simplify_again(); ++pass)
                add_forms(pass);
            if (add_stick_pass())
                add_forms(static_cast<int>(passes_.size()) - 1);
        }
        const PieceChooser chooser(forms_, surface_.resting);
        const PieceChoice choice = chooser.least_error(target);
        return {chosen(choice), choice.error};
    }

private:
    [[nodiscard]] std::uint32_t piece_of(unsigned int vertex) const {
        return pieces_.of_vertex[vertex];
    }
    [[nodiscard]] Triangle triangle(const std::vector<unsigned int>& indices, std::size_t i) const {
        return {positions_[indices[i]], positions_[indices[i + 1]], positions_[indices[i + 2]]};
    }
    [[nodiscard]] std::array<Vec3, 3> normals(const std::array<std::uint32_t, 3>& vertices) const {
        const auto normal = [&](std::uint32_t v) {
            return unpack_normal(surface_.vertices[v].normal);
        };
        return {normal(vertices[0]), normal(vertices[1]), normal(vertices[2])};
    }
    /// For each vertex, the least one that triangles connect it with.
    [[nodiscard]] std::vector<std::uint32_t>
    connected(const std::vector<unsigned int>& indices) const {
        DisjointSets sets(positions_.size());
        for (std::size_t i = 0; i < indices.size(); i += 3) {
            sets.unite(indices[i], indices[i + 1]);
            sets.unite(indices[i], indices[i + 2]);
        }
        return std::move(sets).roots();
    }

    void find_pieces() {
        const std::vector<std::uint32_t> roots = connected(joined_.indices);
        std::vector<Box3> boxes;
        pieces_.of_vertex.resize(roots.size());
        for (std::uint32_t v = 0; v < roots.size(); ++v) {
            if (roots[v] == v) {
                pieces_.of_vertex[v] = static_cast<std::uint32_t>(boxes.size());
                boxes.emplace_back();
            }
            pieces_.of_vertex[v] = pieces_.of_vertex[roots[v]];
            extend(boxes[pieces_.of_vertex[v]], positions_[v]);
        }
        pieces_.all.resize(boxes.size());
        forms_.resize(boxes.size());
        pass_of_.resize(boxes.size());
        std::vector<std::vector<Vec3>> points(boxes.size());
        for (std::uint32_t v = 0; v < roots.size(); ++v) {
            points[pieces_.of_vertex[v]].push_back(positions_[v]);
            pieces_.all[pieces_.of_vertex[v]].vertices.push_back(v);
        }
        for (std::size_t p = 0; p < boxes.size(); ++p) {
            forms_[p].size = length(boxes[p].upper - boxes[p].lower);
            forms_[p].stick = stick_of(points[p]);
        }
        for (std::size_t i = 0; i < joined_.indices.size(); i += 3) {
            const unsigned int vertex = joined_.indices[i];
            Piece& piece = pieces_.all[piece_of(vertex)];
            piece.part = surface_.vertices[joined_.members[joined_.first[vertex]]].part;
            forms_[piece_of(vertex)].error = surface_.errors[piece.part];
            piece.surface.triangles.push_back(triangle(joined_.indices, i));
            piece.surface.normals.push_back(normals(surface_.triangles[i / 3]));
        }
    }

    /// Single precision is enough for the choice of vertices, which keep their places.
    void scale_positions() {
        Box3 box;
        for (const Vec3& p : positions_)
            extend(box, p);
        const Vec3 middle = 0.5 * (box.lower + box.upper);
        const double extent = std::max(max_abs(box.upper - box.lower), 1e-30);
        for (const Vec3& p : positions_) {
            const Vec3 q = (1 / extent) * (p - middle);
            for (int k = 0; k < 3; ++k)
                scaled_.push_back(to_float(component(q, k)));
        }
    }

    static std::vector<unsigned int> without_flat(const std::vector<unsigned int>& indices) {
        std::vector<unsigned int> rest;
        rest.reserve(indices.size());
        for (std::size_t i = 0; i < indices.size(); i += 3) {
            const unsigned int a = indices[i], b = indices[i + 1], c = indices[i + 2];
            if (a != b && b != c && c != a)
                rest.insert(rest.end(), {a, b, c});
        }
        return rest;
    }

    /// Returns false if few triangles can be removed.
    bool simplify_again() {
        poll_stop();
        const std::vector<unsigned int> last = without_flat(passes_.back());
        std::vector<unsigned int> fewer(last.size());
        const std::size_t target = last.size() / 6 * 3;
        fewer.resize(meshopt_simplify(fewer.data(), last.data(), last.size(), scaled_.data(),
                                      positions_.size(), 3 * sizeof(float), target, 1, 0, nullptr));
        const bool is_fewer = fewer.size() < last.size() / 20 * 19;
        passes_.push_back(std::move(fewer));
        return is_fewer;
    }

    /// Adds a pass that makes a tetrahedron of every piece, with corners of the piece. Returns false
    /// if no piece has more triangles.
    bool add_stick_pass() {
        std::vector<unsigned int> indices;
        for (std::size_t p = 0; p < pieces_.all.size(); ++p) {
            const Piece& piece = pieces_.all[p];
            if (forms_[p].forms.empty() || forms_[p].forms.back().triangles <= 4)
                continue;
            std::vector<Vec3> points;
            for (const std::uint32_t v : piece.vertices)
                points.push_back(positions_[v]);
            const auto at = stick_corners(points, forms_[p].stick);
            const auto corner = [&](std::size_t k) { return piece.vertices[at.at(k)]; };
            bool is_flat = false;
            for (std::size_t i = 0; i < 4; ++i)
                for (std::size_t k = 0; k < i; ++k)
                    is_flat = is_flat || at.at(i) == at.at(k);
            if (is_flat)
                continue;
            for (const std::size_t k : {0, 1, 2, 0, 2, 3, 0, 3, 1, 1, 3, 2})
                indices.push_back(corner(k));
        }
        passes_.push_back(std::move(indices));
        return !passes_.back().empty();
    }

    void add_form(std::size_t piece, int pass, PieceForms::Form form) {
        forms_[piece].forms.push_back(form);
        pass_of_[piece].push_back(pass);
    }

    void add_forms(int pass) {
        const std::vector<unsigned int>& indices = passes_[static_cast<std::size_t>(pass)];
        const std::vector<std::uint32_t> roots = connected(indices);
        constexpr std::uint32_t kNone = 0xffffffff;
        std::vector<ShadedTriangles> shown(pieces_.all.size());
        std::vector<std::uint32_t> root_of(pieces_.all.size(), kNone);
        std::vector<bool> is_split(pieces_.all.size());
        for (std::size_t i = 0; i < indices.size(); i += 3) {
            const std::uint32_t piece = piece_of(indices[i]);
            shown[piece].triangles.push_back(triangle(indices, i));
            shown[piece].normals.push_back(normals(
                vertices_of_face(surface_, joined_, {indices[i], indices[i + 1], indices[i + 2]})));
            if (root_of[piece] == kNone)
                root_of[piece] = roots[indices[i]];
            if (root_of[piece] != roots[indices[i]])
                is_split[piece] = true;
        }
        for (std::size_t p = 0; p < shown.size(); ++p) {
            const auto count = static_cast<std::uint32_t>(shown[p].size());
            // A piece stays connected, so that it is left out as a whole.
            if (count == 0 || is_split[p] || forms_[p].forms.back().triangles <= count)
                continue;
            // Beyond this, leaving out is better.
            const double most = forms_[p].size + std::max(forms_[p].error, surface_.resting);
            const double added = added_error(p, shown[p], most);
            if (added <= most)
                add_form(p, pass, {count, added});
        }
    }

    /// The error of a form of a piece: a bound of the distance, and that of its shade.
    ///
    /// In          most: a larger error is returned as some number above it.
    [[nodiscard]] double added_error(std::size_t p, const ShadedTriangles& shown,
                                     double most) const {
        const ShadedTriangles& surface = pieces_.all[p].surface;
        const TriangleSearch fine(surface.triangles), coarse(shown.triangles);
        const double least = kLeastShare * std::max(forms_[p].error, surface_.resting);
        double added = deviation_bound(surface.triangles, coarse, least, most);
        if (added <= most)
            added = deviation_bound(shown.triangles, fine, added, most);
        if (added <= most)
            added = std::max(added, shading_error(surface, shown, coarse, added, most));
        return added;
    }

    /// The chosen forms of all pieces, in the order of the pieces.
    [[nodiscard]] LevelSurface chosen(const PieceChoice& choice) const {
        constexpr int kNoPass = -1;
        std::vector<int> pass(choice.form.size(), kNoPass);
        std::vector<double> errors(surface_.parts.size(), 0);
        for (std::size_t p = 0; p < choice.form.size(); ++p) {
            if (choice.form[p] < 0)
                continue;
            const auto form = static_cast<std::size_t>(choice.form[p]);
            pass[p] = pass_of_[p][form];
            double& error = errors[pieces_.all[p].part];
            error = std::max(error, forms_[p].error + forms_[p].forms[form].added);
        }
        std::vector<std::array<unsigned int, 4>> sorted; // piece and corners
        for (std::size_t k = 0; k < passes_.size(); ++k)
            for (std::size_t i = 0; i < passes_[k].size(); i += 3) {
                const std::uint32_t piece = piece_of(passes_[k][i]);
                if (pass[piece] == static_cast<int>(k))
                    sorted.push_back({piece, passes_[k][i], passes_[k][i + 1], passes_[k][i + 2]});
            }
        std::stable_sort(sorted.begin(), sorted.end(),
                         [](const auto& a, const auto& b) { return a[0] < b[0]; });
        std::vector<unsigned int> indices;
        for (const auto& [piece, a, b, c] : sorted)
            indices.insert(indices.end(), {a, b, c});
        LevelSurface result = with_normals(surface_, joined_, indices);
        result.errors = std::move(errors);
        result.resting = choice.resting;
        return result;
    }

    const LevelSurface& surface_;
    JoinedSurface joined_;
    std::vector<Vec3> positions_; ///< by joined vertex
    std::vector<float> scaled_;   ///< the same in [-1, 1]
    Pieces pieces_;
    std::vector<std::vector<unsigned int>> passes_;
    std::vector<PieceForms> forms_;         ///< by piece
    std::vector<std::vector<int>> pass_of_; ///< by piece and form
};

} // namespace

SimplifiedSurface simplify(const LevelSurface& surface, std::uint32_t target) {
    return SurfaceSimplifier(surface).run(target);
}

} // namespace abut
