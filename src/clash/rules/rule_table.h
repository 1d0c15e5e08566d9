#pragma once

#include <abut/clash.h>

#include "clash/query/part_facts.h"
#include "clash/rules/known_neighbours.h"
#include "clash/rules/known_values.h"
#include "clash/rules/pair_precision.h"
#include "core/hash.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

namespace abut {

/// How far apart two parts may be that clash.
struct PairReach {
    double clearance = 0, touch = 0; ///< metres

    /// Whether parts in these boxes may clash. A gap that is longer than the touch tolerance by the
    /// rounding of doubles alone counts as one of that length.
    [[nodiscard]] bool holds(const Box3& a, const Box3& b) const;
};

/// How a pair of parts is tested and reported.
struct PairTerms {
    double clearance = 0, touch = 0; ///< metres
    double tolerated = -1;           ///< tolerated depth in metres; negative: none
    std::uint8_t kinds = 0xff;       ///< bit k: clashes of ClashKind k are reported
    std::optional<Neighbours> neighbours{};
    const ClashRule* rule = nullptr; ///< null if there are neither rules nor a matrix
    double rounding = 0;             ///< metres; as PairPrecision::rounding
};

/// The terms of a pair, or why it is not tested.
struct PairDecision {
    std::optional<PairTerms> terms{};
    LeftOut reason = LeftOut::not_selected; ///< without terms
    PairReach reach{};                      ///< also without terms: pairs beyond it do not count
};

/// Which rules select which parts. It stores a few bytes per part instead of the part's names,
/// because most parts have the same answers as other parts. Without rules it stores nothing but
/// known neighbours.
class RuleTable {
public:
    /// In          options: must outlive the table.
    explicit RuleTable(const ClashOptions& options);
    RuleTable(const RuleTable&) = delete;
    RuleTable& operator=(const RuleTable&) = delete;

    /// Adds the next part. Parts are numbered from 0.
    void add(const PartFacts& part);
    /// Adds what is known about the coordinates of the next part. Parts are numbered as with add().
    ///
    /// In          as PairPrecision::add.
    void add_precision(std::uint32_t model, double stated, double rounding) {
        precision_.add(model, stated, rounding);
    }
    [[nodiscard]] const PairPrecision& precision() const noexcept { return precision_; }
    /// Adds the relations of a model. Their parts are those from number `first` on.
    void add(std::span<const PartRelation> relations, std::size_t first) {
        neighbours_.add(relations, first);
    }

    /// Returns the names of the properties that add() looks at.
    [[nodiscard]] std::vector<std::string> names() const;
    /// Call it before other properties take the place of those that add() has seen.
    void forget_properties() { noted_ = nullptr; }

    /// Decides about a pair. Both parts must match `only`, one of them `a` and the other one `b`.
    /// The terms are those of the first rule that selects the parts in either order, else of the
    /// matrix, else, without rules and matrix, of the options. A rule may leave the pair out.
    ///
    /// A file selector matches the path or the file name alone. A name selector matches `name` or
    /// `id`.
    [[nodiscard]] PairDecision decide(std::size_t i, std::size_t k) const;
    [[nodiscard]] std::optional<PairTerms> terms(std::size_t i, std::size_t k) const {
        return decide(i, k).terms;
    }

    /// Returns whether decide() may return no terms.
    [[nodiscard]] bool leaves_out() const { return selects_ || !options_.leave_out.empty(); }
    /// Returns a distance beyond which no two of these boxes are within a PairReach of the table.
    [[nodiscard]] double largest_reach(std::span<const Box3> boxes) const;
    /// Returns whether two boxes may be within that distance, but not within their PairReach.
    [[nodiscard]] bool reach_varies() const {
        return selects_ ||
               (touch_of_files_or_option() > 0 && touch_of_files_or_option() >= options_.clearance);
    }
    /// Checks what the conditions of the options ask for, once all parts are added. Those of rules
    /// and groups may ask for what no part has: warnings() tells their names.
    ///
    /// In          names: returns the names of all properties; called if one is missing.
    /// Errors      Error{bad_argument}, as KnownValues.
    void require_known(const std::function<std::vector<std::string>()>& names) const {
        known_.require(known_.misses_names() ? names() : std::vector<std::string>());
    }
    /// Returns a warning for each name of rules and groups that no part had a value of.
    [[nodiscard]] std::vector<std::string> warnings() const;
    /// Bytes in memory.
    [[nodiscard]] std::uint64_t bytes() const;

private:
    static constexpr std::uint32_t kNoGroup = UINT32_MAX;

    /// The answers of the rules that many parts have in common.
    struct Kind {
        std::vector<bool> is_a, is_b; ///< by rule: whether its side selects the part
        bool only = true, a = true, b = true;
        std::uint32_t group = kNoGroup;
        std::uint32_t model = 0, type = 0;
        [[nodiscard]] auto key() const {
            return std::tie(is_a, is_b, only, a, b, group, model, type);
        }
        friend bool operator<(const Kind& x, const Kind& y) { return x.key() < y.key(); }
    };
    /// A name that a query asks for.
    struct Asked {
        std::string name, where;
        bool found = false;
    };

    /// The largest touch tolerance of pairs whose rule or cell names none.
    [[nodiscard]] double touch_of_files_or_option() const {
        return options_.touch_tolerance.value_or(precision_.largest());
    }
    void ask(const PartQuery& query, const std::string& where);
    void note_names(const PartFacts& part);
    [[nodiscard]] bool ignores(const IgnoreRule& rule, std::size_t i, std::size_t k) const;
    [[nodiscard]] const Hash128* prefix(std::size_t part, std::size_t length) const;
    [[nodiscard]] const ClashMatrix::Cell* cell(std::uint32_t a, std::uint32_t b) const;
    [[nodiscard]] PairTerms terms_of(const ClashRule* rule, std::size_t i, std::size_t k) const;
    [[nodiscard]] PairDecision leave_out(LeftOut reason, const ClashRule* rule, std::size_t i,
                                         std::size_t k) const;
    [[nodiscard]] PairDecision apply(const ClashRule* rule, std::size_t i, std::size_t k) const;

    const ClashOptions& options_;
    bool selects_ = false; ///< the options have rules, a matrix or a query
    std::vector<Asked> asked_;
    std::size_t not_found_ = 0;         ///< names in asked_ that no part had yet
    const Properties* noted_ = nullptr; ///< the properties whose names were noted last
    std::vector<std::size_t> lengths_;  ///< distinct lengths of the compared prefixes
    bool asks_types_ = false;
    std::vector<std::uint32_t> cells_; ///< index + 1 by both groups, 0: none
    std::map<std::string, std::uint32_t, std::less<>> types_;
    std::map<Kind, std::uint32_t> numbers_;
    std::vector<const Kind*> kinds_; ///< keys of numbers_, by number
    std::vector<std::uint32_t> parts_;
    std::vector<Hash128> prefixes_; ///< by part and length; zero if the name is shorter
    KnownNeighbours neighbours_;
    PairPrecision precision_;
    KnownValues known_;
};

} // namespace abut
