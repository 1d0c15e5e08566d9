#include "verbs/review_bcf.h"

#include <abut/clash_bcf.h>
#include <abut/clash_review.h>
#include <abut/store_clash.h>

#include <cstdint>

namespace abut::command {

namespace {

/// The clashes of the last job that finished, grouped as the last job that was grouped.
StoreClashReport last_job(const Store& store, const Progress& progress) {
    ClashOptions options = last_clash_options(store);
    options.progress = progress;
    StoreClashReport found = find_clashes(store, options);
    GroupOptions grouping;
    std::int64_t last = 0;
    for (const GroupReview& review : review_groups(store))
        if (review.finished >= last && !review.by.empty()) {
            grouping.by = review.by;
            last = review.finished;
        }
    grouping.progress = progress;
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

TopicMerge merge_bcf_file(const Store& store, const std::string& path, const std::string& author) {
    return abut::merge_bcf(store, read_bcf(path), {.base = {}, .author = author, .now = 0});
}

std::size_t write_review_bcf(const std::string& path, const BcfArguments& arguments,
                             const Progress& progress, std::vector<std::string>& warnings) {
    BcfOutput output(arguments);
    const Store store = open_store(path);
    const StoreClashReport found = last_job(store, progress);
    output.write(found, store, progress, warnings);
    return output.topics();
}

} // namespace abut::command
