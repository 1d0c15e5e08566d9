#pragma once

#include <abut/topics.h>

#include "verbs/bcf_output.h"

namespace abut::command {

/// The options of abut review that read and write BCF files.
struct ReviewBcfArguments {
    std::string in;
    BcfArguments out;
};

void add_review_bcf_options(CLI::App& app, ReviewBcfArguments& arguments);

/// Merges the topics of a BCF file into a store.
///
/// In          author: who makes the changes; empty: those who made them in the file.
/// Errors      as read_bcf and merge_bcf.
TopicMerge merge_bcf_file(const Store& store, const std::string& path, const std::string& author);

/// Writes the groups of a store's last job as topics. Returns their number.
///
/// Errors      as last_clash_options.
std::size_t write_review_bcf(const std::string& store, const BcfArguments& arguments,
                             const Progress& progress, std::vector<std::string>& warnings);

} // namespace abut::command
