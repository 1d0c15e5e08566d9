// Imports models of any size into a store on disk, and finds their clashes in little memory. If
// mpirun starts several processes, they share the work.
//
//     abut-store-clashes STORE MODEL...
//     mpirun -n 4 abut-store-clashes STORE

#include <abut/crew.h>
#include <abut/store.h>
#include <abut/store_clash.h>

#include "program.h"

#include <cstdint>
#include <string>
#include <vector>

namespace {

constexpr std::uint64_t kMemory = std::uint64_t{256} << 20;

int run(int argc, char** argv) {
    if (argc < 2) {
        std::fputs("usage: abut-store-clashes STORE [MODEL...]\n", stderr);
        return 2;
    }
    const std::string store = argv[1];
    const std::vector<std::string> files(argv + 2, argv + argc);
    if (!files.empty())
        abut::import_models(files, store, {.memory = kMemory});

    const auto crew = abut::join_crew(); // null if mpirun did not start this process
    if (crew && crew->rank() > 0) {
        abut::help_find_clashes(store, *crew);
        return 0;
    }
    const abut::StoreClashReport found = abut::find_clashes(
        abut::open_store(store), {.clearance = 0.05}, {.memory = kMemory, .crew = crew.get()});
    std::printf("%zu clashes, found by %zu processes\n", found.report.clashes.size(),
                found.counters.workers.size());
    return 0;
}

} // namespace

int main(int argc, char** argv) {
    return run_program("abut-store-clashes", run, argc, argv);
}
