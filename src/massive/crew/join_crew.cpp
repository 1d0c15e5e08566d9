#include <abut/crew.h>
#include <abut/error.h>

#include "core/program_folder.h"

#include <cstdlib>
#include <dlfcn.h>
#include <filesystem>
#include <string>

namespace abut {

namespace {

namespace fs = std::filesystem;

/// The number of processes that a launcher started, and the rank of this one.
struct Launch {
    std::size_t size = 0; ///< 0 if the launcher does not tell
    std::size_t rank = 0;
};

std::optional<std::size_t> number(const char* variable) {
    const char* const text = std::getenv(variable);
    if (text == nullptr)
        return std::nullopt;
    return std::strtoull(text, nullptr, 10);
}

std::optional<Launch> launch() {
    struct Variables {
        const char *rank, *size;
    };
    // The launchers, in this order: mpirun of Open MPI; mpirun of MPICH or srun --mpi=pmi2;
    // srun --mpi=pmix.
    for (const auto& [rank, size] :
         {Variables{"OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE"},
          Variables{"PMI_RANK", "PMI_SIZE"}, Variables{"PMIX_RANK", "SLURM_STEP_NUM_TASKS"}})
        if (const auto which = number(rank))
            return Launch{number(size).value_or(0), *which};
    return std::nullopt;
}

/// Returns the path of the module that src/massive/mpi is built into. It is loaded only when it is
/// needed, because MPI takes time to load.
fs::path find_module() {
    const fs::path here = program_folder();
    for (const fs::path& candidate :
         {here / "abut-mpi.so", here.parent_path() / "libexec/abut/abut-mpi.so",
          helper_folder() / "abut-mpi.so", fs::path(ABUT_INSTALLED_MPI),
          fs::path(ABUT_BUILD_MPI)}) {
        std::error_code ignored;
        if (fs::is_regular_file(candidate, ignored))
            return candidate;
    }
    throw Error(ErrorCode::unsupported,
                "this process was started as one of several, but this build has no MPI");
}

} // namespace

std::unique_ptr<Crew> join_crew() {
    const auto started = launch();
    if (!started || started->size == 1)
        return nullptr;
    const fs::path module = find_module();
    // RTLD_GLOBAL, because Open MPI's own modules look up its symbols globally. Never closed.
    void* const handle = dlopen(module.c_str(), RTLD_NOW | RTLD_GLOBAL);
    if (handle == nullptr)
        throw Error(ErrorCode::unsupported, module.string(),
                    std::string("cannot be loaded: ") + dlerror());
    using Join = Crew* (*)();
    const auto join = reinterpret_cast<Join>(dlsym(handle, "abut_join_mpi"));
    if (join == nullptr)
        throw Error(ErrorCode::unsupported, module.string(), "is not a module of Abut");
    std::unique_ptr<Crew> crew(join());
    if (started->size > 1 && crew->size() != started->size)
        throw Error(ErrorCode::unsupported,
                    "this process was started as one of " + std::to_string(started->size) +
                        " by another MPI than that which Abut was built with");
    if (crew->size() == 1)
        return nullptr;
    return crew;
}

bool is_helper() {
    const auto started = launch();
    return started && started->rank > 0;
}

} // namespace abut
