#include "clash/rules/rule_table.h"

#include "clash/query/glob.h"
#include "math/vector.h"

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

bool is_match(const PartQuery& query, const PartFacts& part) {
    return query.empty() || is_true(*query.condition(), PartSubject(part));
}

bool selects(const PartSelector& selector, const PartFacts& part) {
    return any_matches(selector.file, part.file, name_of_file(part.file)) &&
           any_matches(selector.name, part.name, part.id) &&
           any_matches(selector.type, part.type, part.type) && is_match(selector.query, part);
}

std::uint8_t bits_of(const std::vector<ClashKind>& kinds) {
    std::uint8_t bits = 0;
    for (const ClashKind kind : kinds)
        bits = static_cast<std::uint8_t>(bits | 1U << static_cast<unsigned>(kind));
    return kinds.empty() ? 0xff : bits;
}

LeftOut reason_of(Neighbours neighbours) {
    return static_cast<LeftOut>(static_cast<unsigned>(LeftOut::fills) +
                                static_cast<unsigned>(neighbours));
}

/// Returns the first characters of a UTF-8 text; none if it has fewer.
std::optional<std::string_view> first_characters(std::string_view text, std::size_t count) {
    std::size_t end = 0;
    for (; count > 0 && end < text.size(); --count) {
        ++end;
        while (end < text.size() && continues_character(text[end]))
            ++end;
    }
    if (count > 0)
        return std::nullopt;
    return text.substr(0, end);
}

bool is_among(const std::vector<Neighbours>& list, Neighbours neighbours) {
    return std::ranges::find(list, neighbours) != list.end();
}

} // namespace

bool PairReach::holds(const Box3& a, const Box3& b) const {
    return overlap(a, b, clearance) || (touch > 0 && overlap(a, b, touch + double_rounding(a, b)));
}

RuleTable::RuleTable(const ClashOptions& options) : options_(options) {
    const auto note = [&](const IgnoreRule& ignore) {
        asks_types_ = asks_types_ || ignore.same_type;
        if (ignore.same_name_prefix > 0)
            lengths_.push_back(ignore.same_name_prefix);
    };
    known_.ask(options.only, "--only");
    known_.ask(options.a, "--a");
    known_.ask(options.b, "--b");
    known_.ask(options.asked_later, "--fail-on", options);
    for (const ClashRule& rule : options.rules) {
        note(rule.ignore);
        ask(rule.a.query, "rule \"" + rule.name + "\"");
        ask(rule.b.query, "rule \"" + rule.name + "\"");
    }
    const std::size_t groups = options.matrix.groups.size();
    for (const ClashMatrix::Group& group : options.matrix.groups)
        ask(group.select, "group \"" + group.name + "\"");
    cells_.resize(groups * groups);
    for (std::size_t c = 0; c < options.matrix.cells.size(); ++c) {
        const ClashMatrix::Cell& cell = options.matrix.cells[c];
        note(cell.terms.ignore);
        for (const auto at : {cell.a * groups + cell.b, cell.b * groups + cell.a})
            cells_.at(at) = static_cast<std::uint32_t>(c + 1);
    }
    selects_ = !options.rules.empty() || groups > 0 || !options.only.empty() ||
               !options.a.empty() || !options.b.empty();
    std::ranges::sort(lengths_);
    lengths_.erase(std::unique(lengths_.begin(), lengths_.end()), lengths_.end());
}

void RuleTable::ask(const PartQuery& query, const std::string& where) {
    for (const std::string& name : query.names()) {
        const bool fixed = std::ranges::find(kFixedNames, name) != kFixedNames.end();
        const bool known = std::ranges::find(asked_, name, &Asked::name) != asked_.end();
        if (!fixed && !known)
            asked_.push_back({name, where});
    }
    not_found_ = asked_.size();
}

void RuleTable::note_names(const PartFacts& part) {
    if (not_found_ == 0 || part.properties == nullptr || part.properties == noted_)
        return;
    noted_ = part.properties;
    for (Asked& asked : asked_)
        if (!asked.found && part.properties->find(asked.name)) {
            asked.found = true;
            --not_found_;
        }
}

