#pragma once

#include "arguments/common.h"

namespace abut::command {

/// Returns whether `abut info` should treat a file as a store, judged by its first bytes or else by
/// its name.
bool looks_like_store(const std::string& file);

struct StoreDetails {
    bool verify = false;
    bool parts = false;      ///< lists the parts
    bool properties = false; ///< lists the properties that parts have
};

/// Runs `abut info STORE…`. Returns the exit status.
int describe_stores(const std::vector<std::string>& files, const StoreDetails& details,
                    const CommonOptions& common);

} // namespace abut::command
