#include "store/exclusive_store.h"

#include <abut/error.h>

#include "store/schema.h"

#include <cerrno>
#include <fcntl.h>
#include <sqlite3.h>
#include <sys/stat.h>
#include <unistd.h>

namespace abut {

namespace {

/// How often a store may be removed by another process while this one waits for its lock.
constexpr int kAttempts = 100;

/// True if the file was not there. Errors of the file system are left to SQLite, which names them.
bool create_empty_file(const std::string& path) {
    const int file = ::open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0644);
    if (file < 0)
        return false;
    // No connection of this process has the file open, whose locks this would release.
    close(file);
    return true;
}

/// True if the path of a connection names no file any more, or another file than the connection has.
bool has_moved(Database& database) {
    int moved = 0;
    if (sqlite3_file_control(database.handle(), "main", SQLITE_FCNTL_HAS_MOVED, &moved) !=
        SQLITE_OK)
        return false;
    return moved != 0;
}

} // namespace

ExclusiveStore::ExclusiveStore(const std::string& path, std::uint64_t cache, IfMissing if_missing) {
    for (int attempt = 0; attempt < kAttempts; ++attempt)
        if (open(path, cache, if_missing))
            return;
    throw Error(ErrorCode::unreadable, path, "is in use by another process");
}

bool ExclusiveStore::open(const std::string& path, std::uint64_t cache, IfMissing if_missing) {
    const bool made_file = if_missing == IfMissing::create && create_empty_file(path);
    database_ = std::make_unique<Database>(
        path, if_missing == IfMissing::create ? OpenMode::create : OpenMode::read_write);
    database_->run(("PRAGMA cache_size = -" + std::to_string(cache >> 10)).c_str());
    // Blocks are large and pages chained: large pages are read in fewer steps. A file that has pages keeps
    // their size.
    database_->run("PRAGMA page_size = 8192; PRAGMA synchronous = FULL");
    // The lock comes before the locking mode: in exclusive mode a process that waits would keep its
    // shared lock, and two processes that wait for each other would both fail.
    database_->run("BEGIN EXCLUSIVE");
    if (has_moved(*database_)) {
        database_.reset();
        return false;
    }
    database_->run("PRAGMA locking_mode = EXCLUSIVE");
    created_tables_ = if_missing == IfMissing::create &&
                      database_->number("SELECT count(*) FROM sqlite_schema") == 0 &&
                      database_->number("PRAGMA application_id") == 0;
    created_file_ = made_file && created_tables_;
    try {
        if (created_tables_)
            create_schema(*database_);
        check_schema(*database_);
        database_->run("COMMIT");
    } catch (const Error&) {
        undo_creation();
        throw;
    }
    return true;
}

void ExclusiveStore::undo_creation() noexcept {
    if (!created_tables_)
        return;
    created_tables_ = false;
    try {
        if (sqlite3_get_autocommit(database_->handle()) == 0)
            database_->run("ROLLBACK");
        // SQLite lets its journal go without removing it by name later on, when another process may have
        // a journal of that name.
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
