#include "plot.h"
#include "suite.h"

#include <cstdio>
#include <exception>
#include <string>

namespace {

int run(int argc, char** argv) {
    using namespace abut::bench;
    CLI::App app("Measures Abut against its peers, in turn in one process", "abut-bench");
    app.require_subcommand(1);
    bool json = false;
    Report report;
    std::string picture;
    for (const Suite* suite : Suite::all()) {
        CLI::App* const command = suite->add_to(app, report);
        command->add_flag("--json", json, "One JSON object instead of the table");
        command->add_option("--plot", picture, "Also draw the rows that have a peer: an SVG file");
    }
    try {
        app.parse(argc, argv);
        json ? print_json(report) : print_table(report);
        if (!picture.empty())
            write_plot(report, picture);
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
