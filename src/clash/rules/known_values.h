#pragma once

#include <abut/clash.h>

#include "clash/query/condition.h"
#include "clash/query/part_facts.h"

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace abut {

/// The few texts of many that are nearest to one: by the number of characters to insert, remove or
/// replace, upper and lower case being the same.
class NearestTexts {
public:
    explicit NearestTexts(std::string text) : text_(std::move(text)) {}
    void add(std::string_view candidate);
    /// Returns "; the nearest are A, B", or an empty text if there is no candidate.
    [[nodiscard]] std::string in_words() const;

private:
    static constexpr std::size_t kMost = 3;
    std::string text_;
    std::vector<std::pair<std::size_t, std::string>> best_; ///< distance and text, ascending
};

/// Finds the names and values that conditions ask for and that nothing has: most are misspelt.
///
/// A name counts wherever it is compared. A value counts where only parts that have it are wanted:
/// after `=` and `~`, or after `!=` and `!~` within a `not`. Of several values, each one without `*`
/// and `?` counts, or, if all have one, at least one must fit.
class KnownValues {
public:
    /// In          where: what the condition was given to, such as "--only"
    void ask(const PartQuery& query, const std::string& where);
    /// Asks for the parts' names and values of a condition on clashes, and at once for those of the
    /// clashes.
    ///
    /// In          options: whose rules and cells give severities and names of rules
    /// Errors      Error{bad_argument}, as require.
    void ask(const ClashQuery& query, const std::string& where, const ClashOptions& options);

    /// Looks at the next part.
    void add(const PartFacts& part);

    /// The names that add() looks at, each once.
    [[nodiscard]] std::vector<std::string> names() const;
    /// Whether a name was not found.
    [[nodiscard]] bool misses_names() const;

    /// In          known: the names of all properties, for the text of the error. Without parts,
    ///             nothing is required.
    /// Errors      Error{bad_argument}, which names what nothing has and the nearest known texts.
    void require(const std::vector<std::string>& known) const;

private:
    struct Name {
        std::string name, where;
        bool found = false;
    };
    struct Wanted {
        std::string name, where;
        Condition::Operator op = Condition::Operator::equal;
        std::vector<ConditionValue> values; ///< alternatives
        NearestTexts nearest;
        bool found = false;
    };
    void collect(const Condition& condition, const std::string& where, bool negated,
                 const ClashOptions* clashes);
    void want(const Condition& comparison, const std::string& name, const std::string& where);

    std::vector<Name> names_;
    std::vector<Wanted> wanted_;
    std::size_t missing_ = 0; ///< of both lists
    bool has_parts_ = false;
};

} // namespace abut
