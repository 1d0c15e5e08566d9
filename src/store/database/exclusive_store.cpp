#include "store/database/exclusive_store.h"

#include <abut/error.h>

#include "store/database/folder_lock.h"
#include "store/database/schema.h"

#include <chrono>
#include <fcntl.h>
#include <sqlite3.h>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>
#include <utility>

namespace abut {

namespace {

/// Attempts to get the lock, and the pause between two: about a second.
constexpr int kAttempts = 100;
constexpr std::chrono::milliseconds kPause(10);

/// Returns true if the file did not exist. File system errors are left to SQLite, which names them.
bool create_empty_file(const std::string& path) {
    const int file = ::open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0644);
    if (file < 0)
        return false;
    // close() releases all locks that this process holds on the file. None of its connections has
    // the file open here.
    close(file);
    return true;
}

/// Whether the path of a connection no longer names the file that the connection has open.
bool has_moved(Database& database) {
    int moved = 0;
    if (sqlite3_file_control(database.handle(), "main", SQLITE_FCNTL_HAS_MOVED, &moved) !=
        SQLITE_OK)
        return false;
    return moved != 0;
}

} // namespace

ExclusiveStore::ExclusiveStore(const std::string& path, std::uint64_t cache, IfMissing if_missing) {
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
        if (open(path, cache, if_missing))
            return;
        std::this_thread::sleep_for(kPause);
    }
    throw Error(ErrorCode::unreadable, path, "is in use by another process");
}

bool ExclusiveStore::open(const std::string& path, std::uint64_t cache, IfMissing if_missing) {
    const FolderLock lock(path, FolderLock::Wait::no);
    if (lock.is_taken())
        return false;
    if (if_missing == IfMissing::create && create_empty_file(path))
        made_file_ = true;
    database_ = std::make_unique<Database>(
        path, if_missing == IfMissing::create ? OpenMode::create : OpenMode::read_write);
    try {
        // A connection that waited here could outlive its file.
        database_->run("PRAGMA busy_timeout = 0");
        database_->run(("PRAGMA cache_size = -" + std::to_string(cache >> 10)).c_str());
        // Blocks are large and lie in chains of pages, so large pages need fewer reads. A file that
        // already has pages keeps their size.
        database_->run("PRAGMA page_size = 8192; PRAGMA synchronous = FULL");
        // The lock must come before the locking mode. In exclusive mode a process that fails here
        // would keep its shared lock, and two such processes would both fail.
        database_->run("BEGIN EXCLUSIVE");
    } catch (const Error&) {
        if ((sqlite3_errcode(database_->handle()) & 0xff) != SQLITE_BUSY)
            throw;
        database_.reset();
        return false;
    }
    // Whoever is no import may remove a file too.
    if (has_moved(*database_)) {
        database_.reset();
        return false;
    }
    database_->run("PRAGMA locking_mode = EXCLUSIVE");
    created_tables_ = if_missing == IfMissing::create &&
                      database_->number("SELECT count(*) FROM sqlite_schema") == 0 &&
                      database_->number("PRAGMA application_id") == 0;
    created_file_ = made_file_ && created_tables_;
    try {
        if (created_tables_)
            create_schema(*database_);
        check_schema(*database_);
        database_->run("COMMIT");
    } catch (const Error&) {
        restore();
        throw;
    }
    return true;
}

void ExclusiveStore::undo_creation() noexcept {
    if (!created_tables_)
        return;
    const FolderLock lock(database_->path(), FolderLock::Wait::yes);
    restore();
}

void ExclusiveStore::restore() noexcept {
    if (!std::exchange(created_tables_, false))
        return;
    try {
        if (sqlite3_get_autocommit(database_->handle()) == 0)
            database_->run("ROLLBACK");
        // With the journal in memory, SQLite releases its journal file now. It would otherwise
        // remove it later by name, when another process may own a journal of that name.
        database_->run("PRAGMA journal_mode = MEMORY");
        const std::string path = database_->path();
        if (!has_moved(*database_)) {
            unlink((path + "-journal").c_str());
            if (created_file_)
                unlink(path.c_str());
            else
                static_cast<void>(truncate(path.c_str(), 0));
        }
    } catch (const Error&) { // NOLINT: the caller tells the first error; the file stays
    }
    database_.reset();
}

} // namespace abut
