#pragma once

#include <abut/clash.h>

#include "store/database/sqlite.h"

#include <cstdint>

/// The options of questions as store rows, in JSON. The hash of the question tells whether a row is
/// as it was written.
namespace abut {

/// Writes the options of a question, if the store does not have them yet. Options that could not be
/// read back are not written: those with texts that are not UTF-8 or with conditions of nearly the
/// greatest length. The caller holds a transaction.
void keep_terms(Database& database, std::int64_t question, const ClashOptions& options);

/// Returns the options of a question.
///
/// Errors      Error{bad_argument}, naming the store, if it does not have them. Error{malformed},
///             naming the store, if the row is damaged.
ClashOptions read_terms(Database& database, std::int64_t question);

/// Errors      Error{malformed}, naming the store, if a row is damaged.
void verify_terms(Database& database);

} // namespace abut
