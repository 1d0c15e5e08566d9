#pragma once

#include <abut/topics.h>

#include "massive/record/clash_marks.h"
#include "store/database/sqlite.h"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace abut {

/// Marks clashes as the statuses of their topics ask for. It reads the store once, when the first
/// status or title changes. The caller holds a transaction.
class TopicMarks {
public:
    explicit TopicMarks(Database& database) : database_(database) {}

    /// Marks the clashes of a topic whose status has changed: `approved` approves them; `resolved`
    /// and `closed` mark those without a mark as reviewed; another status clears the marks that the
    /// topic had set. If only the title has changed, the notes of these marks get the new one.
    /// Clashes that exist no more are left alone. Returns the number of clashes whose mark has
    /// changed.
    std::uint64_t change(const Topic& before, const Topic& after, std::int64_t now);

private:
    void read_once();
    [[nodiscard]] std::vector<std::uint64_t> clashes_of(const Topic& topic) const;

    /// Serial numbers of the last mark before a clash came back.
    struct Returned {
        std::int64_t first = 0;   ///< in the first question that has the clash
        std::int64_t largest = 0; ///< of all questions
    };

    Database& database_;
    bool is_read_ = false;
    Marks marks_;
    std::map<std::uint64_t, Returned> present_;                 ///< the clashes that exist
    std::map<std::string, std::vector<std::uint64_t>> members_; ///< clashes of each group
};

} // namespace abut
