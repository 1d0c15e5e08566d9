#include "arguments.h"

#include <abut/error.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <cstdio>

namespace abut::viewer {

namespace {

std::uint64_t parse_bytes(const std::string& option, const std::string& text) {
    std::uint64_t value = 0;
    const char* end = text.data() + text.size();
    const auto [rest, fault] = std::from_chars(text.data(), end, value);
    int shift = 0;
    if (rest + 1 == end)
        shift = *rest == 'K' ? 10 : *rest == 'M' ? 20 : *rest == 'G' ? 30 : -1;
    if (fault != std::errc() || shift < 0 || end - rest > 1 || value > (UINT64_MAX >> shift))
        throw Error(ErrorCode::bad_argument, option,
                    "'" + text + "' is not a number of bytes such as 512M");
    return value << shift;
}

} // namespace

bool parse(int argc, char** argv, Arguments& arguments) {
    CLI::App app("Walk through models, with their distances in the hand. F1 in the window lists "
                 "its keys; docs/viewer.md explains it.",
                 "abut-walk");
    app.set_version_flag("--version", "abut-walk " ABUT_VERSION);
    std::string memory = "1G", gpu_memory = "512M", size = "1280x720";
    app.add_option("MODEL", arguments.files, "Models, or one store")->required();
    app.add_option("--memory", memory, "Memory for models, with K, M or G (default 1G)");
    app.add_option("--gpu-memory", gpu_memory, "Memory on the graphics card (default 512M)");
    app.add_option("--pixel-error", arguments.pixel_error,
                   "Largest error of what is drawn, in pixels (default 1)")
        ->check(CLI::PositiveNumber);
    app.add_option("--size", size, "Size of the window or the pictures (default 1280x720)");
    CLI::Option* path =
        app.add_option("--path", arguments.path, "Replay a recorded path, without a window");
    CLI::Option* frames = app.add_option("--frames", arguments.frames,
                                         "Folder for the pictures and figures of --path");
    app.add_option("--rate", arguments.rate, "Pictures a second of the path (default 15)")
        ->check(CLI::Range(0.01, 1000.0));
    CLI::Option* log =
        app.add_option("--log", arguments.log,
                       "Write each state of the window to this file, one JSON object a line");
    app.add_flag("--quiet", arguments.quiet, "Print only errors");
    path->needs(frames);
    frames->needs(path);
    log->excludes(path);
    try {
        app.parse(argc, argv);
    } catch (const CLI::CallForHelp&) {
        std::fputs(app.help().c_str(), stdout);
        return false;
    } catch (const CLI::CallForVersion&) {
        std::puts("abut-walk " ABUT_VERSION);
        return false;
    } catch (const CLI::ParseError& error) {
        throw Error(ErrorCode::bad_argument, error.what());
    }
    arguments.memory = parse_bytes("--memory", memory);
    arguments.gpu_memory = parse_bytes("--gpu-memory", gpu_memory);
    unsigned width = 0, height = 0;
    char rest = 0;
    if (std::sscanf(size.c_str(), "%ux%u%c", &width, &height, &rest) != 2 || // NOLINT
        width < 1 || height < 1 || width > 8192 || height > 8192)
        throw Error(ErrorCode::bad_argument, "--size",
                    "'" + size + "' is not WIDTHxHEIGHT, each from 1 to 8192");
    arguments.width = width, arguments.height = height;
    return true;
}

} // namespace abut::viewer
