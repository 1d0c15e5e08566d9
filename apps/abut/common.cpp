#include "common.h"

#include <abut/error.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>
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

CLI::App* add_subcommand(CLI::App& root, CommonOptions& common, const std::string& name,
                         const std::string& description) {
    CLI::App* app = root.add_subcommand(name, description);
    app->add_flag("--json", common.json, "Print one JSON object on standard output");
    app->add_option("--threads", common.threads, "Threads to use (default 0: all)")
        ->check(whole_number(0, kMostThreads));
    app->add_flag("--quiet", common.quiet, "Print nothing but errors (and the JSON, if asked for)");
    app->add_flag("--progress", common.progress,
                  "Report each stage on standard error even if that is no terminal");
    return app;
}

void add_unit_option(CLI::App& app, double& unit) {
    app.add_option("--unit", unit,
                   "Metres per unit of the files (default: what the format says, else 1)")
        ->check(positive());
}

void add_fail_on(CLI::App& app, std::string& fail_on, const std::string& problem) {
    app.add_option("--fail-on", fail_on, fmt::format("Exit with status 1 on '{}'", problem))
        ->check(CLI::IsMember({problem}));
}

std::optional<double> parse_number(std::string_view text) {
    // from_chars takes no leading plus sign, which people write in front of coordinates.
    if (text.size() > 1 && text[0] == '+' && text[1] != '-')
        text.remove_prefix(1);
    double value = 0;
    const char* end = text.data() + text.size();
    const auto [rest, fault] = std::from_chars(text.data(), end, value);
    if (fault != std::errc() || rest != end || !std::isfinite(value))
        return std::nullopt;
    return value;
}

std::vector<double> parse_numbers(const std::string& what, std::string_view text,
                                  const std::string& form) {
    std::vector<double> numbers;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t comma = std::min(text.find(',', begin), text.size());
        const std::string_view word = text.substr(begin, comma - begin);
        const auto number = parse_number(word);
        if (!number)
            throw Error(ErrorCode::bad_argument,
                        fmt::format("{}: '{}' is no finite number", what, word));
        numbers.push_back(*number);
        begin = comma + 1;
    }
    const auto wanted = static_cast<std::size_t>(std::count(form.begin(), form.end(), ',')) + 1;
    if (numbers.size() != wanted)
        throw Error(ErrorCode::bad_argument, fmt::format("{}: takes {} numbers {}, not {}", what,
                                                         wanted, form, numbers.size()));
    return numbers;
}

Vec3 parse_point(const std::string& what, std::string_view text) {
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
                    option + " must be a number of bytes, as 512M, not '" + text + "'");
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

void print(std::string_view text) {
    const bool written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
    if (!written || std::fflush(stdout) != 0)
        throw Error(ErrorCode::cannot_write, "standard output",
                    std::string("cannot be written: ") + std::strerror(errno));
}

} // namespace abut::command
