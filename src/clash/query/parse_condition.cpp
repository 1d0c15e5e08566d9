#include <abut/error.h>
#include <abut/part_query.h>

#include "clash/query/condition.h"
#include "clash/query/glob.h"

#include <algorithm>
#include <array>
#include <utility>

namespace abut {

namespace {

constexpr std::string_view kBlanks = " \t\n\r\v\f";
constexpr std::string_view kOperatorCharacters = "=!~<>";

struct QueryToken {
    enum class Kind : std::uint8_t { word, quoted, symbol, end };
    Kind kind = Kind::end;
    std::string text;
    std::size_t at = 0; ///< byte where it begins
};

/// Splits a text into words, quoted texts, operators, parentheses and commas.
class QueryLexer {
public:
    explicit QueryLexer(std::string_view text) : text_(text) { next(); }

    [[nodiscard]] const QueryToken& token() const { return token_; }
    void next() {
        at_ = std::min(text_.find_first_not_of(kBlanks, at_), text_.size());
        token_ = {QueryToken::Kind::end, {}, at_};
        if (at_ == text_.size())
            return;
        const char c = text_[at_];
        if (c == '"')
            return read_quoted();
        token_.kind = QueryToken::Kind::symbol;
        std::size_t end = at_ + 1;
        if (kOperatorCharacters.find(c) != std::string_view::npos) {
            end = std::min(text_.find_first_not_of(kOperatorCharacters, at_), text_.size());
        } else if (c != '(' && c != ')' && c != ',') {
            token_.kind = QueryToken::Kind::word;
            end = std::min(text_.find_first_of(" \t\n\r\v\f()=!~<>,\"", at_), text_.size());
        }
        token_.text = text_.substr(at_, end - at_);
        at_ = end;
    }

    /// Throws an error about the current token.
    [[noreturn]] void fail(const std::string& expected) const {
        const bool over = token_.kind == QueryToken::Kind::end;
        fail(token_.at, "expected " + expected + ", found " +
                            (over ? std::string("the end") : "'" + shortened(token_.text) + "'"));
    }
    [[noreturn]] void fail(std::size_t at, const std::string& fault) const {
        // Characters are counted, not bytes.
        const auto before = text_.substr(0, at);
        const auto character =
            std::ranges::count_if(before, [](char c) { return !continues_character(c); });
        throw Error(ErrorCode::bad_argument,
                    "at character " + std::to_string(character + 1) + ": " + fault);
    }

private:
    static std::string shortened(const std::string& text) {
        constexpr std::size_t kLongest = 40;
        return text.size() <= kLongest ? text : text.substr(0, kLongest) + "...";
    }
    void read_quoted() {
        token_.kind = QueryToken::Kind::quoted;
        for (++at_; at_ < text_.size() && text_[at_] != '"'; ++at_) {
            if (text_[at_] == '\\' && at_ + 1 < text_.size())
                ++at_;
            token_.text += text_[at_];
        }
        if (at_ == text_.size())
            fail(token_.at, "this quote is not closed");
        ++at_;
    }

    std::string_view text_;
    std::size_t at_ = 0;
    QueryToken token_;
};

class ConditionParser {
public:
    ConditionParser(std::string_view text, const std::vector<std::string>& words)
        : lexer_(text), words_(words) {}

    Condition parse() {
        Condition condition = parse_any(0);
        if (lexer_.token().kind != QueryToken::Kind::end)
            lexer_.fail("'and', 'or' or the end");
        return condition;
    }

private:
    [[nodiscard]] bool is_keyword(std::string_view lower, std::string_view upper) const {
        const QueryToken& token = lexer_.token();
        return token.kind == QueryToken::Kind::word && (token.text == lower || token.text == upper);
    }
    [[nodiscard]] bool is_symbol(std::string_view symbol) const {
        return lexer_.token().kind == QueryToken::Kind::symbol && lexer_.token().text == symbol;
    }

