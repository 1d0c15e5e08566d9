#include <abut/scene.h>
#include <abut/shape_queries.h>

#include "measure.h"
#include "peers/peer_shapes.h"
#include "suite.h"

#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <memory>
#include <numbers>
#include <random>
#include <string>
#include <vector>

namespace abut::bench {

namespace {

struct ShapesSuiteOptions {
    std::string file; ///< empty: a generated model
    std::uint32_t triangles = 100000;
    std::size_t queries = 20000;
    int rounds = 5;
    std::uint64_t seed = 1;
};

/// A closed torus with waves on it, of about this many triangles.
Mesh wavy_torus(std::uint32_t triangles) {
    const auto n = static_cast<std::uint32_t>(std::sqrt(triangles / 4.0));
    const std::uint32_t columns = 2 * n;
    Mesh mesh;
    for (std::uint32_t i = 0; i < columns; ++i)
        for (std::uint32_t j = 0; j < n; ++j) {
            const double a = 2 * std::numbers::pi * i / columns, b = 2 * std::numbers::pi * j / n;
            const double tube = 0.35 + 0.02 * std::sin(20 * a) * std::cos(9 * b);
            const double r = 1 + tube * std::cos(b);
            mesh.positions.push_back({r * std::cos(a), r * std::sin(a), tube * std::sin(b)});
            const std::uint32_t p = i * n + j, q = (i + 1) % columns * n + j,
                                s = i * n + (j + 1) % n, t = (i + 1) % columns * n + (j + 1) % n;
            mesh.triangles.push_back({p, q, t});
            mesh.triangles.push_back({p, t, s});
        }
    return mesh;
}

class ShapesSuite {
public:
    explicit ShapesSuite(const ShapesSuiteOptions& options)
        : options_(options),
          mesh_(options.file.empty() ? wavy_torus(options.triangles) : read_mesh(options.file)),
          model_(mesh_), random_(options.seed) {
        for (const Vec3& p : mesh_.positions) {
            lower_ = {std::min(lower_.x, p.x), std::min(lower_.y, p.y), std::min(lower_.z, p.z)};
            upper_ = {std::max(upper_.x, p.x), std::max(upper_.y, p.y), std::max(upper_.z, p.z)};
        }
        report_.suite = "shapes";
        report_.notes.push_back(fmt::format("{} triangles, {} queries a case",
                                            mesh_.triangles.size(), options.queries));
    }

    Report run() && {
        rays();
        nearest_points("nearest, in the box around the model", 1);
        nearest_points("nearest, in one ten times as large", 10);
        containment();
        return std::move(report_);
    }

private:
    /// A random point in the model's box, scaled by `grown` about its centre.
    Vec3 point(double grown) {
        const auto along = [&](double low, double high) {
            const double middle = 0.5 * (low + high), half = 0.5 * grown * (high - low);
            return std::uniform_real_distribution(middle - half, middle + half)(random_);
        };
        const double x = along(lower_.x, upper_.x), y = along(lower_.y, upper_.y),
                     z = along(lower_.z, upper_.z);
        return {x, y, z};
    }

    /// Measures ours and theirs on every query. Each returns a number; the numbers should agree to
    /// `tolerance`.
    template <typename Ours, typename Theirs>
    void compare(const std::string& name, const Ours& ours, const Theirs* theirs,
                 const std::string& peer, double tolerance) {
        std::vector<double> a(options_.queries), b(options_.queries);
        const Work work = [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i)
                a[i] = ours(i);
        };
        const Work peer_work = [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i)
                b[i] = (*theirs)(i);
        };
        const Turns turns = take_turns(options_.queries, 1024, options_.rounds, work,
                                       theirs != nullptr ? peer_work : Work{});
        const double microseconds = 1e6 / static_cast<double>(options_.queries);
        Row row{name, turns.ours * microseconds, {}, {}, "us/query", 1, {}};
        if (theirs != nullptr) {
            row.peer = peer, row.theirs = turns.theirs * microseconds;
            double differ = 0;
            for (std::size_t i = 0; i < a.size(); ++i)
                differ += a[i] == b[i] || std::abs(a[i] - b[i]) <= tolerance ? 0 : 1;
            row.counters["disagreements"] = differ;
        }
        report_.rows.push_back(row);
    }

    void rays() {
        std::vector<Ray> rays(options_.queries);
        for (Ray& ray : rays) {
            const Vec3 from = point(3), to = point(1);
            ray = {from, {to.x - from.x, to.y - from.y, to.z - from.z}};
        }
        const auto embree = make_embree_rays(mesh_);
        const auto theirs = [&](std::size_t i) { return embree->first_hit(rays[i]); };
        compare(
            "ray, first hit",
            [&](std::size_t i) { return first_hit(model_, Transform(), rays[i]).t; },
            embree ? &theirs : nullptr, "Embree, robust, rtcIntersect1, float", 1e-4);
    }

    void nearest_points(const std::string& name, double grown) {
        std::vector<Vec3> points(options_.queries);
        for (Vec3& p : points)
            p = point(grown);
        const auto cgal = make_cgal_nearest(mesh_);
        const auto theirs = [&](std::size_t i) { return cgal->distance(points[i]); };
        compare(
            name, [&](std::size_t i) { return nearest(model_, Transform(), points[i]).distance; },
            cgal ? &theirs : nullptr, "CGAL AABB_tree", 1e-9);
    }

    void containment() {
        if (!inspect(mesh_).closed)
            return;
        std::vector<Vec3> points(options_.queries);
        for (Vec3& p : points)
            p = point(1);
        const auto nobody = [](std::size_t) { return 0.0; };
        compare(
            "contains, closed model",
            [&](std::size_t i) {
                return contains(model_, Transform(), points[i]).side == Side::inside ? 1.0 : 0.0;
            },
            static_cast<decltype(&nobody)>(nullptr), "", 0);
    }

    const ShapesSuiteOptions& options_;
    Mesh mesh_;
    Model model_;
    std::mt19937_64 random_;
    Vec3 lower_{HUGE_VAL, HUGE_VAL, HUGE_VAL}, upper_{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    Report report_;
};

/// Measures one model against rays (Embree), points (CGAL) and containment.
///
/// Errors      as read_mesh.
Report run_shapes_suite(const ShapesSuiteOptions& options) {
    return ShapesSuite(options).run();
}

const Suite kShapesSuite("shapes", "One model and rays, points: against Embree and CGAL",
                         [](CLI::App& suite) -> RunSuite {
                             const auto options = std::make_shared<ShapesSuiteOptions>();
                             suite.add_option("--model", options->file,
                                              "Model file to use instead of a wavy torus");
                             suite.add_option("--triangles", options->triangles, "Of the torus");
                             suite.add_option("--queries", options->queries, "In each case");
                             add_rounds(suite, options->rounds);
                             suite.add_option("--seed", options->seed, "Of the queries");
                             return [options] { return run_shapes_suite(*options); };
                         });

} // namespace

} // namespace abut::bench
