#include <abut/model.h>
#include <abut/model_contacts.h>
#include <abut/progress.h>
#include <abut/rigid.h>

#include "measure.h"
#include "peers/peer_contacts.h"
#include "placement.h"
#include "scenes/bodies.h"
#include "scenes/space.h"
#include "suite.h"

#include <fmt/format.h>
#include <memory>
#include <string>
#include <vector>

namespace abut::bench {

namespace {

struct ModelContactsOptions {
    std::size_t pairs = 900;
    std::uint32_t triangles = 2000;
    int rounds = 5;
    std::string only;
    std::uint64_t seed = 1;
};

struct PlacedTwo {
    Transform a, b;
};

Transform moved_by(Transform t, double far, const Vec3& way) {
    t.m[9] += far * way.x, t.m[10] += far * way.y, t.m[11] += far * way.z;
    return t;
}

/// Pairs at random rotations, b pushed into a by `depth` from where they part.
std::vector<PlacedTwo> touching_pairs(const Model& model, double depth,
                                      const ModelContactsOptions& options) {
    scenes::Random random(options.seed);
    std::vector<PlacedTwo> list;
    for (std::size_t i = 0; i < options.pairs; ++i) {
        const Transform a = Pose{{}, random_rotation(random)},
                        b = Pose{{}, random_rotation(random)};
        const Vec3 way = random_direction(random);
        double near = 0, far = 3;
        for (int k = 0; k < 30; ++k) {
            const double middle = 0.5 * (near + far);
            (collide(model, a, model, moved_by(b, middle, way)).meet() ? near : far) = middle;
        }
        list.push_back({a, moved_by(b, far - depth, way)});
    }
    return list;
}

/// Measures manifolds of pairs of one mesh, against the bare list of pairs and against peers.
Report run_model_contacts_suite(const ModelContactsOptions& options) {
    Report report;
    report.suite = "model-contacts";
    report.notes.push_back(
        "ms for all pairs, one thread, processor time; 'pairs' is our collide for "
        "all triangle pairs in the same run");
    set_threads(1);
    const Mesh mesh = scenes::boulder(options.triangles, 7);
    const Model model(mesh);
    const auto fcl = make_fcl_contacts(mesh), bullet = make_bullet_contacts(mesh);
    for (const double depth : {0.005, 0.02, 0.2}) {
        const std::string name = fmt::format("{} pairs, {} deep", options.pairs, depth);
        if (name.find(options.only) == std::string::npos)
            continue;
        const std::vector<PlacedTwo> list = touching_pairs(model, depth, options);
        std::size_t regions = 0, points = 0, met = 0;
        for (const PlacedTwo& p : list) {
            for (const ModelManifold& m : contact_manifolds(model, p.a, model, p.b))
                ++regions, points += m.count;
            met += collide(model, p.a, model, p.b, {.mode = ContactMode::all}).pairs.size();
        }
        const auto milliseconds = [&](const auto& work) {
            return 1e3 * take_turns(list.size(), list.size(), options.rounds,
                                    [&](std::size_t begin, std::size_t end) {
                                        for (std::size_t i = begin; i < end; ++i)
                                            work(list[i]);
                                    },
                                    {})
                             .ours;
        };
        Row row{name, 0, {}, {}, "ms", 1, {}};
        row.ours =
            milliseconds([&](const PlacedTwo& p) { contact_manifolds(model, p.a, model, p.b); });
        row.counters["pairs, ms"] = milliseconds([&](const PlacedTwo& p) {
            collide(model, p.a, model, p.b, {.mode = ContactMode::all});
        });
        for (ContactPeer* peer : {fcl.get(), bullet.get()})
            if (peer != nullptr) {
                const double time =
                    milliseconds([&](const PlacedTwo& p) { peer->contacts(p.a, p.b); });
                std::size_t found = 0;
                for (const PlacedTwo& p : list)
                    found += peer->contacts(p.a, p.b);
                row.counters[peer->name() + ", ms"] = time;
                row.counters[peer->name() + ", contacts a pair"] =
                    static_cast<double>(found) / static_cast<double>(list.size());
                if (!row.theirs || time < *row.theirs)
                    row.theirs = time, row.peer = peer->name();
            }
        const auto count = static_cast<double>(list.size());
        row.counters["regions a pair"] = static_cast<double>(regions) / count;
        row.counters["points a pair"] = static_cast<double>(points) / count;
        row.counters["triangle pairs a pair"] = static_cast<double>(met) / count;
        report.rows.push_back(row);
    }
    set_threads(0);
    return report;
}

const Suite kModelContactsSuite(
    "model-contacts", "Contact manifolds of two meshes, against Bullet's GImpact and FCL's pairs",
    [](CLI::App& suite) -> RunSuite {
        const auto options = std::make_shared<ModelContactsOptions>();
        suite.add_option("--pairs", options->pairs, "Pairs of meshes");
        suite.add_option("--triangles", options->triangles, "Of each mesh, about");
        suite.add_option("--seed", options->seed, "Of the poses");
        add_rounds(suite, options->rounds);
        add_only(suite, options->only);
        return [options] { return run_model_contacts_suite(*options); };
    });

} // namespace

} // namespace abut::bench
