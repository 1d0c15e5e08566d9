#include "verbs/review_bcf.h"

#include <abut/clash_bcf.h>
#include <abut/clash_review.h>
#include <abut/error.h>

#include <algorithm>

namespace abut::command {

namespace {

/// The clashes of the last job, which the store remembers.
StoreClashReport last_job(const Store& store, const std::string& path, const Progress& progress) {
    const std::vector<ClashReview> reviews = review_clashes(store);
    const auto last = std::ranges::max_element(reviews, {}, &ClashReview::finished);
    if (last == reviews.end())
        throw Error(ErrorCode::bad_argument, path, "no clash job has finished");
    if (last->rules > 0)
        throw Error(ErrorCode::bad_argument, path,
                    "the last clash job had rules: use abut clash with those rules and --bcf");
    StoreClashReport found = find_clashes(store, {.clearance = last->clearance,
                                                  .touch_tolerance = last->touch_tolerance,
                                                  .self = last->self,
                                                  .rules = {},
                                                  .progress = progress});
    GroupOptions grouping;
    for (const GroupReview& review : review_groups(store))
        if (review.finished == last->finished && !review.by.empty())
            grouping.by = review.by;
    group_clashes(store, found, grouping);
    return found;
}

} // namespace

void add_review_bcf_options(CLI::App& app, ReviewBcfArguments& arguments) {
    app.add_option("--bcf-in", arguments.in,
                   "Merge the topics of a BCF file: statuses, assignees, comments, new topics")
        ->check(not_empty("FILE"));
    add_bcf_options(app, "--bcf-out", arguments.out);
}

TopicMerge merge_bcf_file(const Store& store, const std::string& path, const std::string& author,
                          std::vector<std::string>& warnings) {
    const BcfFile file = read_bcf(path);
    warnings.insert(warnings.end(), file.warnings.begin(), file.warnings.end());
    return abut::merge_bcf(store, file, {.base = {}, .author = author, .now = 0});
}

std::size_t write_review_bcf(const std::string& path, const BcfArguments& arguments,
                             const Progress& progress, std::vector<std::string>& warnings) {
    BcfOutput output(arguments);
    const Store store = open_store(path);
    const StoreClashReport found = last_job(store, path, progress);
    output.write(found, store, progress, warnings);
    return output.topics();
}

} // namespace abut::command
