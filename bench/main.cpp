#include "suites.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <string>

namespace {

void add_rounds(CLI::App* suite, int& rounds) {
    suite->add_option("--rounds", rounds, "Passes; medians are taken")->check(CLI::Range(1, 1000));
}

void add_only(CLI::App* suite, std::string& only) {
    suite->add_option("--only", only, "Cases whose name has this in it");
}

int run(int argc, char** argv) {
    using namespace abut::bench;
    CLI::App app("Measures Abut against its peers, in turn in one process", "abut-bench");
    app.require_subcommand(1);
    bool json = false;
    Report report;

    ClashSuiteOptions clash;
    CLI::App* clash_suite = app.add_subcommand(
        "clash",
        "2,000 instances of one part of 20,000 triangles: contact and clearance, against FCL");
    clash_suite->add_option("--instances", clash.scene.instances, "Number of instances");
    clash_suite->add_option("--spacing", clash.scene.spacing, "Of the grid, in diagonals");
    clash_suite->add_option("--bend", clash.scene.bend, "Angle of the part's bend, radians");
    clash_suite->add_option("--tube", clash.scene.tube, "Radius of its tube, in radii of the bend");
    clash_suite->add_flag_callback(
        "--tight", [&] { clash.scene.boxes = CandidateBoxes::tight; },
        "Candidates by the placed parts' own boxes, not by boxes for any rotation");
    clash_suite->add_option("--seed", clash.scene.seed, "Of jitter and rotations");
    clash_suite->add_option("--part", clash.part_file,
                            "Model file to use instead of the bent pipe");
    clash_suite->add_option("--clearance", clash.clearance, "In diagonals of the part")
        ->check(CLI::PositiveNumber);
    add_rounds(clash_suite, clash.rounds);
    clash_suite->add_option("--threads", clash.threads, "Of the rows with several threads")
        ->check(CLI::Range(1, 1024));
    clash_suite->add_option("--job-limit", clash.job_limit, "Seconds; 0 leaves the whole job out")
        ->check(CLI::NonNegativeNumber);
    clash_suite->callback([&] { report = run_clash_suite(clash); });

    ImportSuiteOptions import;
    CLI::App* import_suite =
        app.add_subcommand("import", "Models read in isolation, against Assimp in process");
    import_suite->add_option("files", import.files, "Model files (GLB)")->required();
    add_rounds(import_suite, import.rounds);
    import_suite->callback([&] { report = run_import_suite(import); });

    RigidSuiteOptions rigid;
    CLI::App* rigid_suite = app.add_subcommand(
        "rigid", "Queries on pairs of models in four regimes, against FCL, CGAL and Embree");
    rigid_suite->add_option("files", rigid.files, "Model files, two a pair");
    rigid_suite->add_option("--generated", rigid.generated,
                            "Pairs of generated models of so many triangles each");
    rigid_suite->add_option("--poses", rigid.poses, "In each regime");
    add_rounds(rigid_suite, rigid.rounds);
    add_only(rigid_suite, rigid.only);
    rigid_suite->add_flag("--alone", rigid.alone, "Without peers");
    rigid_suite->add_flag("--volumes", rigid.volumes, "Also with every kind of bounding volume");
    rigid_suite->add_option("--seed", rigid.seed, "Of the poses");
    rigid_suite->callback([&] { report = run_rigid_suite(rigid); });

    ImpactSuiteOptions impact;
    CLI::App* impact_suite =
        app.add_subcommand("impact", "Time of impact of models that cross each other, against FCL");
    impact_suite->add_option("files", impact.files, "Pairs of model files");
    impact_suite->add_flag("--long", impact.is_long,
                           "Also large bodies that turn against small ones, slide and nest");
    impact_suite->add_option("--motions", impact.motions, "Random motions a row")
        ->check(CLI::Range(1, 1000000));
    add_rounds(impact_suite, impact.rounds);
    impact_suite->add_option("--seed", impact.seed, "Of the motions");
    impact_suite->add_option("--peer-limit", impact.peer_limit, "Seconds a row; 0 leaves FCL out")
        ->check(CLI::NonNegativeNumber);
    impact_suite->callback([&] { report = run_impact_suite(impact); });

    CcdSuiteOptions ccd;
    CLI::App* ccd_suite = app.add_subcommand(
        "ccd", "Continuous collision: elementary tests against FCL, steps of deforming surfaces");
    ccd_suite->add_option("files", ccd.files, "Files of queries (CSV)");
    ccd_suite->add_option("--frames", ccd.frames, "Frames (PLY, OBJ): start and end of each step");
    ccd_suite->add_option("--scenes", ccd.scenes, "Deforming scenes (see abut scene)");
    ccd_suite->add_option("--samples", ccd.samples, "Frames of each scene that are measured")
        ->check(CLI::Range(1, 10000));
    ccd_suite->add_option("--pairs", ccd.pairs, "Generated pairs of each case")
        ->check(CLI::Range(1, 1000000));
    add_rounds(ccd_suite, ccd.rounds);
    ccd_suite->add_option("--seed", ccd.seed, "Of the generated pairs");
    ccd_suite->callback([&] { report = run_ccd_suite(ccd); });

    ShapesSuiteOptions shapes;
    CLI::App* shapes_suite =
        app.add_subcommand("shapes", "One model and rays, points: against Embree and CGAL");
    shapes_suite->add_option("--model", shapes.file, "Model file to use instead of a wavy torus");
    shapes_suite->add_option("--triangles", shapes.triangles, "Of the torus");
    shapes_suite->add_option("--queries", shapes.queries, "In each case");
    add_rounds(shapes_suite, shapes.rounds);
    shapes_suite->add_option("--seed", shapes.seed, "Of the queries");
    shapes_suite->callback([&] { report = run_shapes_suite(shapes); });

    ConvexSuiteOptions convex;
    CLI::App* convex_suite =
        app.add_subcommand("convex", "Pairs of convex bodies, against FCL and Bullet");
    convex_suite->add_option("files", convex.files, "Model files whose hulls are taken too");
    convex_suite->add_option("--vertices", convex.vertices, "Of the ellipsoids");
    convex_suite->add_option("--poses", convex.poses, "In each case");
    convex_suite->add_flag("--alone", convex.alone, "Without peers");
    add_only(convex_suite, convex.only);
    add_rounds(convex_suite, convex.rounds);
    convex_suite->add_option("--seed", convex.seed, "Of bodies and poses");
    convex_suite->callback([&] { report = run_convex_suite(convex); });

    PiecesSuiteOptions pieces;
    CLI::App* pieces_suite =
        app.add_subcommand("pieces", "Solids of convex pieces, against the triangle trees and FCL");
    pieces_suite->add_option("files", pieces.files, "Closed models, two a pair");
    pieces_suite->add_option("--poses", pieces.poses, "In each regime");
    pieces_suite->add_option("--curved", pieces.curved,
                             "Instead: builds of curved bodies of so many triangles");
    pieces_suite->add_option("--part", pieces.part, "Machine parts whose name has this in it");
    add_only(pieces_suite, pieces.only);
    add_rounds(pieces_suite, pieces.rounds);
    pieces_suite->add_option("--seed", pieces.seed, "Of the poses");
    pieces_suite->callback([&] { report = run_pieces_suite(pieces); });

    WorldSuiteOptions world;
    CLI::App* world_suite = app.add_subcommand(
        "world", "Overlapping pairs of moving boxes, against Bullet, CGAL, Embree and FCL");
    world_suite->add_option("--boxes", world.counts, "Numbers of boxes");
    world_suite->add_option("--steps", world.steps, "At least, of each case; means are taken")
        ->check(CLI::Range(1, 100000));
    add_only(world_suite, world.only);
    world_suite->add_flag("--alone", world.alone, "Without peers");
    world_suite->add_flag("--methods", world.methods, "Also each broad phase by itself");
    world_suite->add_option("--peer-limit", world.peer_limit, "Seconds a step, about")
        ->check(CLI::NonNegativeNumber);
    world_suite->add_option("--seed", world.seed, "Of the boxes");
    world_suite->callback([&] { report = run_world_suite(world); });

    MassiveSuiteOptions massive;
    CLI::App* massive_suite = app.add_subcommand(
        "massive",
        "Models beyond the memory: import into a store and its clashes, against the same in core");
    massive_suite->add_option("--plants", massive.plants, "Triangles of each plant");
    massive_suite->add_option("--ground", massive.ground,
                              "Triangles of the large mesh that small parts lie on; 0: none");
    massive_suite->add_option("--sheet", massive.sheet, "Triangles of the one large mesh; 0: none");
    massive_suite->add_option("--memory", massive.memory, "Bytes that the import keeps to");
    massive_suite->add_option("--clash-memory", massive.clash_memory,
                              "Bytes that the clash job keeps to, each in turn");
    add_rounds(massive_suite, massive.rounds);
    massive_suite->callback([&] { report = run_massive_suite(massive); });

    WalkSuiteOptions walk;
    CLI::App* walk_suite =
        app.add_subcommand("walk", "Through a store in little memory: a distance in every frame");
    walk_suite->add_option("--store", walk.store, "Of a model in metres, y up; else a plant");
    walk_suite->add_option("--triangles", walk.triangles, "Of the plant");
    walk_suite->add_option("--memory", walk.memory, "Bytes of the walk, each in turn");
    walk_suite->add_option("--seconds", walk.seconds, "Of each walk")->check(CLI::PositiveNumber);
    add_only(walk_suite, walk.only);
    walk_suite->add_option("--seed", walk.seed, "Of the paths");
    walk_suite->callback([&] { report = run_walk_suite(walk); });

    for (CLI::App* suite : app.get_subcommands({}))
        suite->add_flag("--json", json, "One JSON object instead of the table");
    try {
        app.parse(argc, argv);
        json ? print_json(report) : print_table(report);
        return 0;
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    }
}

} // namespace

int main(int argc, char** argv) {
    try {
        return run(argc, argv);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "abut-bench: %s\n", error.what());
        return 2;
    }
}
