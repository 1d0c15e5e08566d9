// Finds every clash between the parts of models, and writes a page that shows them.
//
//     abut-clashes REPORT.html MODEL...

#include <abut/clash.h>
#include <abut/scene.h>

#include "program.h"

#include <string>
#include <vector>

namespace {

int run(int argc, char** argv) {
    if (argc < 3) {
        std::fputs("usage: abut-clashes REPORT.html MODEL...\n", stderr);
        return 2;
    }
    const std::vector<std::string> files(argv + 2, argv + argc);
    const std::vector<abut::Scene> models = abut::read_scenes(files);
    const abut::ClashReport report = abut::find_clashes(models, {.clearance = 0.05});
    for (const abut::Clash& clash : report.clashes) {
        const abut::Part& a = models[clash.model[0]].parts[clash.part[0]];
        const abut::Part& b = models[clash.model[1]].parts[clash.part[1]];
        std::printf("%s %g m: %s and %s\n", abut::to_string(clash.kind), clash.distance,
                    a.name.c_str(), b.name.c_str());
    }
    abut::write_clash_html(report, models, argv[1]);
    return 0;
}

} // namespace

int main(int argc, char** argv) {
    return run_program("abut-clashes", run, argc, argv);
}
