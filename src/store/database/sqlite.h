#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

struct sqlite3;
struct sqlite3_stmt;

namespace abut {

enum class OpenMode : std::uint8_t {
    read_only,
    /// read_only without locks: the pages that are read must not change meanwhile; others may.
    immutable,
    read_write,
    create, ///< read_write; creates the file if it does not exist
};

/// What is wrong with an empty file in place of a store.
inline constexpr const char* kEmptyStore = "is empty, or an import has just created it";

/// A text of SQLite's, made fit for one line: control characters become spaces.
std::string one_line(std::string text);

/// Returns up to `count` bytes from the beginning of a regular file; none if it cannot be read. They
/// are read by SQLite: when other code closes a file, the system releases the locks that this
/// process holds on it (POSIX, fcntl).
std::string first_bytes(const std::string& path, std::size_t count);

/// A connection to an SQLite file. One thread at a time may use it.
///
/// Errors      of all members: Error, naming the file: malformed if it is damaged, unreadable if
///             another process has locked it, cannot_write if it is read-only or the disk is full.
class Database {
public:
    Database(std::string path, OpenMode mode);
    ~Database();
    Database(const Database&) = delete;
    Database& operator=(const Database&) = delete;

    /// Runs statements whose rows, if any, are ignored.
    void run(const char* sql);
    /// The first column of the first row of a statement; 0 if there is no row.
    std::int64_t number(const char* sql);

    /// Throws the Error of an empty file if the file has no page, as one whose import was undone.
    void require_pages() const;

    [[nodiscard]] const std::string& path() const noexcept { return path_; }
    [[nodiscard]] sqlite3* handle() const noexcept { return handle_; }
    [[noreturn]] void fail(int status) const;

private:
    std::string path_;
    sqlite3* handle_ = nullptr;
};

/// A prepared statement that can be run repeatedly: bind values in order, then step through its
/// rows.
class Statement {
public:
    Statement(Database& database, std::string_view sql);
    ~Statement();
    Statement(const Statement&) = delete;
    Statement& operator=(const Statement&) = delete;

    /// Binds all parameters anew. Texts and bytes must outlive the last step.
    template <typename... Values>
    Statement& bind(const Values&... values) {
        reset();
        int at = 0;
        (bind_one(++at, values), ...);
        return *this;
    }
    /// Returns false after the last row.
    bool step();
    /// Runs the statement to its end.
    void run() {
        while (step()) {
        }
        reset();
    }
    void reset();

    [[nodiscard]] std::int64_t integer(int column) const;
    [[nodiscard]] double real(int column) const;
    [[nodiscard]] std::string text(int column) const;
    /// Valid until the next step.
    [[nodiscard]] std::span<const std::byte> bytes(int column) const;
    [[nodiscard]] bool is_null(int column) const;

private:
    void bind_one(int at, std::int64_t value);
    void bind_one(int at, std::uint64_t value) { bind_one(at, static_cast<std::int64_t>(value)); }
    void bind_one(int at, std::uint32_t value) { bind_one(at, static_cast<std::int64_t>(value)); }
    void bind_one(int at, int value) { bind_one(at, static_cast<std::int64_t>(value)); }
    void bind_one(int at, double value);
    void bind_one(int at, std::string_view value);
    void bind_one(int at, const std::string& value) { bind_one(at, std::string_view(value)); }
    void bind_one(int at, std::span<const std::byte> value);
    void bind_one(int at, const std::vector<std::byte>& value) {
        bind_one(at, std::span<const std::byte>(value));
    }
    void bind_one(int at, std::nullptr_t);
    void check(int status) const;

    Database& database_;
    sqlite3_stmt* handle_ = nullptr;
};

/// Changes within a transaction take effect together, on commit(), or not at all. A transaction
/// within another one is a part of the outer one.
class Transaction {
public:
    explicit Transaction(Database& database);
    ~Transaction();
    Transaction(const Transaction&) = delete;
    Transaction& operator=(const Transaction&) = delete;

    void commit();

private:
    Database& database_;
    bool open_; ///< this object has begun the transaction, and must end it
};

} // namespace abut
