#pragma once

#include <abut/clash.h>

#include "core/hash.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

namespace abut {

/// The clearance and touch tolerance of a pair of parts, and the rule that gives them.
struct PairTerms {
    double clearance, touch;
    const ClashRule* rule; ///< null if there are no rules
};

/// The properties of a part that rules can refer to.
struct RuleSubject {
    std::uint32_t model = 0; ///< equal for parts of one model file
    std::string_view file;   ///< of the model
    std::string_view id, name, type;
};

/// Which rules select which parts. It stores a few bytes per part instead of the part's names,
/// because most parts have the same answers as other parts. Without rules it stores nothing.
class RuleTable {
public:
    /// In          options: must outlive the table.
    explicit RuleTable(const ClashOptions& options);
    RuleTable(const RuleTable&) = delete;
    RuleTable& operator=(const RuleTable&) = delete;

    /// Adds the next part. Parts are numbered from 0.
    void add(const RuleSubject& part);

    /// Returns the terms of a pair, given by the first rule that selects its parts in either order.
    /// Returns none if that rule ignores the pair or no rule selects it. Without rules, every pair
    /// has the options' terms.
    ///
    /// A file selector matches the path or the file name alone. A name selector matches `name` or
    /// `id`.
    [[nodiscard]] std::optional<PairTerms> terms(std::size_t i, std::size_t k) const;

private:
    /// The answers of the rules that many parts have in common.
    struct Kind {
        std::vector<bool> is_a, is_b; ///< by rule: whether its side selects the part
        std::uint32_t model = 0, type = 0;
        friend bool operator<(const Kind& a, const Kind& b) {
            return std::tie(a.is_a, a.is_b, a.model, a.type) <
                   std::tie(b.is_a, b.is_b, b.model, b.type);
        }
    };

    [[nodiscard]] bool ignores(const IgnoreRule& rule, std::size_t i, std::size_t k) const;
    [[nodiscard]] const Hash128* prefix(std::size_t part, std::size_t length) const;

    const ClashOptions& options_;
    std::vector<std::size_t> lengths_; ///< distinct lengths of the prefixes that rules compare
    bool asks_types_ = false;
    std::map<std::string, std::uint32_t, std::less<>> types_;
    std::map<Kind, std::uint32_t> numbers_;
    std::vector<const Kind*> kinds_; ///< keys of numbers_, by number
    std::vector<std::uint32_t> parts_;
    std::vector<Hash128> prefixes_; ///< by part and length; zero if the name is shorter
};

/// Whether a text matches a glob. `*` matches any run of characters, `?` one character (a byte),
/// and any other character itself. Case counts.
bool glob_match(std::string_view glob, std::string_view text);

} // namespace abut
