// Statuses of clashes over random imports, jobs and marks, against a reference that applies the
// rules to maps in memory.

#include <abut/clash_review.h>
#include <abut/error.h>
#include <abut/store_clash.h>

#include "massive/work/stored_parts.h"
#include "tests/support/clash/clash_scenes.h"
#include "tests/support/random.h"
#include "tests/support/rounds.h"
#include "tests/support/store/changing_site.h"

#include <gtest/gtest.h>
#include <map>
#include <set>
#include <tuple>

namespace abut::test {
namespace {

struct Mark {
    ClashStatus mark = ClashStatus::reviewed;
    std::string note;
    std::set<const void*> lapsed; ///< questions in which the clash was gone and came back
};
using Marks = std::map<std::uint64_t, Mark>;

/// The reference: the rules of statuses, for one question.
class Rules {
public:
    explicit Rules(Marks& marks) : marks_(marks) {}

    void end_job(const ClashReport& report) {
        std::set<std::uint64_t> now;
        for (const Clash& clash : report.clashes)
            now.insert(clash.id);
        fresh_.clear();
        for (const std::uint64_t id : now)
            if (!there_.contains(id)) {
                fresh_.insert(id);
                if (resolved_.erase(id) > 0)
                    if (const auto mark = marks_.find(id); mark != marks_.end())
                        mark->second.lapsed.insert(this);
            }
        for (const std::uint64_t id : there_)
            if (!now.contains(id))
                resolved_.insert(id);
        there_ = now;
    }

    [[nodiscard]] ClashStatus status(std::uint64_t id) const {
        if (resolved_.contains(id))
            return ClashStatus::resolved;
        const auto mark = marks_.find(id);
        if (mark != marks_.end() && !mark->second.lapsed.contains(this))
            return mark->second.mark;
        return fresh_.contains(id) ? ClashStatus::fresh : ClashStatus::active;
    }
    [[nodiscard]] std::string note(std::uint64_t id) const {
        const ClashStatus now = status(id);
        return now == ClashStatus::reviewed || now == ClashStatus::approved ? marks_.at(id).note
                                                                            : "";
    }

