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

/// What the rules say of a pair of parts.
struct PairTerms {
    double clearance, touch;
    const ClashRule* rule; ///< null: there are no rules
};

/// What rules may ask of a part.
struct RuleSubject {
    std::uint32_t model = 0; ///< parts of one model have one number
    std::string_view file;   ///< the model's
    std::string_view id, name, type;
};

/// What the rules ask of many parts, in place of their names: a few bytes each, since most parts have
/// the answers of others. Without rules, nothing.
class RuleTable {
public:
    /// In          options: must outlive the table.
    explicit RuleTable(const ClashOptions& options);
    RuleTable(const RuleTable&) = delete;
    RuleTable& operator=(const RuleTable&) = delete;

    /// The next part; parts are counted from 0.
    void add(const RuleSubject& part);

    /// The first rule that selects two parts, in either order, gives their terms; none if it ignores
    /// the pair or no rule selects it. Without rules, every pair has the options' terms.
    ///
    /// Selectors match a file by its path or by its name alone, a name by `name` or `id`.
    [[nodiscard]] std::optional<PairTerms> terms(std::size_t i, std::size_t k) const;

private:
    /// What many parts have in common.
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
    std::vector<std::size_t> lengths_; ///< of prefixes that rules compare, each once
    bool asks_types_ = false;
    std::map<std::string, std::uint32_t, std::less<>> types_;
    std::map<Kind, std::uint32_t> numbers_;
    std::vector<const Kind*> kinds_; ///< by number, of numbers_
    std::vector<std::uint32_t> parts_;
    std::vector<Hash128> prefixes_; ///< of each part, of each length; zero if its name is shorter
};

} // namespace abut