void RuleTable::add(const PartFacts& part) {
    neighbours_.add(part);
    known_.add(part);
    if (!selects_)
        return;
    note_names(part);
    Kind kind;
    for (const ClashRule& rule : options_.rules) {
        kind.is_a.push_back(selects(rule.a, part));
        kind.is_b.push_back(selects(rule.b, part));
    }
    kind.only = is_match(options_.only, part);
    kind.a = is_match(options_.a, part);
    kind.b = is_match(options_.b, part);
    const std::vector<ClashMatrix::Group>& groups = options_.matrix.groups;
    for (std::uint32_t g = 0; g < groups.size() && kind.group == kNoGroup; ++g)
        if (is_match(groups[g].select, part))
            kind.group = g;
    kind.model = part.model;
    if (asks_types_)
        kind.type = types_.emplace(part.type, types_.size()).first->second;
    const auto [at, is_new] = numbers_.emplace(std::move(kind), kinds_.size());
    if (is_new)
        kinds_.push_back(&at->first);
    parts_.push_back(at->second);
    for (const std::size_t length : lengths_) {
        const auto first = first_characters(part.name, length);
        prefixes_.push_back(first ? hash_128(std::as_bytes(std::span(*first))) : Hash128{});
    }
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

const ClashMatrix::Cell* RuleTable::cell(std::uint32_t a, std::uint32_t b) const {
    if (a == kNoGroup || b == kNoGroup)
        return nullptr;
    const std::uint32_t index = cells_[a * options_.matrix.groups.size() + b];
    return index == 0 ? nullptr : &options_.matrix.cells[index - 1];
}

PairTerms RuleTable::terms_of(const ClashRule* rule, std::size_t i, std::size_t k) const {
    PairTerms terms{options_.clearance};
    std::optional<double> touch = options_.touch_tolerance;
    if (rule != nullptr) {
        terms.clearance = rule->clearance.value_or(terms.clearance);
        touch = rule->touch_tolerance ? rule->touch_tolerance : touch;
        terms.tolerated = rule->tolerated_depth.value_or(terms.tolerated);
        terms.kinds = bits_of(rule->kinds);
        terms.rule = rule;
    }
    terms.touch = touch ? *touch : precision_.tolerance(i, k);
    terms.rounding = precision_.rounding(i, k);
    return terms;
}

PairDecision RuleTable::leave_out(LeftOut reason, const ClashRule* rule, std::size_t i,
                                  std::size_t k) const {
    const PairTerms terms = terms_of(rule, i, k);
    return {std::nullopt, reason, {terms.clearance, terms.touch}};
}

PairDecision RuleTable::apply(const ClashRule* rule, std::size_t i, std::size_t k) const {
    if (rule != nullptr && ignores(rule->ignore, i, k))
        return leave_out(LeftOut::ignored, rule, i, k);
    const auto neighbours = neighbours_.find(i, k);
    if (neighbours && (is_among(options_.leave_out, *neighbours) ||
                       (rule != nullptr && is_among(rule->ignore.neighbours, *neighbours))))
        return leave_out(reason_of(*neighbours), rule, i, k);
    PairTerms terms = terms_of(rule, i, k);
    terms.neighbours = neighbours;
    return {terms, LeftOut::not_selected, {terms.clearance, terms.touch}};
}

PairDecision RuleTable::decide(std::size_t i, std::size_t k) const {
    if (!selects_)
        return apply(nullptr, i, k);
    const Kind &a = *kinds_[parts_[i]], &b = *kinds_[parts_[k]];
    if (!a.only || !b.only || !((a.a && b.b) || (b.a && a.b)))
        return leave_out(LeftOut::not_selected, nullptr, i, k);
    for (std::size_t r = 0; r < options_.rules.size(); ++r)
        if ((a.is_a[r] && b.is_b[r]) || (b.is_a[r] && a.is_b[r]))
            return apply(&options_.rules[r], i, k);
    if (const ClashMatrix::Cell* const found = cell(a.group, b.group)) {
        if (!found->examined)
            return leave_out(LeftOut::off, &found->terms, i, k);
        return apply(&found->terms, i, k);
    }
    if (options_.rules.empty() && options_.matrix.groups.empty())
        return apply(nullptr, i, k);
    return leave_out(LeftOut::not_selected, nullptr, i, k);
}

double RuleTable::largest_reach(std::span<const Box3> boxes) const {
    PairReach largest{options_.clearance, touch_of_files_or_option()};
    const auto widen = [&](const ClashRule& rule) {
        largest.clearance = std::max(largest.clearance, rule.clearance.value_or(0));
        largest.touch = std::max(largest.touch, rule.touch_tolerance.value_or(0));
    };
    std::ranges::for_each(options_.rules, widen);
    for (const ClashMatrix::Cell& cell : options_.matrix.cells)
        if (cell.examined)
            widen(cell.terms);
    if (largest.touch == 0)
        return largest.clearance;
    Box3 all;
    for (const Box3& box : boxes)
        all.lower = min(all.lower, box.lower), all.upper = max(all.upper, box.upper);
    return std::max(largest.clearance, largest.touch + double_rounding(all, all));
}

std::vector<std::string> RuleTable::names() const {
    std::vector<std::string> result{"assembly"};
    for (const Asked& asked : asked_)
        result.push_back(asked.name);
    for (std::string& name : known_.names())
        if (std::ranges::find(kFixedNames, name) == kFixedNames.end() &&
            std::ranges::find(result, name) == result.end())
            result.push_back(std::move(name));
    return result;
}

std::vector<std::string> RuleTable::warnings() const {
    std::vector<std::string> result;
    for (const Asked& asked : asked_)
        if (!asked.found)
            result.push_back("no part has the property \"" + asked.name + "\", which " +
                             asked.where + " asks for");
    return result;
}

std::uint64_t RuleTable::bytes() const {
    return parts_.capacity() * sizeof(std::uint32_t) + prefixes_.capacity() * sizeof(Hash128) +
           neighbours_.bytes() + precision_.bytes();
}

} // namespace abut
