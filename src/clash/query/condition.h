#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// Conditions as trees: parsing, printing, evaluation. include/abut/part_query.h has the grammar.
namespace abut {

/// One side of a comparison.
struct ConditionValue {
    std::string text;
    bool quoted = false;          ///< text only, even if it reads as a number
    std::optional<double> number; ///< if it reads as one and is not quoted
};

struct Condition {
    enum class Kind : std::uint8_t { comparison, word, all, any, negation };
    enum class Operator : std::uint8_t {
        equal,
        differs,
        holds,
        lacks,
        less,
        at_most,
        greater,
        at_least
    };
    Kind kind = Kind::comparison;
    Operator op = Operator::equal;
    std::string name;                   ///< of a comparison, or the word
    std::vector<ConditionValue> values; ///< of a comparison; at least one
    std::vector<Condition> parts;       ///< of all and any: at least two; of a negation: one
};

/// The operators and how they are written. The first four may have several values.
inline constexpr std::array<std::pair<std::string_view, Condition::Operator>, 8>
    kConditionOperators{{{"=", Condition::Operator::equal},
                         {"!=", Condition::Operator::differs},
                         {"~", Condition::Operator::holds},
                         {"!~", Condition::Operator::lacks},
                         {"<", Condition::Operator::less},
                         {"<=", Condition::Operator::at_most},
                         {">", Condition::Operator::greater},
                         {">=", Condition::Operator::at_least}}};

/// Parses a condition.
///
/// In          words: the words that are conditions of their own.
/// Errors      Error{bad_argument}, which says at which character what was expected.
Condition parse_condition(std::string_view text, const std::vector<std::string>& words = {});

/// Returns the canonical text of a condition.
std::string to_text(const Condition& condition);

/// Calls take(name) for each name that the condition compares, in the order of the text. Words are
/// not names.
void for_each_name(const Condition& condition, const std::function<void(const std::string&)>& take);
/// Returns these names, ascending, each once; none of a null condition.
std::vector<std::string> names_of(const Condition* condition);
/// As for_each_name, for the words.
void for_each_word(const Condition& condition, const std::function<void(const std::string&)>& take);

/// Returns whether one value of a thing passes one value of a comparison. `!=` and `!~` pass as `=`
/// and `~` do: the comparison then holds if none does.
bool passes(Condition::Operator op, const ConditionValue& wanted, std::string_view value);

/// The thing that a condition is about.
class ConditionSubject {
public:
    ConditionSubject() = default;
    ConditionSubject(const ConditionSubject&) = delete;
    ConditionSubject& operator=(const ConditionSubject&) = delete;
    virtual ~ConditionSubject() = default;

    /// Calls take(value) for the values of a name until it returns true; returns whether it did.
    [[nodiscard]] virtual bool
    any_value(std::string_view name, const std::function<bool(std::string_view)>& take) const = 0;
    /// Returns whether a word is true.
    [[nodiscard]] virtual bool is(std::string_view /*word*/) const { return false; }
};

bool is_true(const Condition& condition, const ConditionSubject& subject);

/// Parses a whole text as one finite number.
std::optional<double> number_of(std::string_view text);

} // namespace abut
