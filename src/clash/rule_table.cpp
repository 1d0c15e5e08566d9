#include "clash/rule_table.h"

#include <algorithm>
#include <span>

namespace abut {

namespace {

bool any_matches(const std::vector<std::string>& globs, std::string_view text,
                 std::string_view other) {
    return globs.empty() || std::any_of(globs.begin(), globs.end(), [&](const std::string& g) {
               return glob_match(g, text) || glob_match(g, other);
           });
}

bool selects(const PartSelector& selector, const RuleSubject& part) {
    const std::string_view file = part.file.substr(part.file.find_last_of('/') + 1);
    return any_matches(selector.file, part.file, file) &&
           any_matches(selector.name, part.name, part.id) &&
           any_matches(selector.type, part.type, part.type);
}

} // namespace

RuleTable::RuleTable(const ClashOptions& options) : options_(options) {
    for (const ClashRule& rule : options.rules) {
        asks_types_ = asks_types_ || rule.ignore.same_type;
        if (rule.ignore.same_name_prefix > 0)
            lengths_.push_back(rule.ignore.same_name_prefix);
    }
    std::ranges::sort(lengths_);
    lengths_.erase(std::unique(lengths_.begin(), lengths_.end()), lengths_.end());
}

void RuleTable::add(const RuleSubject& part) {
    if (options_.rules.empty())
        return;
    Kind kind;
    for (const ClashRule& rule : options_.rules) {
        kind.is_a.push_back(selects(rule.a, part));
        kind.is_b.push_back(selects(rule.b, part));
    }
    kind.model = part.model;
    if (asks_types_)
        kind.type = types_.emplace(part.type, types_.size()).first->second;
    const auto [at, is_new] = numbers_.emplace(std::move(kind), kinds_.size());
    if (is_new)
        kinds_.push_back(&at->first);
    parts_.push_back(at->second);
    for (const std::size_t length : lengths_)
        prefixes_.push_back(part.name.size() < length
                                ? Hash128{}
                                : hash_128(std::as_bytes(std::span(part.name).first(length))));
}

const Hash128* RuleTable::prefix(std::size_t part, std::size_t length) const {
    const auto which =
        static_cast<std::size_t>(std::ranges::lower_bound(lengths_, length) - lengths_.begin());
    const Hash128& hash = prefixes_[part * lengths_.size() + which];
    return hash == Hash128{} ? nullptr : &hash;
}

bool RuleTable::ignores(const IgnoreRule& rule, std::size_t i, std::size_t k) const {
    const Kind &a = *kinds_[parts_[i]], &b = *kinds_[parts_[k]];
    if ((rule.same_file && a.model == b.model) || (rule.same_type && a.type == b.type))
        return true;
    if (rule.same_name_prefix == 0)
        return false;
    const Hash128 *of_a = prefix(i, rule.same_name_prefix),
                  *of_b = prefix(k, rule.same_name_prefix);
    return of_a != nullptr && of_b != nullptr && *of_a == *of_b;
}

std::optional<PairTerms> RuleTable::terms(std::size_t i, std::size_t k) const {
    if (options_.rules.empty())
        return PairTerms{options_.clearance, options_.touch_tolerance, nullptr};
    const Kind &a = *kinds_[parts_[i]], &b = *kinds_[parts_[k]];
    for (std::size_t r = 0; r < options_.rules.size(); ++r) {
        if (!(a.is_a[r] && b.is_b[r]) && !(b.is_a[r] && a.is_b[r]))
            continue;
        const ClashRule& rule = options_.rules[r];
        if (ignores(rule.ignore, i, k))
            return std::nullopt;
        return PairTerms{rule.clearance.value_or(options_.clearance),
                         rule.touch_tolerance.value_or(options_.touch_tolerance), &rule};
    }
    return std::nullopt;
}

bool glob_match(std::string_view glob, std::string_view text) {
    // A star first matches an empty run. On a mismatch, the last star takes one more character.
    std::size_t g = 0, t = 0, after_star = std::string_view::npos, retry = 0;
    while (t < text.size()) {
        if (g < glob.size() && glob[g] == '*') {
            after_star = ++g;
            retry = t;
        } else if (g < glob.size() && (glob[g] == '?' || glob[g] == text[t])) {
            ++g, ++t;
        } else if (after_star != std::string_view::npos) {
            g = after_star;
            t = ++retry;
        } else {
            return false;
        }
    }
    return glob.find_first_not_of('*', g) == std::string_view::npos;
}

} // namespace abut
