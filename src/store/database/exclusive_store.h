#pragma once

#include "store/database/sqlite.h"

#include <cstdint>
#include <memory>
#include <string>

namespace abut {

/// A store that only this connection reads and writes, from the constructor to the destructor.
///
/// Several processes may create one store at once. All decisions wait for SQLite's exclusive lock:
/// whether the file is still the one at its path, whether it is empty, and who has created it. The
/// first process to get the lock creates the tables. The others try again for about a second and
/// then find the tables, or throw. They keep no connection between two attempts (FolderLock).
class ExclusiveStore {
public:
    enum class IfMissing : std::uint8_t { create, fail };

    /// In          cache: bytes for pages.
    /// Errors      as Database: unreadable, "in use", if another process holds the store for longer
    ///             than a second; as check_schema.
    ExclusiveStore(const std::string& path, std::uint64_t cache, IfMissing if_missing);

    [[nodiscard]] Database& database() noexcept { return *database_; }

    /// Closes a store that this object has created, and restores what was at the path: no file, or
    /// an empty one. A store that existed before stays. The caller must have finalized its
    /// statements.
    ///
    /// A process that waits for the lock creates a new file.
    void undo_creation() noexcept;

private:
    /// Returns false if another process has the lock, or if the locked file is no longer the one at
    /// the path.
    bool open(const std::string& path, std::uint64_t cache, IfMissing if_missing);

    /// undo_creation() under a FolderLock that the caller holds.
    void restore() noexcept;

    std::unique_ptr<Database> database_;
    bool made_file_ = false; ///< in this attempt or in one before
    bool created_file_ = false, created_tables_ = false;
};

} // namespace abut
