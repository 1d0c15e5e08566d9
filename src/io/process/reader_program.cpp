#include "io/process/reader_program.h"

#include <abut/error.h>

#include "core/program_folder.h"
#include "io/file/input_file.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <string_view>
#include <unistd.h>

namespace abut {

namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 3> kAssimpExtensions{".fbx", ".dae", ".3mf"};

std::string environment(const char* name) {
    const char* const value = std::getenv(name);
    return value == nullptr ? "" : value;
}

bool is_program(const fs::path& path) {
    std::error_code ignored;
    return fs::is_regular_file(path, ignored) && access(path.c_str(), X_OK) == 0;
}

bool is_there(const fs::path& path) {
    std::error_code ignored;
    return fs::exists(path, ignored);
}

std::string find_reader(const std::string& file) {
    std::string chosen = environment("ABUT_READER");
    if (!chosen.empty()) {
        if (is_program(chosen))
            return chosen;
        throw Error(ErrorCode::unsupported, file,
                    "cannot be read: ABUT_READER does not name a program: " + chosen);
    }
    const fs::path here = program_folder();
    for (const fs::path& candidate :
         {here / "abut-reader", here.parent_path() / "libexec/abut/abut-reader",
          helper_folder() / "abut-reader", fs::path(ABUT_INSTALLED_READER),
          fs::path(ABUT_BUILD_READER)})
        if (is_program(candidate))
            return candidate;
    throw Error(ErrorCode::unsupported, file,
                "cannot be read: the program abut-reader is missing (set ABUT_READER to its path)");
}

std::string find_node(const std::string& file, const fs::path& converter) {
    std::string chosen = environment("ABUT_NODE");
    if (!chosen.empty()) {
        if (is_program(chosen))
            return chosen;
        throw Error(ErrorCode::unsupported, file,
                    "cannot be read: ABUT_NODE does not name a program: " + chosen);
    }
    const std::string path = environment("PATH");
    for (const char* const name : {"node", "nodejs"}) {
        for (std::size_t start = 0; start <= path.size();) {
            const std::size_t end = std::min(path.find(':', start), path.size());
            const fs::path candidate = fs::path(path.substr(start, end - start)) / name;
            if (end > start && is_program(candidate))
                return candidate;
            start = end + 1;
        }
    }
    throw Error(
        ErrorCode::unsupported, file,
        "IFC needs Node.js: run tools/install_dependencies build, or `apt-get install nodejs npm` "
        "and `npm ci` in " +
            converter.string());
}

fs::path find_converter(const std::string& file) {
    const std::string chosen = environment("ABUT_IFC_CONVERTER");
    if (!chosen.empty()) {
        if (is_there(fs::path(chosen) / "convert.mjs"))
            return chosen;
        throw Error(ErrorCode::unsupported, file,
                    "cannot be read: ABUT_IFC_CONVERTER does not name a folder with convert.mjs: " +
                        chosen);
    }
    const std::array candidates{program_folder().parent_path() / "libexec/abut/ifc",
                                helper_folder() / "ifc", fs::path(ABUT_INSTALLED_IFC),
                                fs::path(ABUT_SOURCE_IFC)};
    for (const fs::path& candidate : candidates)
        if (is_there(candidate / "convert.mjs") && is_there(candidate / "node_modules/web-ifc"))
            return candidate;
    for (const fs::path& candidate : candidates)
        if (is_there(candidate / "convert.mjs"))
            return candidate;
    throw Error(
        ErrorCode::unsupported, file,
        "cannot be read: the IFC converter is missing (set ABUT_IFC_CONVERTER to its folder)");
}

} // namespace

std::vector<std::string> reader_command(const std::string& file, const ReadOptions& options) {
    const std::string extension = lower_extension(file);
    const std::string parent = std::to_string(getpid());
    if (extension == ".ifc" || extension == ".ifczip") {
        const fs::path converter = find_converter(file);
        const std::string node = find_node(file, converter);
        if (!is_there(converter / "node_modules/web-ifc"))
            throw Error(ErrorCode::unsupported, file,
                        "IFC needs web-ifc: run `npm ci` in " + converter.string());
        // No limit of address space, because Node.js reserves far more than it uses. run_child
        // watches the resident memory.
        return {find_reader(file),
                parent,
                "0",
                "--exec",
                node,
                converter / "convert.mjs",
                file,
                options.spaces ? "spaces" : "no-spaces",
                options.map ? "map" : "no-map"};
    }
    if (std::find(kAssimpExtensions.begin(), kAssimpExtensions.end(), extension) ==
        kAssimpExtensions.end())
        throw Error(ErrorCode::unsupported, file,
                    "no reader for " + (extension.empty() ? "files without extension" : extension) +
                        " (known: .glb .gltf .obj .ply .stl .off .fbx .dae .3mf .ifc .ifczip)");
    return {find_reader(file), parent, std::to_string(options.memory_limit), "--read", file};
}

std::vector<std::string> decoder_command(const std::string& file, std::uint64_t memory_limit) {
    return {find_reader(file), std::to_string(getpid()), std::to_string(memory_limit), "--decode"};
}

} // namespace abut
