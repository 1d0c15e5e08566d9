#include <abut/clash_review.h>
#include <abut/error.h>
#include <abut/store.h>

#include "commands.h"
#include "text/clash_summary.h"
#include "text/group_list.h"
#include "verbs/review_bcf.h"
#include "verbs/review_topics.h"

#include <algorithm>
#include <ctime>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <iomanip>
#include <memory>
#include <optional>
#include <sstream>

namespace abut::command {

namespace {

struct ReviewArguments {
    std::string store, status, note;
    std::vector<std::string> approved, reviewed, cleared;
    bool list = false, forget = false, groups = false;
    std::string since;
    TopicArguments topics;
    ReviewBcfArguments bcf;
};

std::vector<std::uint64_t> parse_ids(const std::string& option,
                                     const std::vector<std::string>& texts) {
    std::vector<std::uint64_t> ids;
    for (const std::string& text : texts) {
        const auto id = parse_clash_id(text);
        if (!id)
            throw Error(ErrorCode::bad_argument, option,
                        "'" + text + "' is not a clash id: 16 hexadecimal digits, as in a report");
        ids.push_back(*id);
    }
    return ids;
}

std::vector<ClashStatus> parse_statuses(const std::string& text) {
    std::vector<std::string> known;
    known.reserve(kClashStatuses.size());
    for (const ClashStatus status : kClashStatuses)
        known.emplace_back(abut::to_string(status));
    const std::vector<std::string> words =
        text.empty() ? known : parse_words("--status", text, known);
    std::vector<ClashStatus> statuses;
    for (const ClashStatus status : kClashStatuses)
        if (std::find(words.begin(), words.end(), abut::to_string(status)) != words.end())
            statuses.push_back(status);
    return statuses;
}

std::string name_of(const ListedClash& clash, std::size_t side) {
    const std::string& name = clash.name.at(side);
    const std::string& type = clash.type.at(side);
    return shown((name.empty() ? clash.part.at(side) : name) +
                 (type.empty() ? "" : " (" + type + ")"));
}

/// Formats a clash in one line, or in three if the terminal is narrower than the line.
std::string row(const ListedClash& clash) {
    const std::string head = fmt::format("  {}  {:<8}  {:<9}  {:>10} m", clash_id_text(clash.id),
                                         abut::to_string(clash.status), abut::to_string(clash.kind),
                                         number(clash.distance, 4));
    const std::string a = name_of(clash, 0), b = name_of(clash, 1);
    const auto columns = static_cast<std::size_t>(columns_of(stdout));
    const bool is_narrow = columns > 0 && columns < head.size() + a.size() + b.size() + 7;
    return head + (is_narrow ? "\n      " + a + "\n      " + b : "  " + a + "  |  " + b);
}

std::string table(const ClashReview& review) {
    std::string text =
        fmt::format("clearance {}, touch {}{}{}\n ", metres(review.clearance),
                    touch_in_words(review.touch_tolerance), review.self ? ", self" : "",
                    review.rules == 0 ? "" : fmt::format(", {} rules", review.rules));
    for (const ClashStatus status : kClashStatuses)
        text += fmt::format(" {} {}{}", abut::to_string(status),
                            grouped(review.statuses.at(static_cast<std::size_t>(status))),
                            status == ClashStatus::resolved ? "\n" : ",");
    for (const ListedClash& clash : review.clashes) {
        text += row(clash);
        if (clash.resolved != 0)
            text += fmt::format("  [since {:%Y-%m-%d %H:%M} UTC]",
                                fmt::gmtime(static_cast<std::time_t>(clash.resolved)));
        text += clash.note.empty() ? "\n" : "  \"" + shown(clash.note) + "\"\n";
    }
    return text;
}

std::optional<std::int64_t> parse_since(const std::string& text) {
    if (text.empty())
        return std::nullopt;
    std::tm time{};
    std::istringstream in(text);
    in >> std::get_time(&time, text.size() > 10 ? "%Y-%m-%dT%H:%M:%SZ" : "%Y-%m-%d");
    const int day = time.tm_mday;
    const std::time_t seconds = timegm(&time); // carries a day that the month does not have
    if (in.fail() || in.peek() != std::istringstream::traits_type::eof() || time.tm_mday != day)
        throw Error(ErrorCode::bad_argument, "--since",
                    "'" + text +
                        "' is not a date: YYYY-MM-DD, or with a time, as in "
                        "2026-11-22T10:00:00Z");
    return seconds;
}

void print_list(const ReviewArguments& arguments, const std::vector<ClashStatus>& wanted,
                const CommonOptions& common) {
    const std::string& path = arguments.store;
    const std::optional<std::int64_t> since = parse_since(arguments.since);
    const Store store = open_store(path);
    std::vector<ClashReview> reviews = review_clashes(store);
    const std::vector<GroupReview> groups = review_groups(store, since);
    for (ClashReview& review : reviews)
        std::erase_if(review.clashes, [&](const ListedClash& clash) {
            return std::find(wanted.begin(), wanted.end(), clash.status) == wanted.end();
        });
    if (common.json) {
        print_json(
            abut::to_json(reviews, groups, read_topics(store), topics_revision(store), path));
        return;
    }
    std::string text;
    for (const GroupReview& review : groups)
        if (arguments.groups)
            text += (text.empty() ? "" : "\n") + group_list(review);
    for (const ClashReview& review : reviews)
        if (!arguments.groups)
            text += (text.empty() ? "" : "\n") + table(review);
    if (!common.quiet)
        print_text(text.empty() ? shown(path) + ": no clash job has finished\n" : text);
}

/// Reads and writes BCF files.
int exchange(const ReviewArguments& arguments, const CommonOptions& common) {
    std::string text;
    nlohmann::ordered_json json = nlohmann::ordered_json::object();
    if (!arguments.bcf.in.empty()) {
        const TopicMerge merge = merge_bcf_file(open_store(arguments.store, {.read_only = false}),
                                                arguments.bcf.in, arguments.topics.author);
        text += merge_text(merge);
        json = nlohmann::ordered_json::parse(abut::to_json(merge));
    }
    if (!arguments.bcf.out.out.empty()) {
        ProgressBar bar(common.progress_style());
        std::vector<std::string> warnings;
        const std::size_t topics =
            write_review_bcf(arguments.store, arguments.bcf.out, bar.progress(), warnings);
        bar.finish();
        text += fmt::format("{} topics in {}\n", topics, shown(arguments.bcf.out.out));
        for (const std::string& warning : warnings)
            text += fmt::format("warning: {}\n", shown(warning));
        json["bcf"] = arguments.bcf.out.out;
        json["topics"] = topics;
        for (const std::string& warning : warnings)
            json["warnings"].push_back(warning);
    }
    if (common.json)
        print_json(dump(json));
    else if (!common.quiet)
        print_text(text);
    return kExitDone;
}

int run(const ReviewArguments& arguments, const CommonOptions& common) {
    const std::vector<ClashStatus> wanted = parse_statuses(arguments.status);
    MarkChanges changes{parse_ids("--reviewed", arguments.reviewed),
                        parse_ids("--approve", arguments.approved),
                        parse_ids("--clear", arguments.cleared), arguments.note};
    const std::size_t marked = changes.reviewed.size() + changes.approved.size();
    (void)parse_since(arguments.since);
    const bool is_change = marked + changes.cleared.size() > 0 || arguments.forget;
    if (!arguments.note.empty() && marked == 0)
        throw Error(ErrorCode::bad_argument, "--note", "needs --approve or --reviewed");
    if (!arguments.bcf.in.empty() || !arguments.bcf.out.out.empty()) {
        if (is_change || arguments.topics.is_change())
            throw Error(ErrorCode::bad_argument, "abut review",
                        "reads and writes BCF files by themselves: --by alone goes with --bcf-in");
        return exchange(arguments, common);
    }
    if (arguments.topics.is_change()) {
        if (is_change)
            throw Error(ErrorCode::bad_argument, "abut review",
                        "changes either marks or topics, not both at once");
        const TopicMerge merge =
            change_topics(open_store(arguments.store, {.read_only = false}), arguments.topics);
        if (common.json)
            print_json(abut::to_json(merge));
        else if (!common.quiet)
            print_text(merge_text(merge));
        return kExitDone;
    }
    if (is_change) {
        const Store store = open_store(arguments.store, {.read_only = false});
        mark_clashes(store, changes);
        const std::uint64_t forgotten = arguments.forget ? forget_resolved_clashes(store) : 0;
        if (!arguments.list && arguments.status.empty()) {
            if (common.json)
                print_json(dump({{"store", arguments.store},
                                 {"marked", marked},
                                 {"cleared", changes.cleared.size()},
                                 {"forgotten", forgotten}}));
            else if (!common.quiet)
                print_text(fmt::format("{}: {} marked, {} cleared, {} forgotten\n",
                                       shown(arguments.store), grouped(marked),
                                       grouped(changes.cleared.size()), grouped(forgotten)));
            return kExitDone;
        }
    }
    print_list(arguments, wanted, common);
    return kExitDone;
}

} // namespace

Subcommand add_review(CLI::App& root, CommonOptions& common) {
    auto arguments = std::make_shared<ReviewArguments>();
    CLI::App* app =
        add_subcommand(root, common,
                       {"review",
                        kClashes,
                        "List the clashes of a store and their groups, mark and assign them",
                        {{"abut review site.abut --status new,active",
                          "lists the clashes that nobody has reviewed"},
                         {"abut review site.abut --approve 0123456789abcdef --note \"as built\"",
                          "approves a clash, by its id in a report"},
                         {"abut review site.abut --groups --since 2026-11-16",
                          "what has become of the groups since that day"},
                         {"abut review site.abut --topic 0123456789abcdef --assign Hydra --due "
                          "2026-12-01",
                          "assigns a group, by its id in a report"},
                         {"abut review site.abut --bcf-out meeting.bcf",
                          "writes the groups of the last job as a BCF file"},
                         {"abut review site.abut --bcf-in meeting.bcf",
                          "merges what others have changed in that file"}},
                        ""});
    app->add_option("STORE", arguments->store, "A store (abut import)")
        ->required()
        ->check(not_empty("STORE"));
    const auto add_ids = [&](const char* name, std::vector<std::string>& ids, const char* what) {
        app->add_option(name, ids, what)->check(not_empty("ID"));
    };
    add_ids("--approve", arguments->approved, "Approve clashes, by their ids");
    add_ids("--reviewed", arguments->reviewed, "Mark clashes as reviewed, by their ids");
    add_ids("--clear", arguments->cleared, "Remove the marks of clashes, by their ids");
    app->add_option("--note", arguments->note, "Reason and author, stored with the marks")
        ->check(not_empty("TEXT"));
    app->add_flag("--forget-resolved", arguments->forget, "Remove resolved clashes from the lists");
    app->add_flag("--list", arguments->list,
                  "List the clashes, also after changes (default if there are none)");
    app->add_option("--status", arguments->status,
                    "List only these: new, active, reviewed, approved, resolved (comma-separated)")
        ->check(not_empty("STATUSES"));
    app->add_flag("--groups", arguments->groups, "List the groups of clashes, with their topics");
    app->add_option("--since", arguments->since,
                    "Compare groups with the last job before this date (default: with the job "
                    "before the last)")
        ->check(not_empty("DATE"));
    add_topic_options(*app, arguments->topics);
    add_review_bcf_options(*app, arguments->bcf);
    return {app, [arguments, &common] { return run(*arguments, common); }};
}

} // namespace abut::command
