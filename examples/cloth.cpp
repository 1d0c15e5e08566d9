// Lets two layers of cloth fall on a ball: extended position-based dynamics with near features as
// contacts, constraints in colours, and a last check that nothing passes through anything.
//
//     abut-cloth [STEPS [CELLS]]

#include <abut/constraint_colours.h>
#include <abut/deformable.h>
#include <abut/surface_contacts.h>
#include <abut/vector.h>

#include "program.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <vector>

namespace {

using abut::Vec3;

constexpr double kStep = 1.0 / 60, kThickness = 0.01, kBallRadius = 0.4, kStretch = 1e-7;
constexpr int kRounds = 12, kSolverRounds = 5, kAttempts = 20;

/// Two square layers of cloth, the upper one turned a little, as one mesh.
abut::Mesh two_layers(std::uint32_t cells) {
    abut::Mesh mesh;
    const std::uint32_t side = cells + 1;
    for (std::uint32_t i = 0; i < 2 * side * side; ++i) {
        const std::uint32_t layer = i / (side * side), column = i % side, row = i / side % side;
        const double x = 1.6 * column / cells - 0.8, y = 1.6 * row / cells - 0.8;
        mesh.positions.push_back({x + 0.1 * layer * y, y - 0.1 * layer * x, 0.45 + 0.05 * layer});
        if (column == 0 || row == 0)
            continue;
        mesh.triangles.push_back({i - side - 1, i - side, i});
        mesh.triangles.push_back({i - side - 1, i, i - 1});
    }
    return mesh;
}

class Cloth {
public:
    explicit Cloth(const abut::Mesh& mesh)
        : surface_(mesh), positions_(mesh.positions), velocities_(mesh.positions.size()),
          stretch_(abut::colour_constraints(surface_.edges())) {
        for (const auto& [a, b] : surface_.edges())
            lengths_.push_back(length(positions_[b] - positions_[a]));
    }

    void step() {
        proposed_ = positions_;
        for (std::size_t i = 0; i < proposed_.size(); ++i)
            proposed_[i] = proposed_[i] + kStep * (velocities_[i] + kStep * Vec3{0, 0, -9.81});
        for (int round = 0; round < kRounds; ++round) {
            pull_edges();
            surface_.set_motion(positions_, proposed_);
            push_layers_apart();
            push_out_of_ball();
        }
        stop_impacts();
        for (std::size_t i = 0; i < proposed_.size(); ++i)
            velocities_[i] = (0.99 / kStep) * (proposed_[i] - positions_[i]);
        positions_ = proposed_;
    }
    /// How many edges pass through faces.
    std::size_t tangles() {
        surface_.set_motion(positions_, positions_);
        return self_intersections(surface_).size();
    }
    /// How deep the cloth is in the ball.
    double depth() const {
        double depth = 0;
        for (const abut::SurfaceContact& contact : within(surface_, ball_, {}, 0))
            depth = std::max(depth, -contact.distance);
        return depth;
    }
    std::size_t contacts() const { return contacts_; }
    std::size_t impacts() const { return impacts_; }

private:
    /// Moves the vertices of a constraint along its gradient, by as much as it needs. All vertices
    /// have the same mass.
    template <std::size_t N>
    void correct(const std::array<std::uint32_t, N>& vertices, const std::array<double, N>& weights,
                 const Vec3& normal, double missing, double compliance = 0) {
        double sum = compliance / (kStep * kStep);
        for (const double weight : weights)
            sum += weight * weight;
        for (std::size_t i = 0; i < N; ++i)
            proposed_[vertices[i]] = proposed_[vertices[i]] + (missing / sum * weights[i]) * normal;
    }
    void pull_edges() {
        // Edges of one colour share no vertex: they could be solved in parallel.
        for (int round = 0; round < kSolverRounds; ++round)
            for (const std::uint32_t edge : stretch_.order) {
                const auto& [a, b] = surface_.edges()[edge];
                const Vec3 along = proposed_[b] - proposed_[a];
                const double now = length(along);
                if (now > 0)
                    correct<2>({a, b}, {-1, 1}, (1 / now) * along, lengths_[edge] - now, kStretch);
            }
    }
    void push_layers_apart() {
        const auto pairs = self_within(surface_, kThickness, {.at_end = true});
        const abut::ConstraintColours colours = abut::colour_constraints(pairs);
        for (const std::uint32_t i : colours.order)
            correct(pairs[i].vertices, pairs[i].weights, pairs[i].normal,
                    pairs[i].limit - pairs[i].distance);
        contacts_ += pairs.size();
    }
    void push_out_of_ball() {
        for (const auto& contact : within(surface_, ball_, {}, kThickness, {.at_end = true})) {
            correct(contact.vertices, contact.weights, contact.normal,
                    contact.limit - contact.distance);
            ++contacts_;
        }
    }
    /// Takes back the motion of vertices whose way is not free, until the step is proven to be.
    void stop_impacts() {
        for (int attempt = 0; attempt < kAttempts; ++attempt) {
            surface_.set_motion(positions_, proposed_);
            const abut::Impacts impacts = self_impacts(surface_);
            if (impacts.list.empty())
                return;
            impacts_ += impacts.list.size();
            for (const abut::FeatureImpact& impact : impacts.list)
                for (const std::uint32_t vertex : vertices_of(impact))
                    proposed_[vertex] = positions_[vertex];
        }
        proposed_ = positions_;
    }
    std::array<std::uint32_t, 4> vertices_of(const abut::FeatureImpact& impact) const {
        if (impact.kind == abut::ElementaryKind::vertex_face) {
            const auto& t = surface_.triangles()[impact.b];
            return {impact.a, t[0], t[1], t[2]};
        }
        const auto &e = surface_.edges()[impact.a], &f = surface_.edges()[impact.b];
        return {e[0], e[1], f[0], f[1]};
    }

    abut::Deformable surface_;
    std::vector<Vec3> positions_, velocities_, proposed_;
    std::vector<double> lengths_; ///< of the edges at rest
    abut::ConstraintColours stretch_;
    abut::RigidShape ball_ = abut::Sphere{{}, kBallRadius};
    std::size_t contacts_ = 0, impacts_ = 0;
};

int run(int argc, char** argv) {
    const int steps = argc > 1 ? std::atoi(argv[1]) : 120;
    const int cells = argc > 2 ? std::atoi(argv[2]) : 24;
    Cloth cloth(two_layers(static_cast<std::uint32_t>(std::clamp(cells, 1, 500))));
    for (int step = 0; step < steps; ++step)
        cloth.step();
    const std::size_t tangles = cloth.tangles();
    std::printf("%zu contacts, %zu impacts; %zu edges through faces; %.4f m deep in the ball\n",
                cloth.contacts(), cloth.impacts(), tangles, cloth.depth());
    return tangles == 0 ? 0 : 1;
}

} // namespace

int main(int argc, char** argv) {
    return run_program("abut-cloth", run, argc, argv);
}
