#include "massive/record/question_terms.h"

#include <abut/error.h>

#include "massive/record/job_rows.h"
#include "massive/record/job_tables.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace abut {

namespace {

using nlohmann::json;

constexpr StoreTable kTermsTable{"question_terms", R"(CREATE TABLE question_terms(
  question INTEGER PRIMARY KEY REFERENCES question,
  terms TEXT NOT NULL))"};

template <typename List>
json words_of(const List& list) {
    json words = json::array();
    for (const auto element : list)
        words.push_back(to_string(element));
    return words;
}

/// Returns the elements of `known` that the words name.
///
/// Errors      json::exception; std::out_of_range for an unknown word.
template <typename List>
auto elements_of(const json& words, const List& known) {
    std::vector<typename List::value_type> result;
    for (const json& word : words) {
        const auto text = word.get<std::string>();
        const auto found = std::ranges::find_if(
            known, [&](const auto element) { return text == to_string(element); });
        if (found == known.end())
            throw std::out_of_range(text);
        result.push_back(*found);
    }
    return result;
}

json length_json(const std::optional<double>& length) {
    return length ? json(*length) : json();
}

std::optional<double> length_from(const json& value) {
    return value.is_null() ? std::nullopt : std::optional(value.get<double>());
}

PartQuery query_from(const json& value) {
    const auto text = value.get<std::string>();
    return text.empty() ? PartQuery() : PartQuery::parse(text);
}

json selector_json(const PartSelector& side) {
    return {{"file", side.file},
            {"name", side.name},
            {"type", side.type},
            {"query", side.query.text()}};
}

PartSelector selector_from(const json& value) {
    return {value.at("file").get<std::vector<std::string>>(),
            value.at("name").get<std::vector<std::string>>(),
            value.at("type").get<std::vector<std::string>>(), query_from(value.at("query"))};
}

json rule_json(const ClashRule& rule) {
    return {{"name", rule.name},
            {"a", selector_json(rule.a)},
            {"b", selector_json(rule.b)},
            {"clearance", length_json(rule.clearance)},
            {"touch", length_json(rule.touch_tolerance)},
            {"tolerate", length_json(rule.tolerated_depth)},
            {"same_file", rule.ignore.same_file},
            {"same_type", rule.ignore.same_type},
            {"same_name_prefix", rule.ignore.same_name_prefix},
            {"neighbours", words_of(rule.ignore.neighbours)},
            {"kinds", words_of(rule.kinds)},
            {"severity", rule.severity}};
}

ClashRule rule_from(const json& value) {
    ClashRule rule;
    rule.name = value.at("name").get<std::string>();
    rule.a = selector_from(value.at("a"));
    rule.b = selector_from(value.at("b"));
    rule.clearance = length_from(value.at("clearance"));
    rule.touch_tolerance = length_from(value.at("touch"));
    rule.tolerated_depth = length_from(value.at("tolerate"));
    rule.ignore.same_file = value.at("same_file").get<bool>();
    rule.ignore.same_type = value.at("same_type").get<bool>();
    rule.ignore.same_name_prefix = value.at("same_name_prefix").get<std::size_t>();
    rule.ignore.neighbours = elements_of(value.at("neighbours"), kNeighbours);
    rule.kinds = elements_of(value.at("kinds"), kClashKinds);
    rule.severity = value.at("severity").get<std::string>();
    return rule;
}

json matrix_json(const ClashMatrix& matrix) {
    json groups = json::array(), cells = json::array();
    for (const ClashMatrix::Group& group : matrix.groups)
        groups.push_back({{"name", group.name}, {"select", group.select.text()}});
    for (const ClashMatrix::Cell& cell : matrix.cells)
        cells.push_back({{"a", cell.a},
                         {"b", cell.b},
                         {"on", cell.examined},
                         {"terms", rule_json(cell.terms)}});
    return {{"groups", groups}, {"cells", cells}};
}

ClashMatrix matrix_from(const json& value) {
    ClashMatrix matrix;
    for (const json& group : value.at("groups"))
        matrix.groups.push_back(
            {group.at("name").get<std::string>(), query_from(group.at("select"))});
    for (const json& cell : value.at("cells"))
        matrix.cells.push_back({cell.at("a").get<std::uint32_t>(),
                                cell.at("b").get<std::uint32_t>(), cell.at("on").get<bool>(),
                                rule_from(cell.at("terms"))});
    return matrix;
}