    Condition parse_any(std::size_t depth) {
        return parse_list(Condition::Kind::any, "or", "OR", [&] { return parse_all(depth); });
    }
    Condition parse_all(std::size_t depth) {
        return parse_list(Condition::Kind::all, "and", "AND", [&] { return parse_one(depth); });
    }
    template <typename Parse>
    Condition parse_list(Condition::Kind kind, std::string_view lower, std::string_view upper,
                         const Parse& parse) {
        Condition first = parse();
        if (!is_keyword(lower, upper))
            return first;
        Condition list;
        list.kind = kind;
        const auto add = [&](Condition part) {
            // "a and (b and c)" is the same list as "a and b and c".
            if (part.kind != kind)
                return list.parts.push_back(std::move(part));
            for (Condition& inner : part.parts)
                list.parts.push_back(std::move(inner));
        };
        add(std::move(first));
        while (is_keyword(lower, upper)) {
            lexer_.next();
            add(parse());
        }
        return list;
    }

    Condition parse_one(std::size_t depth) {
        if (depth > kDeepestQuery)
            lexer_.fail(lexer_.token().at,
                        "nested more than " + std::to_string(kDeepestQuery) + " deep");
        if (is_keyword("not", "NOT")) {
            lexer_.next();
            Condition negation;
            negation.kind = Condition::Kind::negation;
            negation.parts.push_back(parse_one(depth + 1));
            return negation;
        }
        if (is_symbol("(")) {
            lexer_.next();
            Condition inner = parse_any(depth + 1);
            if (!is_symbol(")"))
                lexer_.fail("'and', 'or' or ')'");
            lexer_.next();
            return inner;
        }
        return parse_comparison();
    }

    [[nodiscard]] bool is_text() const {
        const QueryToken::Kind kind = lexer_.token().kind;
        return kind == QueryToken::Kind::quoted ||
               (kind == QueryToken::Kind::word && !is_keyword("and", "AND") &&
                !is_keyword("or", "OR") && !is_keyword("not", "NOT"));
    }

    Condition parse_comparison() {
        if (!is_text())
            lexer_.fail("a name, 'not' or '('");
        const QueryToken name = lexer_.token();
        if (name.text.empty())
            lexer_.fail(name.at, "a name cannot be empty");
        lexer_.next();
        Condition condition;
        condition.name = name.text;
        const QueryToken& op = lexer_.token();
        const bool has_operator = op.kind == QueryToken::Kind::symbol &&
                                  kOperatorCharacters.find(op.text.front()) != std::string::npos;
        if (!has_operator && name.kind == QueryToken::Kind::word &&
            std::ranges::find(words_, name.text) != words_.end()) {
            condition.kind = Condition::Kind::word;
            return condition;
        }
        condition.op = parse_operator();
        const bool is_list = condition.op <= Condition::Operator::lacks;
        for (;;) {
            condition.values.push_back(parse_value());
            if (!is_symbol(","))
                return condition;
            if (!is_list)
                lexer_.fail("one value after an order");
            lexer_.next();
        }
    }

    Condition::Operator parse_operator() {
        for (const auto& [symbol, op] : kConditionOperators)
            if (is_symbol(symbol)) {
                lexer_.next();
                return op;
            }
        lexer_.fail("an operator (= != ~ !~ < <= > >=)");
    }

    ConditionValue parse_value() {
        if (!is_text())
            lexer_.fail("a value");
        ConditionValue value;
        value.text = lexer_.token().text;
        value.quoted = lexer_.token().kind == QueryToken::Kind::quoted;
        if (!value.quoted)
            value.number = number_of(value.text);
        lexer_.next();
        return value;
    }

    QueryLexer lexer_;
    const std::vector<std::string>& words_;
};

} // namespace

Condition parse_condition(std::string_view text, const std::vector<std::string>& words) {
    if (text.size() > kLongestQuery)
        throw Error(ErrorCode::bad_argument,
                    "is longer than " + std::to_string(kLongestQuery) + " bytes");
    if (text.find('\0') != std::string_view::npos)
        throw Error(ErrorCode::bad_argument, "holds a zero byte");
    return ConditionParser(text, words).parse();
}

} // namespace abut
