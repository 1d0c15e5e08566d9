#pragma once

#include <abut/clash.h>
#include <abut/clash_groups.h>
#include <abut/store.h>
#include <abut/topics.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

/// The review of a store's clashes: the marks that people set, and the statuses that result.
/// docs/clash-status.md explains the rules.
namespace abut {

/// The clashes of one question, as found by the last job that finished.
struct ClashReview {
    double clearance = 0;                  ///< metres; of the question, as the next one
    std::optional<double> touch_tolerance; ///< as ClashOptions::touch_tolerance
    bool self = false;
    std::uint64_t rules = 0;                 ///< number of rules
    std::int64_t finished = 0;               ///< when the job ended, in seconds since 1970
    std::array<std::uint64_t, 5> statuses{}; ///< number of clashes of each ClashStatus
    std::vector<ListedClash> clashes;        ///< with resolved ones; by status, the deepest first
};

/// Returns one review for each question, in the order in which the questions were first asked.
///
/// Errors      those of the store; Error{malformed} if a row is damaged.
std::vector<ClashReview> review_clashes(const Store& store);

/// Returns the options of the last job that finished. find_clashes with them asks its question
/// again.
///
/// Errors      Error{bad_argument}, naming the store, if no job has finished, or if the job had
///             rules, a matrix or conditions that the store did not keep: earlier versions did not,
///             and texts that are not UTF-8 are not kept. Error{malformed} if a row is damaged.
ClashOptions last_clash_options(const Store& store);

/// Returns one JSON object; docs/clash-status.md lists the keys.
std::string to_json(const ClashReview& review);
/// One JSON object with the path of a store and its reviews, as `abut review --json` prints it.
std::string to_json(const std::vector<ClashReview>& reviews, const std::string& store);

/// A group as a store lists it.
struct ListedGroup {
    std::string id;
    std::string path; ///< names of the groups around it, each followed by " / "
    std::string name, what;
    GroupKind kind = GroupKind::part;
    GroupChange change = GroupChange::fresh;
    std::uint64_t size = 0; ///< clashes that it has now
    Vec3 centre;
    /// When it appeared, was last reopened, last moved, and was resolved, in seconds since 1970; 0:
    /// never.
    std::int64_t appeared = 0, reopened = 0, moved = 0, resolved = 0;
    std::optional<Topic> topic; ///< none if nobody has said anything about it
};

/// The groups of one question by one grouping, and what has become of them.
struct GroupReview {
    double clearance = 0;                  ///< metres; of the question, as the next one
    std::optional<double> touch_tolerance; ///< as ClashOptions::touch_tolerance
    bool self = false;
    std::uint64_t rules = 0; ///< number of rules
    std::vector<GroupBy> by;
    std::int64_t since = 0; ///< end of the job that changes are counted from; 0: from the beginning
    std::int64_t finished = 0;              ///< end of the last job
    std::array<std::uint64_t, 5> changes{}; ///< number of groups of each GroupChange
    std::vector<ListedGroup> groups;        ///< by change, the largest first
    std::vector<JobCounts> history;         ///< of the question's jobs, the earliest first
};

/// Returns what has become of the groups that jobs found: since the job before the last one, or
/// since the last job that ended before a time.
///
/// In          since: seconds since 1970.
/// Errors      as review_clashes.
std::vector<GroupReview> review_groups(const Store& store,
                                       std::optional<std::int64_t> since = std::nullopt);

/// Returns one JSON object; docs/clash-groups.md lists the keys.
std::string to_json(const GroupReview& review);
/// One JSON object with the path of a store, its reviews, its groups, its topics and their
/// revision, as `abut review --json` prints it.
std::string to_json(const std::vector<ClashReview>& reviews, const std::vector<GroupReview>& groups,
                    const std::vector<Topic>& topics, std::int64_t revision,
                    const std::string& store);

/// Marks to set and to clear, by clash ids.
struct MarkChanges {
    std::vector<std::uint64_t> reviewed, approved; ///< get this mark in place of an earlier one
    std::vector<std::uint64_t> cleared;            ///< lose their mark
    std::string note;                              ///< stored with the marks that are set
};

/// Makes all of the changes or, after an error, none. A mark belongs to the clash, whichever
/// question found it. The mark stays until it is cleared, and is valid until the clash is resolved.
///
/// In          store: opened with read_only = false.
/// Errors      Error{bad_argument}, naming the clash: no finished job found it, it is to be marked
///             but is resolved, or it is named twice. Error{cannot_write}: the store is read-only.
void mark_clashes(const Store& store, const MarkChanges& changes);

/// Removes resolved clashes and their marks from the lists of all questions. Returns their number.
///
/// In          store: opened with read_only = false.
std::uint64_t forget_resolved_clashes(const Store& store);

/// Reads everything that the store keeps about jobs and clashes, and checks each row against its
/// checksum. `verify` does this for the models.
///
/// Errors      Error{malformed}, naming the file and the damage.
void verify_jobs(const Store& store);

} // namespace abut
