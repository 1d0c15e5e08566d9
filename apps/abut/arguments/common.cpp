#include "arguments/common.h"

#include <abut/error.h>

#include "arguments/choice.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <unistd.h>

namespace abut::command {

namespace {

constexpr int kMostThreads = 1024;

CLI::Validator number_check(bool (*accepts)(double), const std::string& domain) {
    return CLI::Validator(
        [accepts, domain](std::string& text) {
            const std::optional<double> value = parse_number(text);
            return value && accepts(*value) ? std::string()
                                            : fmt::format("must be {}, not '{}'", domain, text);
        },
        "NUMBER");
}

} // namespace

ProgressBar::Style CommonOptions::progress_style() const {
    if (quiet)
        return ProgressBar::Style::none;
    if (isatty(STDERR_FILENO) != 0)
        return ProgressBar::Style::bar;
    return progress ? ProgressBar::Style::lines : ProgressBar::Style::none;
}

CLI::App* add_subcommand(CLI::App& root, CommonOptions& common, const VerbHelp& help) {
    CLI::App* app = root.add_subcommand(std::make_shared<Verb>(help));
    app->formatter(root.get_formatter());
    const auto group = [](CLI::Option* option) { option->group(kCommonGroup); };
    group(app->add_flag("--json", common.json, "Print one JSON object on standard output"));
    group(app->add_option("--threads", common.threads, "Number of threads (default 0: all)")
              ->check(whole_number(0, kMostThreads)));
    group(app->add_flag("--quiet", common.quiet,
                        "Print only errors (and the JSON object of --json)"));
    group(app->add_flag("--progress", common.progress,
                        "Report each stage on standard error, even if it is not a terminal"));
    return app;
}

void add_read_options(CLI::App& app, ReadOptions& options) {
    constexpr std::array<Named<UpAxis>, 3> kAxes{
        {{"x", UpAxis::x}, {"y", UpAxis::y}, {"z", UpAxis::z}}};
    app.add_option(
           "--unit", options.unit,
           "Metres per unit for files whose format defines no unit: OBJ, OFF, PLY, STL (default 1)")
        ->check(positive());
    add_choice(app, "--up", options.up, kAxes, "Up axis for files whose format defines none");
    app.add_flag("--spaces", options.spaces, "IFC: read spaces and zones as parts, too");
    app.add_flag("!--no-map", options.map,
                 "IFC: use project coordinates, not those of the map (IfcMapConversion)");
    app.add_flag(
        "--allow-outside-files", options.allow_outside_files,
        "Allow models to refer to files outside their folders (glTF: buffers, OBJ: mtllib)");
}

std::vector<ModelPath> parse_model_paths(const std::vector<std::string>& texts) {
    std::vector<ModelPath> paths;
    paths.reserve(texts.size());
    for (const std::string& text : texts)
        paths.push_back(parse_model_path(text));
    return paths;
}

nlohmann::ordered_json describe_frame(UpAxis up, const std::string& of) {
    return {{"up", abut::to_string(up)}, {"unit", "m"}, {"of", of}};
}

nlohmann::ordered_json to_json(const std::vector<SceneNote>& notes) {
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    for (const SceneNote& note : notes)
        rows.push_back({{"kind", abut::to_string(note.kind)},
                        {"id", note.id},
                        {"name", note.name},
                        {"type", note.type},
                        {"text", note.text}});
    return rows;
}

std::string in_words(const std::vector<SceneNote>& notes, const std::string& indent) {
    constexpr std::array<std::pair<NoteKind, const char*>, 4> kWords{
        {{NoteKind::space, "spaces and zones are left out (--spaces reads them)"},
         {NoteKind::cut_away, "products have no part: their openings remove all of them"},
         {NoteKind::not_built, "products lack shapes that could not be built"},
         {NoteKind::open, "parts should be solids, but their surface is not closed"}}};
    constexpr std::size_t kMost = 3;
    std::string text;
    for (const auto& [kind, words] : kWords) {
        std::size_t count = 0;
        std::string ids;
        for (const SceneNote& note : notes)
            if (note.kind == kind && ++count <= kMost)
                ids += (ids.empty() ? "" : ", ") + shown(note.id);
        if (count > 0)
            text += fmt::format("{}{} {}: {}{}\n", indent, grouped(count), words, ids,
                                count > kMost ? ", …" : "");
    }
    return text;
}

void add_fail_on(CLI::App& app, std::string& fail_on, const std::string& problem) {
    app.add_option("--fail-on", fail_on, fmt::format("Exit with status 1 on '{}'", problem))
        ->check(CLI::IsMember({problem}));
}

std::optional<double> parse_number(std::string_view text) {
    // from_chars rejects a leading plus sign, which people write in front of coordinates.
    if (text.size() > 1 && text[0] == '+' && text[1] != '-')
        text.remove_prefix(1);
    double value = 0;
    const char* end = text.data() + text.size();
    const auto [rest, fault] = std::from_chars(text.data(), end, value);
    if (fault != std::errc() || rest != end || !std::isfinite(value))
        return std::nullopt;
    return value;
}

std::optional<double> parse_length(std::string_view text) {
    // A quotient of whole numbers is rounded only once, so that 50mm is the same double as 0.05.
    struct Unit {
        std::string_view name;
        double numerator, denominator;
    };
    constexpr std::array<Unit, 5> kUnits{
        {{"mm", 1, 1000}, {"cm", 1, 100}, {"in", 254, 10000}, {"ft", 3048, 10000}, {"m", 1, 1}}};
    const auto* const unit =
        std::ranges::find_if(kUnits, [&](const Unit& each) { return text.ends_with(each.name); });
    if (unit == kUnits.end())
        return parse_number(text);
    text.remove_suffix(unit->name.size());
    while (text.ends_with(' '))
        text.remove_suffix(1);
    const auto value = parse_number(text);
    if (!value)
        return std::nullopt;
    const double metres = *value * unit->numerator / unit->denominator;
    return std::isfinite(metres) ? std::optional(metres) : std::nullopt;
}

std::vector<double> parse_numbers(const std::string& what, std::string_view text,
                                  const std::string& form, std::size_t lengths) {
    std::vector<double> numbers;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t comma = std::min(text.find(',', begin), text.size());
        const std::string_view word = text.substr(begin, comma - begin);
        const bool is_length = numbers.size() < lengths;
        const auto number = is_length ? parse_length(word) : parse_number(word);
        if (!number)
            throw Error(ErrorCode::bad_argument,
                        fmt::format("{}: '{}' is not a finite number", what, word));
        numbers.push_back(*number);
        begin = comma + 1;
    }
    const auto wanted = static_cast<std::size_t>(std::count(form.begin(), form.end(), ',')) + 1;
    if (numbers.size() != wanted)
        throw Error(ErrorCode::bad_argument, fmt::format("{}: needs {} numbers {}, not {}", what,
                                                         wanted, form, numbers.size()));
    return numbers;
}

