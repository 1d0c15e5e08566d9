#pragma once

#include <abut/scene.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

/// Conditions on parts and on clashes, as text. docs/selecting.md is the manual.
///
///     type = IfcWall*, IfcSlab and not (storey = L2 or Pset_WallCommon.IsExternal = true)
///
/// A comparison is NAME OPERATOR VALUE. The operators:
///
///     =  !=              a glob (`*` any text, `?` any one character), or a list of globs
///     ~  !~              a glob anywhere in the value; upper and lower case are the same
///     <  <=  >  >=       numbers if both sides are, else texts by their bytes
///
/// `and` binds more tightly than `or`, `not` more tightly than both. Names and values that hold
/// spaces or operators stand in quotes; a value in quotes is text, even if it reads as a number.
namespace abut {

struct Clash;
struct ClashReport;
struct Condition;

/// The longest text of a condition, in bytes, and how deep its parentheses and `not` may nest.
inline constexpr std::size_t kLongestQuery = 65536;
inline constexpr std::size_t kDeepestQuery = 100;

/// A condition on the parts of models. Its names are `type`, `name`, `id`, `file` and those of
/// Properties.
///
/// A part may have several values of one name: a comparison holds if it holds for one of them. It
/// does not hold for a part without a value; `!=` and `!~` are the opposites of `=` and `~`, so
/// they do. `file` is the path and also the name without folders.
class PartQuery {
public:
    /// Matches every part.
    PartQuery() = default;
    /// Errors      Error{bad_argument}, which says at which character what was expected.
    static PartQuery parse(std::string_view text);

    /// Errors      none; a part that does not exist matches only a query without a condition.
    [[nodiscard]] bool matches(const Scene& scene, std::uint32_t part) const;
    /// Returns whether the query has no condition.
    [[nodiscard]] bool empty() const noexcept { return condition_ == nullptr; }
    /// The query in one canonical form, which parses to an equal query. Empty without a condition.
    [[nodiscard]] const std::string& text() const noexcept { return text_; }
    /// The names that the query asks for, ascending, each once.
    [[nodiscard]] std::vector<std::string> names() const;
    friend bool operator==(const PartQuery& a, const PartQuery& b) { return a.text_ == b.text_; }
    /// For use by the library only.
    [[nodiscard]] const Condition* condition() const noexcept { return condition_.get(); }

private:
    std::shared_ptr<const Condition> condition_;
    std::string text_;
};

/// A condition on a clash and its parts, as `abut clash --fail-on` takes it: "hard and storey = L2",
/// "severity = high or volume > 0.01".
///
/// Its names are `kind`, `status`, `severity`, `rule`, `neighbours`, `note`, the numbers `distance`,
/// `depth`, `gap` (metres) and `volume` (cubic metres), `a.NAME` and `b.NAME` for the parts, and
/// any other name for either part. The name of a kind or of a status alone is a condition too, and
/// so is `any`.
///
/// `depth` is how deep a hard, touching or contained pair reaches; `gap` is the distance of a pair
/// that does not meet. A clash of another kind has no such value.
///
/// In a report, a query can also ask for the groups that a clash is in: `group` (name) and
/// `group.id` of any of them; of the innermost one `group.size`, `group.change` and `group.hard`,
/// `group.touch`, … (how many of the kind). And for the topics of its group or of itself:
/// `topic.status`, `topic.title`, `topic.type`, `topic.priority`, `topic.stage`, `topic.assignee`,
/// `topic.due`, `topic.label`.
class ClashQuery {
public:
    /// Matches every clash.
    ClashQuery() = default;
    /// Errors      as PartQuery::parse; also a name that begins with `group.` or `topic.` and is not
    ///             listed above.
    static ClashQuery parse(std::string_view text);

    /// Decides about a clash without its report: it has no group and no topic.
    ///
    /// In          models: those that the clash refers to.
    /// Errors      Error{bad_argument} if the clash refers to a model or a part that does not exist.
    [[nodiscard]] bool matches(const Clash& clash, const std::vector<Scene>& models) const;
    /// Returns the indices of a report's clashes that match, ascending.
    ///
    /// In          models: those of the report.
    /// Errors      as matches.
    [[nodiscard]] std::vector<std::uint32_t> find(const ClashReport& report,
                                                  const std::vector<Scene>& models) const;
    /// As PartQuery::empty, text and names.
    [[nodiscard]] bool empty() const noexcept { return condition_ == nullptr; }
    [[nodiscard]] const std::string& text() const noexcept { return text_; }
    [[nodiscard]] std::vector<std::string> names() const;
    /// For use by the library only.
    [[nodiscard]] const Condition* condition() const noexcept { return condition_.get(); }
    /// Returns whether the query asks for the status of a clash.
    [[nodiscard]] bool asks_status() const;
    friend bool operator==(const ClashQuery& a, const ClashQuery& b) { return a.text_ == b.text_; }

private:
    std::shared_ptr<const Condition> condition_;
    std::string text_;
};

} // namespace abut