json terms_json(const ClashOptions& options) {
    json rules = json::array();
    for (const ClashRule& rule : options.rules)
        rules.push_back(rule_json(rule));
    return {{"clearance", options.clearance},
            {"touch", length_json(options.touch_tolerance)},
            {"self", options.self},
            {"rules", rules},
            {"matrix", matrix_json(options.matrix)},
            {"only", options.only.text()},
            {"a", options.a.text()},
            {"b", options.b.text()},
            {"leave_out", words_of(options.leave_out)}};
}

/// Errors      json::exception, Error, std::out_of_range.
ClashOptions terms_from(const json& value) {
    ClashOptions options;
    options.clearance = value.at("clearance").get<double>();
    options.touch_tolerance = length_from(value.at("touch"));
    options.self = value.at("self").get<bool>();
    for (const json& rule : value.at("rules"))
        options.rules.push_back(rule_from(rule));
    options.matrix = matrix_from(value.at("matrix"));
    options.only = query_from(value.at("only"));
    options.a = query_from(value.at("a"));
    options.b = query_from(value.at("b"));
    options.leave_out = elements_of(value.at("leave_out"), kNeighbours);
    return options;
}

/// Returns the options in a text; none if it is not as keep_terms writes it.
std::optional<ClashOptions> parse_terms(const std::string& text) {
    try {
        return terms_from(json::parse(text));
    } catch (const std::exception&) {
        return std::nullopt;
    }
}

QuestionRow question_row(Database& database, std::int64_t question) {
    for (const QuestionRow& row : read_questions(database))
        if (row.question == question)
            return row;
    damaged_job(database, "question " + std::to_string(question) + " is missing");
}

/// Returns the options of a question in a row of the table.
ClashOptions checked_terms(Database& database, const QuestionRow& question,
                           const std::string& text) {
    const auto options = parse_terms(text);
    if (!options || question_hash(*options) != question.hash)
        damaged_job(database, "the options of question " + std::to_string(question.question) +
                                  " do not match its hash");
    return *options;
}

} // namespace

void keep_terms(Database& database, std::int64_t question, const ClashOptions& options) {
    std::string terms;
    try {
        terms = terms_json(options).dump();
    } catch (const json::type_error&) {
        return; // a text is not UTF-8
    }
    // A condition of nearly the greatest length can be longer as it is written than as it was given.
    if (const auto parsed = parse_terms(terms);
        !parsed || question_hash(*parsed) != question_hash(options))
        return;
    if (!has_table(database, kTermsTable))
        database.run(kTermsTable.sql);
    Statement(database, "INSERT OR IGNORE INTO question_terms VALUES (?,?)")
        .bind(question, terms)
        .run();
}

ClashOptions read_terms(Database& database, std::int64_t question) {
    const QuestionRow row = question_row(database, question);
    if (has_table(database, kTermsTable)) {
        Statement find(database, "SELECT terms FROM question_terms WHERE question = ?");
        find.bind(question);
        if (find.step())
            return checked_terms(database, row, find.text(0));
    }
    ClashOptions plain;
    plain.clearance = row.clearance;
    plain.touch_tolerance = row.touch_tolerance();
    plain.self = row.self;
    if (question_hash(plain) != row.hash)
        throw Error(ErrorCode::bad_argument, database.path(),
                    "does not have the rules and conditions of its last clash job: give them to "
                    "abut clash, with --bcf");
    return plain;
}

void verify_terms(Database& database) {
    if (!has_table(database, kTermsTable))
        return;
    const std::vector<QuestionRow> questions = read_questions(database);
    Statement rows(database, "SELECT question, terms FROM question_terms ORDER BY question");
    while (rows.step()) {
        const auto row = std::ranges::find(questions, rows.integer(0), &QuestionRow::question);
        if (row == questions.end())
            damaged_job(database, "question " + std::to_string(rows.integer(0)) + " is missing");
        (void)checked_terms(database, *row, rows.text(1));
    }
}

} // namespace abut
