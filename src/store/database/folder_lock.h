#pragma once

#include <string>

namespace abut {

/// Keeps other processes from opening, creating or removing stores in a store's folder.
///
/// SQLite finds the journal of a file by its name. A connection whose file was removed would take
/// the journal of the next file of that name for its own, write it back and delete it. So a store
/// is removed, and opened to be changed, under this lock only: then no connection outlives its
/// name.
///
/// The lock is flock()'s, of the folder. Where the file system has none, this object does nothing.
class FolderLock {
public:
    enum class Wait : bool { no, yes };

    FolderLock(const std::string& store, Wait wait);
    ~FolderLock();
    FolderLock(const FolderLock&) = delete;
    FolderLock& operator=(const FolderLock&) = delete;

    /// Whether another process holds the lock, which this object has not waited for.
    [[nodiscard]] bool is_taken() const noexcept { return is_taken_; }

private:
    int folder_;
    bool is_taken_ = false;
};

} // namespace abut