Vec3 parse_point(const std::string& what, std::string_view text) {
    const std::vector<double> p = parse_numbers(what, text, "x,y,z", 3);
    return {p[0], p[1], p[2]};
}

Vec3 parse_direction(const std::string& what, std::string_view text) {
    const std::vector<double> p = parse_numbers(what, text, "x,y,z");
    return {p[0], p[1], p[2]};
}

CLI::Validator not_empty(const std::string& type_name) {
    return CLI::Validator(
        [](std::string& text) { return text.empty() ? std::string("must not be empty") : ""; },
        type_name);
}

CLI::Validator not_negative() {
    return number_check([](double value) { return value >= 0; }, "a finite number of at least 0");
}

CLI::Validator positive() {
    return number_check([](double value) { return value > 0; }, "a finite number above 0");
}

CLI::Validator whole_number(std::uint64_t lowest, std::uint64_t highest) {
    return CLI::Validator(
        [=](std::string& text) {
            std::uint64_t value = 0;
            const char* end = text.data() + text.size();
            const auto [rest, fault] = std::from_chars(text.data(), end, value);
            const bool good =
                fault == std::errc() && rest == end && value >= lowest && value <= highest;
            return good ? std::string()
                        : fmt::format("must be a whole number from {} to {}, not '{}'", lowest,
                                      highest, text);
        },
        "N");
}

CLI::Validator length() {
    return CLI::Validator(
        [](std::string& text) {
            const std::optional<double> metres = parse_length(text);
            if (!metres || *metres < 0)
                return fmt::format(
                    "must be a length of at least 0, such as 0.05 (metres), 50mm, 5cm, "
                    "2in or 1ft, not '{}'",
                    text);
            return std::string();
        },
        "LENGTH");
}

std::uint64_t parse_bytes(const std::string& option, const std::string& text) {
    std::uint64_t value = 0;
    const char* const end = text.data() + text.size();
    const auto [rest, fault] = std::from_chars(text.data(), end, value);
    const std::string unit(rest, end);
    int shift = 0;
    if (unit == "K" || unit == "k")
        shift = 10;
    else if (unit == "M" || unit == "m")
        shift = 20;
    else if (unit == "G" || unit == "g")
        shift = 30;
    else if (!unit.empty())
        shift = -1;
    if (fault != std::errc() || shift < 0 || value > (~std::uint64_t{0} >> 1 >> shift))
        throw Error(ErrorCode::bad_argument,
                    option + " must be a number of bytes such as 512M, not '" + text + "'");
    return value << shift;
}

std::vector<std::string> parse_words(const std::string& option, const std::string& text,
                                     const std::vector<std::string>& known) {
    std::vector<std::string> words;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t comma = std::min(text.find(',', begin), text.size());
        words.push_back(text.substr(begin, comma - begin));
        begin = comma + 1;
    }
    for (const std::string& word : words)
        if (std::find(known.begin(), known.end(), word) == known.end()) {
            std::string message = fmt::format("{}: unknown word '{}'; known:", option, word);
            for (const std::string& each : known)
                message += " " + each;
            throw Error(ErrorCode::bad_argument, message);
        }
    return words;
}

std::string grouped(std::uint64_t value) {
    std::string digits = std::to_string(value);
    for (std::size_t from_end = 3; from_end < digits.size(); from_end += 4)
        digits.insert(digits.size() - from_end, 1, ',');
    return digits;
}

nlohmann::ordered_json to_json(const Vec3& v) {
    return {v.x, v.y, v.z};
}

const char* to_string(Feature feature) {
    return feature == Feature::vertex ? "vertex" : feature == Feature::edge ? "edge" : "face";
}

const char* to_string(Status status) {
    return status == Status::exact       ? "exact"
           : status == Status::converged ? "converged"
                                         : "bound_only";
}

std::string dump(const nlohmann::ordered_json& value) {
    return value.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

} // namespace abut::command
