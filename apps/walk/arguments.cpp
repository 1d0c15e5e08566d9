#include "arguments.h"

#include <abut/error.h>

#include "arguments/verb.h"
#include "help/completion.h"
#include "help/help.h"
#include "help/man_page.h"
#include "text/screen.h"

#include <CLI/CLI.hpp>
#include <charconv>
#include <cstdio>
#include <filesystem>
#include <fstream>

namespace abut::viewer {

namespace {

constexpr unsigned kLargestSide = 8192; ///< of a picture, pixels

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

command::VerbHelp walk_help() {
    return {"walk",
            "",
            "Walk through models in a window, with their distances in the hand",
            {{"abut-walk plant.abut", "walks through a store; F1 lists the keys"},
             {"abut-walk design.glb pipes.glb --carry pump.stl:mm",
              "imports two models, and takes a third one in the hand"},
             {"abut-walk plant.abut --path tour.json --frames pictures",
              "replays a recorded path without a window"}},
            "",
            "abut-walk"};
}

void write_document(const std::filesystem::path& folder, const std::string& name,
                    const std::string& text) {
    std::filesystem::create_directories(folder);
    std::ofstream file(folder / name);
    file << text;
    if (!file.flush())
        throw Error(ErrorCode::cannot_write, (folder / name).string(), "cannot be written");
}

/// Writes the manual page and the completion, for the build.
void generate(const command::Verb& app, const std::filesystem::path& folder) {
    write_document(folder / "man1", "abut-walk.1", command::man_page(app));
    write_document(folder / "bash", "abut-walk", command::bash_completion_of(app));
    write_document(folder / "zsh", "_abut-walk", command::zsh_completion_of(app));
}

struct Texts {
    std::string memory = "1G", gpu_memory = "512M", size = "1280x720", generate;
};

void declare(command::Verb& app, Arguments& arguments, Texts& texts) {
    app.set_version_flag("--version", "abut-walk " ABUT_VERSION, "Print the version and exit");
    app.add_option("MODEL", arguments.files, "Models, or one store")->required();
    const auto text = [&](const char* name, std::string& value, const char* kind,
                          const char* says) {
        return app.add_option(name, value, says)->type_name(kind);
    };
    text("--part", arguments.part, "NAME", "Begin at a part, by its id or name");
    text("--carry", arguments.carry, "FILE", "Bring in a model, and take it in the hand");
    text("--size", texts.size, "WxH", "Size of the window or the pictures (default 1280x720)");
    text("--memory", texts.memory, "BYTES", "Memory for models, with K, M or G (default 1G)");
    text("--gpu-memory", texts.gpu_memory, "BYTES", "Memory on the graphics card (default 512M)");
    app.add_option("--pixel-error", arguments.pixel_error,
                   "Largest error of what is drawn, in pixels (default 1)")
        ->type_name("PIXELS")
        ->check(CLI::PositiveNumber.description(""));
    CLI::Option* path =
        text("--path", arguments.path, "FILE", "Replay a recorded path, without a window");
    CLI::Option* frames = text("--frames", arguments.frames, "FOLDER",
                               "Folder for the pictures and figures of --path");
    app.add_option("--rate", arguments.rate,
                   "Pictures a second of the path; with --paced, at most so many (default 15)")
        ->type_name("NUMBER")
        ->check(CLI::Range(0.01, 1000.0).description(""));
    app.add_flag("--paced", arguments.paced,
                 "Replay by the clock, with as many triangles as can be drawn in time, and write "
                 "figures only")
        ->needs(path);
    CLI::Option* log = text("--log", arguments.log, "FILE",
                            "Write each state of the window to a file, one JSON object a line");
    app.add_flag("--quiet", arguments.quiet, "Print only errors");
    app.add_option("--generate", texts.generate)->group("")->type_name("FOLDER");
    path->needs(frames);
    frames->needs(path);
    log->excludes(path);
}

void set_size(const std::string& size, Arguments& arguments) {
    unsigned width = 0, height = 0;
    char rest = 0;
    if (std::sscanf(size.c_str(), "%ux%u%c", &width, &height, &rest) != 2 || // NOLINT
        width < 1 || height < 1 || width > kLargestSide || height > kLargestSide)
        throw Error(ErrorCode::bad_argument, "--size",
                    "'" + size + "' is not WIDTHxHEIGHT, each from 1 to 8192");
    arguments.width = width, arguments.height = height;
}

} // namespace

bool parse(int argc, char** argv, Arguments& arguments) {
    command::Verb app(walk_help());
    Texts texts;
    declare(app, arguments, texts);
    if (argc == 3 && std::string_view(argv[1]) == "--generate") { // NOLINT
        generate(app, argv[2]);                                   // NOLINT
        return false;
    }
    try {
        app.parse(argc, argv);
    } catch (const CLI::CallForHelp&) {
        command::print_text(command::help_of(app));
        return false;
    } catch (const CLI::CallForVersion&) {
        std::puts("abut-walk " ABUT_VERSION);
        return false;
    } catch (const CLI::ParseError& error) {
        throw Error(ErrorCode::bad_argument, error.what());
    }
    arguments.memory = parse_bytes("--memory", texts.memory);
    arguments.gpu_memory = parse_bytes("--gpu-memory", texts.gpu_memory);
    set_size(texts.size, arguments);
    return true;
}

} // namespace abut::viewer