    std::set<std::uint64_t> there_, resolved_;

private:
    Marks& marks_;
    std::set<std::uint64_t> fresh_;
};

using Listed = std::map<std::uint64_t, std::pair<std::string, std::string>>; ///< status and note

Listed listed_by_rules(const Rules& rules) {
    Listed result;
    for (const auto* ids : {&rules.there_, &rules.resolved_})
        for (const std::uint64_t id : *ids)
            result[id] = {to_string(rules.status(id)), rules.note(id)};
    return result;
}

Listed listed_in(const ClashReport& report) {
    Listed result;
    std::array<std::uint64_t, 5> counts{};
    for (const Clash& clash : report.clashes) {
        result[clash.id] = {to_string(clash.status.value()), clash.note};
        ++counts.at(static_cast<std::size_t>(*clash.status));
    }
    for (const ListedClash& clash : report.resolved) {
        EXPECT_GT(clash.resolved, 0);
        result[clash.id] = {to_string(clash.status), clash.note};
        ++counts.at(static_cast<std::size_t>(clash.status));
    }
    EXPECT_EQ(counts, report.statuses.value());
    return result;
}

Listed listed_in(const ClashReview& review) {
    Listed result;
    for (const ListedClash& clash : review.clashes)
        result[clash.id] = {to_string(clash.status), clash.note};
    return result;
}

/// The clashes as the store's SQL view lists them. The view shows the note of a lapsed mark too, so
/// that note is dropped here.
Listed listed_in_sql(const std::string& store, std::int64_t question) {
    Database database(store, OpenMode::read_only);
    Statement rows(database, "SELECT id, status, note FROM clash_status WHERE question = ?");
    rows.bind(question);
    Listed result;
    while (rows.step()) {
        const std::string status = rows.text(1);
        const bool is_mark = status == "reviewed" || status == "approved";
        result[parse_clash_id(rows.text(0)).value()] = {status, is_mark ? rows.text(2) : ""};
    }
    return result;
}

TEST(ClashStatus, FollowsItsRules) {
    Random random(6301);
    std::map<std::string, std::size_t> seen;
    std::size_t lapsed = 0;
    for (int round = 0; round < many(6); ++round) {
        ChangingSite site(random, random.integer(1, 2), 70);
        ClashOptions wide, narrow;
        wide.clearance = 0.1;
        narrow.clearance = 0.02;
        Marks marks;
        std::array<Hash128, 2> answered;
        std::vector<Rules> rules{Rules(marks), Rules(marks)};
        for (int step = 0; step < 8; ++step) {
            const std::size_t q = step == 0 ? 0 : step == 1 ? 1 : random.chance(0.3) ? 1 : 0;
            const ClashOptions& options = q == 0 ? wide : narrow;
            if (step > 1 && random.chance(0.8))
                site.change();
            StoreClashReport found = find_clashes(open_store(site.store()), options);
            const Hash128 key = parts_key(open_store(site.store()).file().models());
            if (answered.at(q) != key)
                rules[q].end_job(found.report);
            answered.at(q) = key;
            ASSERT_EQ(listed_in(found.report), listed_by_rules(rules[q]));
            // The same question again is the same job.
            found = find_clashes(open_store(site.store()), options);
            ASSERT_EQ(listed_in(found.report), listed_by_rules(rules[q]));
            found = find_clashes(open_store(site.store()), options, {.keep = false});
            ASSERT_EQ(listed_in(found.report), listed_by_rules(rules[q]));
            for (const auto& [id, words] : listed_in(found.report))
                ++seen[words.first];

            MarkChanges changed;
            changed.note = "step " + std::to_string(step);
            std::set<std::uint64_t> all = rules[0].there_;
            all.insert(rules[1].there_.begin(), rules[1].there_.end());
            for (const std::uint64_t id : all)
                if (const double what = random.uniform(0, 1); what < 0.2) {
                    changed.reviewed.push_back(id);
                    marks[id] = {ClashStatus::reviewed, changed.note, {}};
                } else if (what < 0.4) {
                    changed.approved.push_back(id);
                    marks[id] = {ClashStatus::approved, changed.note, {}};
                } else if (what < 0.5) {
                    changed.cleared.push_back(id);
                    marks.erase(id);
                }
            mark_clashes(open_store(site.store(), {.read_only = false}), changed);
            const std::vector<ClashReview> reviews = review_clashes(open_store(site.store()));
            for (std::size_t i = 0; i < reviews.size(); ++i) {
                ASSERT_EQ(listed_in(reviews[i]), listed_by_rules(rules[i]));
                ASSERT_EQ(listed_in_sql(site.store(), static_cast<std::int64_t>(i) + 1),
                          listed_by_rules(rules[i]));
            }
            for (const auto& [id, mark] : marks)
                lapsed += mark.lapsed.size();
        }
        verify_jobs(open_store(site.store()));
        if (random.chance(0.5)) {
            std::size_t gone = rules[0].resolved_.size() + rules[1].resolved_.size();
            EXPECT_EQ(forget_resolved_clashes(open_store(site.store(), {.read_only = false})),
                      gone);
            for (Rules& rule : rules)
                rule.resolved_.clear();
            const std::vector<ClashReview> reviews = review_clashes(open_store(site.store()));
            for (std::size_t i = 0; i < reviews.size(); ++i)
                ASSERT_EQ(listed_in(reviews[i]), listed_by_rules(rules[i]));
            verify_jobs(open_store(site.store()));
        }
    }
    for (const auto& [status, count] : seen)
        std::cout << status << " " << count << ", ";
    std::cout << lapsed << " marks lapsed\n";
    EXPECT_EQ(seen.size(), 5U);
    EXPECT_GT(lapsed, 0U);
}

} // namespace
} // namespace abut::test
