#include "suites.h"

#include <CLI/CLI.hpp>
#include <exception>
#include <fmt/format.h>

int main(int argc, char** argv) {
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
    clash_suite->add_option("--rounds", clash.rounds, "Passes; medians are printed")
        ->check(CLI::Range(1, 1000));
    clash_suite->add_option("--threads", clash.threads, "Of the rows with several threads")
        ->check(CLI::Range(1, 1024));
    clash_suite->add_option("--job-limit", clash.job_limit, "Seconds; 0 leaves the whole job out")
        ->check(CLI::NonNegativeNumber);
    clash_suite->callback([&] { report = run_clash_suite(clash); });

    ImportSuiteOptions import;
    CLI::App* import_suite =
        app.add_subcommand("import", "Models read in isolation, against Assimp in process");
    import_suite->add_option("files", import.files, "Model files (GLB)")->required();
    import_suite->add_option("--rounds", import.rounds, "Passes; medians are printed")
        ->check(CLI::Range(1, 1000));
    import_suite->callback([&] { report = run_import_suite(import); });

    ShapesSuiteOptions shapes;
    CLI::App* shapes_suite =
        app.add_subcommand("shapes", "One model and rays, points: against Embree and CGAL");
    shapes_suite->add_option("--model", shapes.file, "Model file to use instead of a wavy torus");
    shapes_suite->add_option("--triangles", shapes.triangles, "Of the torus");
    shapes_suite->add_option("--queries", shapes.queries, "In each case");
    shapes_suite->add_option("--rounds", shapes.rounds, "Passes; medians are printed")
        ->check(CLI::Range(1, 1000));
    shapes_suite->add_option("--seed", shapes.seed, "Of the queries");
    shapes_suite->callback([&] { report = run_shapes_suite(shapes); });

    for (CLI::App* suite : app.get_subcommands({}))
        suite->add_flag("--json", json, "One JSON object instead of the table");
    try {
        app.parse(argc, argv);
        json ? print_json(report) : print_table(report);
        return 0;
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    } catch (const std::exception& error) {
        fmt::print(stderr, "abut-bench: {}\n", error.what());
        return 2;
    }
}
