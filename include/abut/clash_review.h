#pragma once

#include <abut/clash.h>
#include <abut/store.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

/// What people say of the clashes of a store, and what has become of these. docs/clash-status.md tells
/// the rules.
namespace abut {

/// The clashes of one question, as its last job that ended left them.
struct ClashReview {
    double clearance = 0, touch_tolerance = 0; ///< metres; as asked for
    bool self = false;
    std::uint64_t rules = 0;                 ///< how many
    std::int64_t finished = 0;               ///< when the job ended, in seconds since 1970
    std::array<std::uint64_t, 5> statuses{}; ///< how many of each, by ClashStatus
    std::vector<ListedClash> clashes;        ///< resolved ones too; by status, the deepest first
};

/// One for each question that the store has been asked, in the order of the first time.
///
/// Errors      those of the store; Error{malformed} if a row is damaged.
std::vector<ClashReview> review_clashes(const Store& store);

/// One JSON object; docs/clash-status.md gives the keys.
std::string to_json(const ClashReview& review);
/// One JSON object with the path of a store and its reviews, as `abut review --json` prints it.
std::string to_json(const std::vector<ClashReview>& reviews, const std::string& store);

/// Marks to set and to take away, by clash ids.
struct MarkChanges {
    std::vector<std::uint64_t> reviewed, approved; ///< to be marked so, in place of what they are
    std::vector<std::uint64_t> cleared;            ///< to be as if nobody had marked them
    std::string note;                              ///< of those that are marked
};

/// Makes all of the changes or, after an error, none. A mark is of the clash, whichever question it
/// answers; it stays until it is cleared, and holds until the clash is resolved.
///
/// In          store: opened with read_only = false.
/// Errors      Error{bad_argument}, naming the clash: no job that ended found it, it is resolved and is
///             to be marked, or it is named twice. Error{cannot_write}: the store is read-only.
void mark_clashes(const Store& store, const MarkChanges& changes);

/// Removes resolved clashes, and their marks, from the lists of all questions. Returns how many.
///
/// In          store: opened with read_only = false.
std::uint64_t forget_resolved_clashes(const Store& store);

/// Reads all that the store keeps of jobs and clashes, and checks each row against its checksum; what
/// `verify` does for models.
///
/// Errors      Error{malformed}, naming the file and the damage.
void verify_jobs(const Store& store);

} // namespace abut
