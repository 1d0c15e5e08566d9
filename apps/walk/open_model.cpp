#include "open_model.h"

#include <abut/error.h>
#include <abut/levels.h>
#include <abut/store.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <unistd.h>

namespace abut::viewer {

namespace fs = std::filesystem;

namespace {

/// A hash that is equal in every run, for the name of a cached store [Fowler, Noll, Vo 1a].
std::uint64_t name_hash(const std::vector<std::string>& files) {
    std::uint64_t hash = 0xcbf29ce484222325;
    for (const std::string& file : files)
        for (const char c : fs::absolute(parse_model_path(file).path).string() + '\n')
            hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
    return hash;
}

fs::path cache_folder() {
    const auto variable = [](const char* name) {
        const char* text = std::getenv(name); // NOLINT: before any thread starts
        return std::string(text != nullptr ? text : "");
    };
    const std::string cache = variable("XDG_CACHE_HOME"), home = variable("HOME");
    if (cache.empty() && home.empty())
        throw Error(ErrorCode::cannot_write, "the cache folder",
                    "is not known: neither XDG_CACHE_HOME nor HOME is set");
    fs::path folder = (cache.empty() ? fs::path(home) / ".cache" : fs::path(cache)) / "abut";
    std::error_code fault;
    fs::create_directories(folder, fault);
    if (fault)
        throw Error(ErrorCode::cannot_write, folder.string(),
                    "cannot be created: " + fault.message());
    return folder;
}

} // namespace

std::string ready_store(const std::vector<std::string>& files, const Progress& progress) {
    std::string path = files.front();
    if (files.size() > 1 || !is_store(path)) {
        for (const std::string& file : files)
            if (is_store(file))
                throw Error(ErrorCode::bad_argument, file,
                            "is a store, and can be walked through only on its own");
        std::vector<ModelPath> models;
        models.reserve(files.size());
        for (const std::string& file : files)
            models.push_back(parse_model_path(file));
        path = (cache_folder() / fmt::format("{:016x}.abut", name_hash(files))).string();
        import_models(models, path, {.progress = progress});
    }
    if (!has_levels(open_store(path)))
        build_levels(path, {.progress = progress});
    return path;
}

Progress terminal_progress(bool quiet) {
    if (quiet || isatty(STDERR_FILENO) == 0)
        return {};
    return {.report =
                [](std::string_view stage, double fraction) {
                    fmt::print(stderr, "\r{} {:.0f} %\033[K{}", stage, 100 * fraction,
                               fraction >= 1 ? "\r\033[K" : "");
                    std::fflush(stderr);
                },
            .stop = nullptr};
}

} // namespace abut::viewer
