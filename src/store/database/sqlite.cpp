#include "store/database/sqlite.h"

#include <abut/error.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <memory>
#include <sqlite3.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

namespace abut {

namespace {

struct Verdict {
    ErrorCode code;
    const char* text;
};

Verdict verdict_of(int status) {
    switch (status & 0xff) {
    case SQLITE_CORRUPT:
        return {ErrorCode::malformed, "is damaged"};
    case SQLITE_NOTADB:
        return {ErrorCode::malformed,
                "is not an Abut store (abut import makes one of models), or its "
                "first page is damaged"};
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
        return {ErrorCode::unreadable, "is in use by another process"};
    case SQLITE_FULL:
        return {ErrorCode::cannot_write, "cannot be written: the disk is full"};
    case SQLITE_READONLY:
        if (status == SQLITE_READONLY_DBMOVED)
            return {ErrorCode::unreadable, "was removed by another process"};
        return {ErrorCode::cannot_write, "cannot be written: it is read-only"};
    case SQLITE_CANTOPEN:
        return {ErrorCode::unreadable, "cannot be opened"};
    case SQLITE_PERM:
    case SQLITE_AUTH:
        return {ErrorCode::unreadable, "cannot be opened: no permission"};
    case SQLITE_NOMEM:
        return {ErrorCode::unreadable, "cannot be read: out of memory"};
    case SQLITE_TOOBIG:
        return {ErrorCode::cannot_write, "cannot be written: a text or block is too large"};
    case SQLITE_IOERR:
        if (status == SQLITE_IOERR_WRITE || status == SQLITE_IOERR_FSYNC ||
            status == SQLITE_IOERR_TRUNCATE || status == SQLITE_IOERR_DELETE)
            return {ErrorCode::cannot_write, "cannot be written"};
        if (status == SQLITE_IOERR_SHORT_READ)
            return {ErrorCode::malformed, "is truncated"};
        return {ErrorCode::unreadable, "cannot be read"};
    default:
        return {ErrorCode::malformed, "is damaged, or is not an Abut store"};
    }
}

/// A URI that opens a file as immutable, see https://www.sqlite.org/uri.html.
std::string immutable_uri(const std::string& path) {
    // With an empty authority, the first slashes of a path are not taken for one.
    std::string uri = path.starts_with('/') ? "file://" : "file:";
    for (const char c : path) {
        constexpr std::string_view kSpecial = "%?#";
        if (kSpecial.find(c) == std::string_view::npos) {
            uri += c;
        } else {
            constexpr std::string_view kDigits = "0123456789ABCDEF";
            const auto code = static_cast<unsigned char>(c);
            uri += {'%', kDigits[code / 16], kDigits[code % 16]};
        }
    }
    return uri + "?immutable=1";
}

} // namespace

std::string first_bytes(const std::string& path, std::size_t count) {
    struct stat status {};
    // Opening a named pipe would wait for a writer.
    if (stat(path.c_str(), &status) != 0 || !S_ISREG(status.st_mode))
        return {};
    count = std::min<std::size_t>(count, static_cast<std::size_t>(status.st_size));
    sqlite3_initialize();
    sqlite3_vfs& files = *sqlite3_vfs_find(nullptr);
    std::string full(static_cast<std::size_t>(files.mxPathname) + 1, '\0');
    if (files.xFullPathname(&files, path.c_str(), files.mxPathname + 1, full.data()) != SQLITE_OK)
        return {};
    const auto free_name = [](const char* name) { sqlite3_free_filename(name); };
    const std::unique_ptr<const char, decltype(free_name)> name(
        sqlite3_create_filename(full.c_str(), "", "", 0, nullptr), free_name);
    const std::unique_ptr<void, void (*)(void*)> memory(sqlite3_malloc(files.szOsFile),
                                                        sqlite3_free);
    if (name == nullptr || memory == nullptr)
        return {};
    auto* const file = static_cast<sqlite3_file*>(memory.get());
    std::memset(memory.get(), 0, static_cast<std::size_t>(files.szOsFile));
    const int opened =
        files.xOpen(&files, name.get(), file, SQLITE_OPEN_READONLY | SQLITE_OPEN_MAIN_DB, nullptr);
    std::string bytes(count, '\0');
    const bool is_read =
        opened == SQLITE_OK &&
        file->pMethods->xRead(file, bytes.data(), static_cast<int>(count), 0) == SQLITE_OK;
    if (file->pMethods != nullptr)
        file->pMethods->xClose(file);
    return is_read ? bytes : std::string();
}

std::string one_line(std::string text) {
    std::replace_if(
        text.begin(), text.end(), [](unsigned char c) { return c < ' '; }, ' ');
    return text;
}

Database::Database(std::string path, OpenMode mode) : path_(std::move(path)) {
    int flags = SQLITE_OPEN_NOMUTEX | SQLITE_OPEN_EXRESCODE;
    flags |= mode == OpenMode::read_only || mode == OpenMode::immutable ? SQLITE_OPEN_READONLY
                                                                        : SQLITE_OPEN_READWRITE;
    flags |= mode == OpenMode::create ? SQLITE_OPEN_CREATE : 0;
    flags |= mode == OpenMode::immutable ? SQLITE_OPEN_URI : 0;
    const std::string name = mode == OpenMode::immutable ? immutable_uri(path_) : path_;
    const int status = sqlite3_open_v2(name.c_str(), &handle_, flags, nullptr);
    if (status != SQLITE_OK) {
        sqlite3_close(handle_);
        if (mode != OpenMode::create && access(path_.c_str(), F_OK) != 0 && errno == ENOENT)
            throw Error(ErrorCode::file_not_found, path_, "no such file");
        const Verdict verdict = verdict_of(status);
        throw Error(verdict.code, path_, verdict.text);
    }
    // Waits: a job locks the store only for moments, to record its progress.
    sqlite3_busy_timeout(handle_, 1000);
}

Database::~Database() {
    sqlite3_close(handle_);
}

void Database::run(const char* sql) {
    const int status = sqlite3_exec(handle_, sql, nullptr, nullptr, nullptr);
    if (status != SQLITE_OK)
        fail(status);
}

std::int64_t Database::number(const char* sql) {
    Statement statement(*this, sql);
    return statement.step() ? statement.integer(0) : 0;
}

void Database::require_pages() const {
    // Not through number(): what fails there asks for the pages again.
    sqlite3_stmt* count = nullptr;
    sqlite3_prepare_v2(handle_, "PRAGMA page_count", -1, &count, nullptr);
    const bool is_empty = sqlite3_step(count) == SQLITE_ROW && sqlite3_column_int64(count, 0) == 0;
    sqlite3_finalize(count);
    if (is_empty)
        throw Error(ErrorCode::malformed, path_, kEmptyStore);
}

void Database::fail(int status) const {
    const Verdict verdict = verdict_of(status);
    std::string text = verdict.text;
    if (verdict.code == ErrorCode::malformed || (status & 0xff) == SQLITE_IOERR)
        text += " (" + one_line(sqlite3_errmsg(handle_)) + ")";
    // An import that is undone empties the file under its readers, who then miss the tables.
    if ((status & 0xff) == SQLITE_ERROR)
        require_pages();
    throw Error(verdict.code, path_, text);
}

Statement::Statement(Database& database, std::string_view sql) : database_(database) {
    check(sqlite3_prepare_v2(database.handle(), sql.data(), static_cast<int>(sql.size()), &handle_,
                             nullptr));
}

Statement::~Statement() {
    sqlite3_finalize(handle_);
}

void Statement::check(int status) const {
    if (status != SQLITE_OK && status != SQLITE_ROW && status != SQLITE_DONE)
        database_.fail(status);
}

bool Statement::step() {
    const int status = sqlite3_step(handle_);
    if (status != SQLITE_ROW && status != SQLITE_DONE) {
        sqlite3_reset(handle_);
        check(status);
    }
    return status == SQLITE_ROW;
}

void Statement::reset() {
    sqlite3_reset(handle_);
}

std::int64_t Statement::integer(int column) const {
    return sqlite3_column_int64(handle_, column);
}

double Statement::real(int column) const {
    return sqlite3_column_double(handle_, column);
}

std::string Statement::text(int column) const {
    const auto* text = reinterpret_cast<const char*>(sqlite3_column_text(handle_, column));
    return text == nullptr
               ? std::string()
               : std::string(text, static_cast<std::size_t>(sqlite3_column_bytes(handle_, column)));
}

std::span<const std::byte> Statement::bytes(int column) const {
    const auto* data = static_cast<const std::byte*>(sqlite3_column_blob(handle_, column));
    return {data,
            data == nullptr ? 0 : static_cast<std::size_t>(sqlite3_column_bytes(handle_, column))};
}

bool Statement::is_null(int column) const {
    return sqlite3_column_type(handle_, column) == SQLITE_NULL;
}

void Statement::bind_one(int at, std::int64_t value) {
    check(sqlite3_bind_int64(handle_, at, value));
}

void Statement::bind_one(int at, double value) {
    check(sqlite3_bind_double(handle_, at, value));
}

void Statement::bind_one(int at, std::string_view value) {
    check(sqlite3_bind_text64(handle_, at, value.empty() ? "" : value.data(), value.size(),
                              SQLITE_STATIC, SQLITE_UTF8));
}

void Statement::bind_one(int at, std::span<const std::byte> value) {
    check(sqlite3_bind_blob64(handle_, at,
                              value.empty() ? "" : static_cast<const void*>(value.data()),
                              value.size(), SQLITE_STATIC));
}

void Statement::bind_one(int at, std::nullptr_t) {
    check(sqlite3_bind_null(handle_, at));
}

Transaction::Transaction(Database& database)
    : database_(database), open_(sqlite3_get_autocommit(database.handle()) != 0) {
    if (open_)
        database_.run("BEGIN IMMEDIATE");
}

void Transaction::commit() {
    if (std::exchange(open_, false)) {
        try {
            database_.run("COMMIT");
        } catch (...) {
            open_ = true; // so that the destructor rolls back
            throw;
        }
    }
}

Transaction::~Transaction() {
    if (open_)
        sqlite3_exec(database_.handle(), "ROLLBACK", nullptr, nullptr, nullptr);
}

} // namespace abut
