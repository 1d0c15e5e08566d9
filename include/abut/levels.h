#pragma once

#include <abut/progress.h>
#include <abut/store.h>

#include <cstdint>
#include <string>

namespace abut {

struct LevelOptions {
    /// Bytes of memory that the work may use; at least 64 MiB.
    std::uint64_t memory = std::uint64_t{512} << 20;
    Progress progress{};
};

struct LevelReport {
    bool built = false;                       ///< false: the levels were there and are current
    std::uint64_t chunks = 0, new_chunks = 0; ///< new_chunks: made now; others were kept
    std::uint64_t triangles = 0;              ///< of all chunks
    std::uint64_t stored_bytes = 0;
    std::uint64_t geometry_bytes = 0; ///< stored bytes of the meshes themselves
    double seconds = 0;
};

/// Builds the levels of detail of a store, if they are missing or outdated: simplified geometry of
/// large meshes, and of groups of small parts together, each with a bound of its error.
/// docs/viewer.md explains them.
///
/// Work that is interrupted or killed is continued by the next call.
///
/// Errors      Error{bad_argument} for too little memory or an import that has not finished;
///             cannot_write if the disk is full: the store is then as it was, with the chunks
///             made so far; interrupted; those of open_store.
LevelReport build_levels(const std::string& store, const LevelOptions& options = {});

/// Whether a store has levels for all its parts as they are now.
bool has_levels(const Store& store);

} // namespace abut
