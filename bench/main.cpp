#include "suite.h"

#include <cstdio>
#include <exception>

namespace {

int run(int argc, char** argv) {
    using namespace abut::bench;
    CLI::App app("Measures Abut against its peers, in turn in one process", "abut-bench");
    app.require_subcommand(1);
    bool json = false;
    Report report;
    for (const Suite* suite : Suite::all())
        suite->add_to(app, report)
            ->add_flag("--json", json, "One JSON object instead of the table");
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
