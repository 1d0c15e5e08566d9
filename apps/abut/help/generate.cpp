#include "arguments/interrupt.h"
#include "arguments/output_files.h"
#include "commands.h"
#include "help/completion.h"
#include "help/man_page.h"

#include <map>
#include <memory>

namespace abut::command {

namespace {

/// Returns the texts of the files by subfolder and file name. Each kind of file has its own
/// subfolder.
std::map<std::string, std::map<std::string, std::string>> documents(const CLI::App& root) {
    std::map<std::string, std::map<std::string, std::string>> folders;
    folders["man1"]["abut.1"] = man_page(root);
    for (const Verb* verb : verbs_of(root))
        folders["man1"]["abut-" + verb->get_name() + ".1"] = man_page(*verb);
    folders["bash"]["abut"] = bash_completion(root);
    folders["zsh"]["_abut"] = zsh_completion(root);
    return folders;
}

int run(const CLI::App& root, const std::string& out) {
    const InterruptScope scope(OnInterrupt::defer);
    for (const auto& [folder, files] : documents(root)) {
        std::vector<std::string> names;
        for (const auto& [name, text] : files)
            names.push_back(name);
        OutputFiles outputs(std::filesystem::path(out) / folder, names);
        for (const auto& [name, text] : files)
            outputs.stage_text(name, text);
        outputs.commit();
    }
    return kExitDone;
}

} // namespace

Subcommand add_generate(CLI::App& root, CommonOptions& common) {
    auto out = std::make_shared<std::string>();
    // The verb has no group, so that no list of verbs shows it. Only the build calls it.
    CLI::App* app = add_subcommand(
        root, common,
        {"generate", "", "Write manual pages and shell completion (used by the build)", {}, ""});
    app->add_option("FOLDER", *out, "Folder for man1, bash and zsh")->required();
    return {app, [&root, out] { return run(root, *out); }};
}

} // namespace abut::command
