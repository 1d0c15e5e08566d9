#pragma once

#include "store/sqlite.h"

#include <cstdint>
#include <memory>
#include <string>

namespace abut {

/// A store that this connection alone reads and writes, from the constructor to the destructor.
///
/// Several processes may create one store at once. Nothing is decided before SQLite's exclusive lock is
/// held: whether the file is still the one at its path, whether it is empty, who has made it. The first
/// to get the lock creates the tables; the others wait for a second and then find them, or throw.
class ExclusiveStore {
public:
    enum class IfMissing : std::uint8_t { create, fail };

    /// In          cache: bytes for pages.
    /// Errors      as Database: unreadable, "in use", if another process has the store for longer than a
    ///             second; as check_schema.
    ExclusiveStore(const std::string& path, std::uint64_t cache, IfMissing if_missing);

    [[nodiscard]] Database& database() noexcept { return *database_; }

    /// Closes a store that this object has created, and leaves the path as it was before: without a file,
    /// or with an empty one. A store that was there stays. The caller has finalized its statements.
    ///
    /// A process that waits for the lock sees that the file is gone, and creates another.
    void undo_creation() noexcept;

private:
    /// False if the file that was locked is no longer the one at the path.
    bool open(const std::string& path, std::uint64_t cache, IfMissing if_missing);

    std::unique_ptr<Database> database_;
    bool created_file_ = false, created_tables_ = false;
};

} // namespace abut
