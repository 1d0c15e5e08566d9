#include "scenes/deforming/fragments.h"

#include "scenes/deforming/frame.h"
#include "scenes/random.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <utility>

namespace abut::scenes {

namespace {

using Index3 = std::array<int, 3>;

constexpr int kMostFragments = 48;
constexpr int kTrianglesAFragment = 250; ///< at least
constexpr int kSmoothings = 6;
/// How far vertices on a crack move back from it, relative to the way to the middle of the cells
/// behind it.
constexpr double kStandBack = 0.06;
constexpr std::uint32_t kNone = ~std::uint32_t{0};

Index3 neighbour(Index3 index, std::size_t axis, int by) {
    index[axis] += by;
    return index;
}

Index3 sum(const Index3& a, const Index3& b) {
    return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

bool is_in(const Index3& index, const Index3& count) {
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (index[axis] < 0 || index[axis] >= count[axis])
            return false;
    return true;
}

/// The number of an index in the order of for_each_index.
std::size_t number_of(const Index3& index, const Index3& count) {
    const auto along = [](int k) { return static_cast<std::size_t>(k); };
    return (along(index[2]) * along(count[1]) + along(index[1])) * along(count[0]) +
           along(index[0]);
}

Vec3 vector_of(const Index3& index) {
    return {double(index[0]), double(index[1]), double(index[2])};
}

template <class Visit>
void for_each_index(const Index3& count, Visit visit) {
    Index3 at{};
    for (at[2] = 0; at[2] < count[2]; ++at[2])
        for (at[1] = 0; at[1] < count[1]; ++at[1])
            for (at[0] = 0; at[0] < count[0]; ++at[0])
                visit(at);
}

/// Visits the six sides of a cell: the neighbour on that side, and the corners of the face between,
/// seen from outside. Both cells of a face start at the same corner, so that they cut the face
/// along the same diagonal.
template <class Visit>
void for_each_side(const Index3& cell, Visit visit) {
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (const int side : {0, 1}) {
            const Index3 a = neighbour(cell, axis, side);
            Index3 b = neighbour(a, (axis + 1) % 3, 1), d = neighbour(a, (axis + 2) % 3, 1);
            const Index3 c = neighbour(b, (axis + 2) % 3, 1);
            if (side == 0)
                std::swap(b, d);
            visit(neighbour(cell, axis, side == 0 ? -1 : 1), std::array<Index3, 4>{a, b, c, d});
        }
}

} // namespace

FragmentedBall::FragmentedBall(double radius, std::uint64_t triangles, std::uint64_t seed)
    : radius_(radius) {
    Random random(seed);
    const auto fragments = std::min<std::uint64_t>(kMostFragments, triangles / kTrianglesAFragment);
    while (seeds_.size() < fragments) {
        const Vec3 p{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
        if (dot(p, p) < 1)
            seeds_.push_back(scaled(p, radius));
    }
    choose_cells(triangles);
    find_bonds(random.next());
    place_points();
    smooth_cracks();
}

void FragmentedBall::choose_cells(std::uint64_t triangles) {
    constexpr double kNear = 0.02;
    const auto wanted = static_cast<double>(triangles);
    int n = 8;
    for (int i = 0; i < 3; ++i) // the number of triangles grows about with n^2
        n = std::max(2, static_cast<int>(std::lround(n * std::sqrt(wanted / divide({n, n, n})))));
    Index3 best{};
    double least = 1e300;
    for (const int x : {n, n + 1, n - 1})
        for (const int y : {n, n + 1, n - 1})
            for (const int z : {n, n + 1, n - 1}) {
                const double miss = std::abs(divide({x, y, z}) / wanted - 1);
                if (miss < kNear)
                    return;
                if (miss < least) {
                    least = miss;
                    best = {x, y, z};
                }
            }
    static_cast<void>(divide(best));
}

/// Assigns each cell to a fragment. Returns how many triangles bound the fragments.
double FragmentedBall::divide(const Index3& cells) {
    cells_ = cells;
    fragment_.clear();
    for_each_index(cells_, [&](const Index3& cell) {
        const Vec3 at = centre(cell);
        const auto nearest = std::ranges::min_element(seeds_, {}, [&](const Vec3& seed) {
            const Vec3 way = subtract(seed, at);
            return dot(way, way);
        });
        fragment_.push_back(static_cast<std::uint32_t>(nearest - seeds_.begin()));
    });
    double triangles = 0;
    for_each_index(cells_, [&](const Index3& cell) {
        for_each_side(cell, [&](const Index3& neighbour, const auto&) {
            if (fragment_at(neighbour) != fragment_at(cell))
                triangles += 2;
        });
    });
    return triangles;
}

void FragmentedBall::find_bonds(std::uint64_t seed) {
    std::set<std::pair<std::uint32_t, std::uint32_t>> adjacent;
    for_each_index(cells_, [&](const Index3& cell) {
        for_each_side(cell, [&](const Index3& neighbour, const auto&) {
            const std::uint32_t a = fragment_at(cell), b = fragment_at(neighbour);
            if (a < b && b != kNone)
                adjacent.insert({a, b});
        });
    });
    Random random(seed);
    for (const auto& [a, b] : adjacent)
        bonds_.push_back({a, b, mixed(seeds_[a], seeds_[b], 0.5), random.uniform(0.75, 1.25)});
}

void FragmentedBall::place_points() {
    for_each_index(sum(cells_, {1, 1, 1}),
                   [&](const Index3& point) { points_.push_back(bent(vector_of(point))); });
}

/// Smooths the steps that cells make along cracks. Vertices on the ball's surface stay on it.
void FragmentedBall::smooth_cracks() {
    std::vector<bool> on_crack(points_.size(), false), on_surface(points_.size(), false);
    for_each_index(cells_, [&](const Index3& cell) {
        for_each_side(cell, [&](const Index3& neighbour, const auto& corners) {
            const std::uint32_t other = fragment_at(neighbour);
            if (other == fragment_at(cell))
                return;
            for (const Index3& corner : corners)
                (other == kNone ? on_surface : on_crack)[point_index(corner)] = true;
        });
    });
    const Index3 count = sum(cells_, {1, 1, 1});
    const auto is_neighbour = [&](const Index3& point, bool of_surface) {
        return is_in(point, count) && on_crack[point_index(point)] &&
               on_surface[point_index(point)] >= of_surface;
    };
    for (int i = 0; i < kSmoothings; ++i) {
        std::vector<Vec3> smooth = points_;
        for_each_index(count, [&](const Index3& point) {
            const std::size_t here = point_index(point);
            if (!on_crack[here])
                return;
            Vec3 total = points_[here];
            double parts = 1;
            for (std::size_t axis = 0; axis < 3; ++axis)
                for (const int by : {-1, 1})
                    if (const Index3 next = neighbour(point, axis, by);
                        is_neighbour(next, on_surface[here])) {
                        total = add(total, points_[point_index(next)]);
                        ++parts;
                    }
            smooth[here] =
                on_surface[here] ? scaled(unit(total), radius_) : scaled(total, 1 / parts);
        });
        points_ = std::move(smooth);
    }
}

double FragmentedBall::cell_size() const {
    return 2 * radius_ / *std::ranges::max_element(cells_);
}

std::vector<std::uint32_t> FragmentedBall::groups(const Vec3& from, double reach) const {
    std::vector<std::uint32_t> group(fragments());
    std::iota(group.begin(), group.end(), 0U);
    for (const Bond& bond : bonds_) {
        const auto [low, high] = std::minmax(group[bond.a], group[bond.b]);
        if (low != high && reach < bond.toughness * norm(subtract(bond.at, from)))
            std::ranges::replace(group, std::uint32_t{high}, std::uint32_t{low});
    }
    std::uint32_t next = 0; // renumbers the groups without gaps
    for (std::uint32_t f = 0; f < group.size(); ++f)
        if (std::ranges::find(group, f) != group.end())
            std::ranges::replace(group, f, next++);
    return group;
}

Piece FragmentedBall::piece(std::span<const std::uint32_t> group, std::uint32_t g) const {
    const auto belongs = [&](const Index3& cell) {
        const std::uint32_t fragment = fragment_at(cell);
        return fragment != kNone && group[fragment] == g;
    };
    Piece piece;
    std::vector<std::uint32_t> vertex_at(points_.size(), kNone);
    const auto vertex = [&](const Index3& point) {
        std::uint32_t& index = vertex_at[point_index(point)];
        if (index != kNone)
            return index;
        index = static_cast<std::uint32_t>(piece.shape.positions.size());
        Vec3 middle;
        double cells = 0, others = 0;
        for_each_index({2, 2, 2}, [&](const Index3& back) {
            const Index3 cell{point[0] - back[0], point[1] - back[1], point[2] - back[2]};
            if (belongs(cell)) {
                middle = add(middle, centre(cell));
                ++cells;
            } else if (fragment_at(cell) != kNone) {
                ++others;
            }
        });
        piece.shape.positions.push_back(mixed(
            points_[point_index(point)], scaled(middle, 1 / cells), others > 0 ? kStandBack : 0));
        return index;
    };
    double moment = 0;
    for_each_index(cells_, [&](const Index3& cell) {
        if (!belongs(cell))
            return;
        const Vec3 at = centre(cell);
        ++piece.mass;
        piece.centre = add(piece.centre, at);
        moment += dot(at, at);
        for_each_side(cell, [&](const Index3& neighbour, const auto& corners) {
            if (belongs(neighbour))
                return;
            const std::array<std::uint32_t, 4> v{vertex(corners[0]), vertex(corners[1]),
                                                 vertex(corners[2]), vertex(corners[3])};
            piece.shape.triangles.push_back({v[0], v[1], v[2]});
            piece.shape.triangles.push_back({v[0], v[2], v[3]});
        });
    });
    piece.centre = scaled(piece.centre, 1 / piece.mass);
    // The trace of the inertia tensor is twice the sum of squares about the centre. The cells' own
    // inertia is added, so that a single cell has some.
    const double spread = moment - piece.mass * dot(piece.centre, piece.centre);
    piece.inertia = 2.0 / 3 * spread + piece.mass * cell_size() * cell_size() / 6;
    for (Vec3& p : piece.shape.positions)
        p = subtract(p, piece.centre);
    return piece;
}

std::uint32_t FragmentedBall::fragment_at(const Index3& cell) const {
    if (!is_in(cell, cells_))
        return kNone;
    return fragment_[number_of(cell, cells_)];
}

std::size_t FragmentedBall::point_index(const Index3& point) const {
    return number_of(point, sum(cells_, {1, 1, 1}));
}

/// Maps the lattice, where a cell is a unit cube, to the ball.
Vec3 FragmentedBall::bent(const Vec3& lattice) const {
    const double x = 2 * lattice.x / cells_[0] - 1, y = 2 * lattice.y / cells_[1] - 1,
                 z = 2 * lattice.z / cells_[2] - 1;
    const auto shrink = [](double p, double q) {
        return std::sqrt(1 - p * p / 2 - q * q / 2 + p * p * q * q / 3);
    };
    return scaled({x * shrink(y, z), y * shrink(z, x), z * shrink(x, y)}, radius_);
}

Vec3 FragmentedBall::centre(const Index3& cell) const {
    return bent(add(vector_of(cell), {0.5, 0.5, 0.5}));
}

} // namespace abut::scenes
