#pragma once

#include "common.h"

namespace abut::command {

/// Whether `abut info` should take a file for a store: by how it begins, else by its name.
bool looks_like_store(const std::string& file);

/// `abut info STORE…`
int describe_stores(const std::vector<std::string>& files, bool verify,
                    const CommonOptions& common);

} // namespace abut::command
