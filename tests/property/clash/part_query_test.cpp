// Conditions on parts: random trees, printed and parsed again, against a direct evaluation.

#include <abut/error.h>
#include <abut/part_query.h>

#include "tests/support/random.h"
#include "tests/support/rounds.h"

#include <algorithm>
#include <array>
#include <gtest/gtest.h>
#include <memory>
#include <set>
#include <string>

namespace abut::test {
namespace {

/// A condition as a tree of its own, with a text in one of many forms.
struct Tree {
    std::string op; ///< of a comparison; else "and", "or", "not"
    std::string name;
    std::vector<std::string> values;
    std::vector<Tree> parts;
};

constexpr std::array<const char*, 8> kOperators{"=", "!=", "~", "!~", "<", "<=", ">", ">="};
constexpr std::array<const char*, 6> kNames{"type",   "name",     "storey",
                                            "system", "S.Height", "odd name"};
constexpr std::array<const char*, 12> kTexts{"a",  "ab", "B",   "2",   "2.0",  "10",
                                             "-3", "",   "a b", "and", "x\"y", "é"};

template <std::size_t count>
std::string pick(Random& random, const std::array<const char*, count>& words) {
    return words.at(static_cast<std::size_t>(random.integer(0, count - 1)));
}

Tree random_tree(Random& random, int depth) {
    const int choice = depth == 0 ? 9 : random.integer(0, 9);
    if (choice < 2)
        return {"not", {}, {}, {random_tree(random, depth - 1)}};
    if (choice < 6) {
        Tree tree{choice < 4 ? "and" : "or", {}, {}, {}};
        for (int i = random.integer(2, 3); i > 0; --i)
            tree.parts.push_back(random_tree(random, depth - 1));
        return tree;
    }
    Tree tree{pick(random, kOperators), pick(random, kNames), {}, {}};
    const bool list =
        tree.op.find('<') == std::string::npos && tree.op.find('>') == std::string::npos;
    do {
        std::string value = pick(random, kTexts);
        if (random.chance(0.3))
            value.insert(static_cast<std::size_t>(random.chance(0.5) ? value.size() : 0),
                         random.chance(0.5) ? "*" : "?");
        tree.values.push_back(value);
    } while (list && random.chance(0.3));
    return tree;
}

bool is_number(const std::string& text) {
    return text == "2" || text == "2.0" || text == "10" || text == "-3";
}

std::string quoted(const std::string& text) {
    std::string result = "\"";
    for (const char c : text)
        result += (c == '"' || c == '\\') ? std::string("\\") + c : std::string(1, c);
    return result + '"';
}

std::string word(Random& random, const std::string& text, bool may_quote) {
    const bool must =
        text.empty() || text == "and" || text.find_first_of(" \"") != std::string::npos;
    return must || (may_quote && random.chance(0.2)) ? quoted(text) : text;
}

std::string spaces(Random& random) {
    return random.chance(0.2) ? "\t  " : " ";
}

std::string written(Random& random, const Tree& tree) {
    if (tree.op == "not")
        return "not (" + written(random, tree.parts[0]) + ")";
    if (tree.op == "and" || tree.op == "or") {
        std::string text;
        for (const Tree& part : tree.parts) {
            const bool tight = part.op != "and" && part.op != "or" && random.chance(0.7);
            text += text.empty() ? "" : spaces(random) + tree.op + spaces(random);
            text += tight ? written(random, part) : "(" + written(random, part) + ")";
        }
        return text;
    }
    const std::string gap = random.chance(0.3) ? "" : " ";
    std::string text = word(random, tree.name, true) + gap + tree.op + gap;
    for (std::size_t i = 0; i < tree.values.size(); ++i)
        // A number in quotes would be another condition.
        text += (i > 0 ? "," + gap : "") + word(random, tree.values[i], !is_number(tree.values[i]));
    return text;
}

/// Matches by trying every split: slow and plain.
bool globbed(const std::string& glob, const std::string& text) {
    if (glob.empty())
        return text.empty();
    if (glob[0] == '*')
        return globbed(glob.substr(1), text) || (!text.empty() && globbed(glob, text.substr(1)));
    if (text.empty() || (glob[0] != '?' && glob[0] != text[0]))
        return false;
    std::size_t taken = 1; // a question mark takes a whole character of UTF-8
    while (glob[0] == '?' && taken < text.size() && (text[taken] & 0xC0) == 0x80)
        ++taken;
    return globbed(glob.substr(1), text.substr(taken));
}

std::string lower(std::string text) {
    std::ranges::transform(text, text.begin(),
                           [](char c) { return c >= 'A' && c <= 'Z' ? char(c + 32) : c; });
    return text;
}

bool compares(const std::string& op, const std::string& wanted, const std::string& value) {
    const bool numbers = is_number(wanted) && is_number(value);
    if (op == "=" || op == "!=")
        return globbed(wanted, value) || (numbers && std::stod(wanted) == std::stod(value));
    if (op == "~" || op == "!~")
        return globbed("*" + lower(wanted) + "*", lower(value));
    const int order =
        numbers ? (std::stod(value) > std::stod(wanted)) - (std::stod(value) < std::stod(wanted))
                : value.compare(wanted);
    return op == "<" ? order < 0 : op == "<=" ? order <= 0 : op == ">" ? order > 0 : order >= 0;
}

using Values = std::vector<std::pair<std::string, std::string>>; ///< name, value

bool truth(const Tree& tree, const Values& values) {
    const auto is_true = [&](const Tree& part) { return truth(part, values); };
    if (tree.op == "not")
        return !is_true(tree.parts[0]);
    if (tree.op == "and")
        return std::ranges::all_of(tree.parts, is_true);
    if (tree.op == "or")
        return std::ranges::any_of(tree.parts, is_true);
    bool found = false;
    for (const auto& [name, value] : values)
        for (const std::string& wanted : tree.values)
            found = found || (name == tree.name && compares(tree.op, wanted, value));
    return found != (tree.op == "!=" || tree.op == "!~");
}

TEST(PartQuery, AgreesWithADirectEvaluation) {
    Random random(7310);
    std::array<int, 2> seen{};
    for (int round = 0; round < many(1500); ++round) {
        Scene scene;
        scene.file = "hall/a.ifc";
        PropertiesBuilder builder;
        std::vector<Values> all;
        for (int i = 0; i < 6; ++i) {
            Part& part = scene.parts.emplace_back();
            part.id = std::to_string(i);
            part.name = pick(random, kTexts), part.type = pick(random, kTexts);
            Values values{{"name", part.name}, {"type", part.type}};
            for (std::size_t k = 2; k < kNames.size(); ++k)
                while (random.chance(0.5)) {
                    values.emplace_back(kNames.at(k), pick(random, kTexts));
                    builder.add(values.back().first, values.back().second);
                }
            builder.next_part();
            all.push_back(values);
        }
        scene.properties = builder.finish(scene.parts.size());
        const Tree tree = random_tree(random, random.integer(0, 4));
        const std::string text = written(random, tree);
        const PartQuery query = PartQuery::parse(text);
        const PartQuery again = PartQuery::parse(query.text());
        EXPECT_EQ(query, again) << text;
        EXPECT_EQ(query.names(), again.names());
        for (std::uint32_t i = 0; i < scene.parts.size(); ++i) {
            const bool expected = truth(tree, all[i]);
            ++seen.at(expected ? 1 : 0);
            EXPECT_EQ(query.matches(scene, i), expected) << text << " of part " << i;
            EXPECT_EQ(again.matches(scene, i), expected) << query.text() << " of part " << i;
        }
    }
    EXPECT_GT(seen[0], many(1500));
    EXPECT_GT(seen[1], many(1500));
}

std::string fault(const std::string& text) {
    try {
        (void)PartQuery::parse(text);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::bad_argument);
        return error.what();
    }
    return "none";
}

TEST(PartQuery, AnErrorSaysWhereAndWhatWasExpected) {
    EXPECT_EQ(fault(""), "at character 1: expected a name, 'not' or '(', found the end");
    EXPECT_EQ(fault("type IfcWall"), "at character 6: expected an operator (= != ~ !~ < <= > >=), "
                                     "found 'IfcWall'");
    EXPECT_EQ(fault("type ="), "at character 7: expected a value, found the end");
    EXPECT_EQ(fault("type = a b"), "at character 10: expected 'and', 'or' or the end, found 'b'");
    EXPECT_EQ(fault("(type = a"), "at character 10: expected 'and', 'or' or ')', found the end");
    EXPECT_EQ(fault("type = a and"),
              "at character 13: expected a name, 'not' or '(', found the end");
    EXPECT_EQ(fault("näme = \"a"), "at character 8: this quote is not closed");
    EXPECT_EQ(fault("h < 1, 2"), "at character 6: expected one value after an order, found ','");
    EXPECT_EQ(fault("h == 1"),
              "at character 3: expected an operator (= != ~ !~ < <= > >=), found '=='");
    EXPECT_EQ(fault("\"\" = 1"), "at character 1: a name cannot be empty");
    EXPECT_EQ(fault("hard"),
              "at character 5: expected an operator (= != ~ !~ < <= > >=), found the end");
}

TEST(PartQuery, LengthAndDepthAreBounded) {
    const auto nested = [](std::size_t depth) {
        return std::string(depth, '(') + "a = 1" + std::string(depth, ')');
    };
    EXPECT_EQ(fault(nested(kDeepestQuery)), "none");
    EXPECT_EQ(fault(nested(kDeepestQuery + 1)), "at character 102: nested more than 100 deep");
    std::string negations;
    for (std::size_t i = 0; i <= kDeepestQuery; ++i)
        negations += "not ";
    EXPECT_EQ(fault(negations + "a = 1"), "at character 405: nested more than 100 deep");
    EXPECT_EQ(fault("a = " + std::string(kLongestQuery - 4, 'x')), "none");
    EXPECT_EQ(fault("a = " + std::string(kLongestQuery, 'x')), "is longer than 65536 bytes");
    EXPECT_EQ(fault(std::string("a = \0b", 6)), "holds a zero byte");
}

/// Any bytes give a query or an Error.
TEST(PartQuery, RandomTextsAreRefusedOrParsed) {
    Random random(7311);
    constexpr std::array<const char*, 16> kPieces{
        "a", "not", "and", "or", "(", ")", "=", "<=", "!~", "\"", "\\", ",", " ", "*", "\xff", "7"};
    int parsed = 0;
    for (int round = 0; round < many(20000); ++round) {
        std::string text;
        for (int i = random.integer(1, 9); i > 0; --i)
            text += pick(random, kPieces) + (random.chance(0.5) ? " " : "");
        try {
            const PartQuery query = PartQuery::parse(text);
            EXPECT_EQ(PartQuery::parse(query.text()), query);
            ++parsed;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::bad_argument);
        }
    }
    EXPECT_GT(parsed, many(20000) / 1000);
}

} // namespace
} // namespace abut::test
