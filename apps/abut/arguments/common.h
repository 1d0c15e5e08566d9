#pragma once

#include <abut/scene.h>
#include <abut/types.h>

#include "arguments/verb.h"
#include "text/in_words.h"
#include "text/progress_bar.h"
#include "text/screen.h"

#include <CLI/CLI.hpp>
#include <chrono>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Shared code of the subcommands: common options, exit statuses, checks of arguments, output.
namespace abut::command {

inline constexpr int kExitDone = 0;
inline constexpr int kExitProblem = 1; ///< --fail-on is given and the problem was found
inline constexpr int kExitBadInput = 2;

struct CommonOptions {
    bool json = false;
    bool quiet = false;
    bool progress = false;
    int threads = 0;

    /// A bar on a terminal unless --quiet is given; lines elsewhere if --progress is given.
    [[nodiscard]] ProgressBar::Style progress_style() const;
};

/// A declared subcommand. run() is called if the arguments name it; it returns the exit status.
struct Subcommand {
    CLI::App* app = nullptr;
    std::function<int()> run;
};

/// Declares a subcommand with the common options --json, --threads, --quiet and --progress.
CLI::App* add_subcommand(CLI::App& root, CommonOptions& common, const VerbHelp& help);

/// The forms of a model file argument, for the help of commands that read models.
inline constexpr const char* kModelHelp =
    "FILE, or FILE:UNIT:AXIS such as pump.stl:mm or part.obj:mm:y-up";

/// Declares --unit, --up, --spaces, --no-map and --allow-outside-files.
void add_read_options(CLI::App& app, ReadOptions& options);

/// Calls parse_model_path for each text.
std::vector<ModelPath> parse_model_paths(const std::vector<std::string>& texts);

/// Returns {"up": "z", "unit": "m", "of": file}, which describes the frame of all points of an
/// answer.
nlohmann::ordered_json describe_frame(UpAxis up, const std::string& of);

/// Returns [{kind, id, name, type, text}].
nlohmann::ordered_json to_json(const std::vector<SceneNote>& notes);
/// Returns one line for each kind of note, with the number of notes and the first few ids. Each
/// line begins with `indent`. Empty without notes.
std::string in_words(const std::vector<SceneNote>& notes, const std::string& indent);

/// Declares --fail-on, whose only valid word is `problem`. `fail_on` stays empty if it is not
/// given.
void add_fail_on(CLI::App& app, std::string& fail_on, const std::string& problem);

/// Parses the whole text as one finite number; none if it is not.
std::optional<double> parse_number(std::string_view text);

/// Parses a length and returns it in metres. The text is a finite number followed by mm, cm, m, in
/// or ft; without a unit it is in metres.
std::optional<double> parse_length(std::string_view text);

/// Parses a comma-separated list of as many finite numbers as `form` names ("x,y,z"). The first
/// `lengths` of them may have a unit, as in parse_length.
///
/// Errors      Error{bad_argument}; its message begins with `what` (an option or a place in a
///             file).
std::vector<double> parse_numbers(const std::string& what, std::string_view text,
                                  const std::string& form, std::size_t lengths = 0);
/// Parses "x,y,z", each a length. Errors as parse_numbers.
Vec3 parse_point(const std::string& what, std::string_view text);
/// Parses "x,y,z" as plain numbers. Errors as parse_numbers.
Vec3 parse_direction(const std::string& what, std::string_view text);

/// Checks of option values: text that is not empty; a finite number of at least 0; one above 0; a
/// whole number in a range.
CLI::Validator not_empty(const std::string& type_name);
CLI::Validator not_negative();
CLI::Validator positive();
CLI::Validator whole_number(std::uint64_t lowest, std::uint64_t highest);

/// Checks for a length of at least 0, in the form of parse_length.
CLI::Validator length();

/// Declares an option whose value is a length such as "50mm". The current `value` is the default.
template <typename Value>
CLI::Option* add_length(CLI::App& app, const std::string& option, Value& value,
                        const std::string& description) {
    const auto set = [&value](const std::string& text) { value = parse_length(text).value(); };
    return app.add_option_function<std::string>(option, set, description)->check(length());
}

/// Parses a number of bytes such as "512M", with K, M or G for powers of 1024.
///
/// Errors      Error{bad_argument}, naming the option.
std::uint64_t parse_bytes(const std::string& option, const std::string& text);

/// Parses a comma-separated list of words, each of which must be one of `known`.
///
/// Errors      Error{bad_argument} naming the option.
std::vector<std::string> parse_words(const std::string& option, const std::string& text,
                                     const std::vector<std::string>& known);

/// Measures the wall-clock time of a stage.
class Stopwatch {
public:
    [[nodiscard]] double seconds() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }

private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Formats 1234567 as "1,234,567".
std::string grouped(std::uint64_t value);

/// Returns [x, y, z].
nlohmann::ordered_json to_json(const Vec3& v);

const char* to_string(Feature feature);
const char* to_string(Status status);

/// Returns one line of JSON text. Bytes that are not UTF-8 (in file names) are replaced.
std::string dump(const nlohmann::ordered_json& value);

} // namespace abut::command
