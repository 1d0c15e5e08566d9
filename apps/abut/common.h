#pragma once

#include <abut/scene.h>
#include <abut/types.h>

#include "in_words.h"
#include "progress_bar.h"
#include "screen.h"
#include "verb.h"

#include <CLI/CLI.hpp>
#include <chrono>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// What the subcommands share: the common options, exit statuses, checks of arguments, output.
namespace abut::command {

inline constexpr int kExitDone = 0;
inline constexpr int kExitProblem = 1; ///< the answer is "problem found", with --fail-on only
inline constexpr int kExitBadInput = 2;

struct CommonOptions {
    bool json = false;
    bool quiet = false;
    bool progress = false;
    int threads = 0;

    /// A bar on a terminal unless quiet; lines elsewhere with --progress.
    [[nodiscard]] ProgressBar::Style progress_style() const;
};

/// A declared subcommand: run() is called if the arguments name it, and returns the exit status.
struct Subcommand {
    CLI::App* app = nullptr;
    std::function<int()> run;
};

/// Declares a subcommand with the common options --json, --threads, --quiet and --progress.
CLI::App* add_subcommand(CLI::App& root, CommonOptions& common, const VerbHelp& help);

/// What a model file may be followed by, for the help of commands that read models.
inline constexpr const char* kModelHelp =
    "FILE, or FILE:UNIT:AXIS as pump.stl:mm or part.obj:mm:y-up";

/// Declares --unit, --up, --spaces, --no-map and --allow-outside-files.
void add_read_options(CLI::App& app, ReadOptions& options);

/// parse_model_path of each.
std::vector<ModelPath> parse_model_paths(const std::vector<std::string>& texts);

/// {"up": "z", "unit": "m", "of": file}: the frame of all points of an answer.
nlohmann::ordered_json describe_frame(UpAxis up, const std::string& of);

/// [{kind, id, name, type, text}]
nlohmann::ordered_json to_json(const std::vector<SceneNote>& notes);
/// A line for each kind, with how many and the first few ids; empty for none. Each begins with `indent`.
std::string in_words(const std::vector<SceneNote>& notes, const std::string& indent);

/// Declares --fail-on, which takes one word, the problem; empty where it is not given.
void add_fail_on(CLI::App& app, std::string& fail_on, const std::string& problem);

/// The whole text as one finite number.
std::optional<double> parse_number(std::string_view text);

/// A length in metres: a finite number with mm, cm, m, in or ft behind it, or with nothing: metres.
std::optional<double> parse_length(std::string_view text);

/// A comma-separated list of as many finite numbers as `form` names ("x,y,z"). The first `lengths`
/// of them may have a unit, as parse_length takes it.
///
/// Errors      Error{bad_argument}, its line beginning with `what` (an option, a place in a file).
std::vector<double> parse_numbers(const std::string& what, std::string_view text,
                                  const std::string& form, std::size_t lengths = 0);
/// "x,y,z", each a length. Errors as parse_numbers.
Vec3 parse_point(const std::string& what, std::string_view text);
/// "x,y,z", numbers. Errors as parse_numbers.
Vec3 parse_direction(const std::string& what, std::string_view text);

/// Checks for options: text; a finite number of at least 0; one above 0; a whole number in a range.
CLI::Validator not_empty(const std::string& type_name);
CLI::Validator not_negative();
CLI::Validator positive();
CLI::Validator whole_number(std::uint64_t lowest, std::uint64_t highest);

/// A length of at least 0, as parse_length takes it.
CLI::Validator length();

/// Declares an option that is a length: "50mm". What the value is before is the default.
template <typename Value>
CLI::Option* add_length(CLI::App& app, const std::string& option, Value& value,
                        const std::string& description) {
    const auto set = [&value](const std::string& text) { value = parse_length(text).value(); };
    return app.add_option_function<std::string>(option, set, description)->check(length());
}

/// "512M": bytes, with K, M or G for powers of 1024.
///
/// Errors      Error{bad_argument}, naming the option.
std::uint64_t parse_bytes(const std::string& option, const std::string& text);

/// Value of a set of words (comma-separated) of which each must be known.
///
/// Errors      Error{bad_argument} naming the option.
std::vector<std::string> parse_words(const std::string& option, const std::string& text,
                                     const std::vector<std::string>& known);

/// Wall clock of a stage.
class Stopwatch {
public:
    [[nodiscard]] double seconds() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }

private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// 1234567 as "1,234,567".
std::string grouped(std::uint64_t value);

/// [x, y, z]
nlohmann::ordered_json to_json(const Vec3& v);

const char* to_string(Feature feature);
const char* to_string(Status status);

/// One line of JSON text; bytes that are no UTF-8 (in file names) are replaced.
std::string dump(const nlohmann::ordered_json& value);

} // namespace abut::command
