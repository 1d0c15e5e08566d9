#pragma once

#include <abut/clash.h>
#include <abut/error.h>

#include "core/hash.h"
#include "massive/work/task.h"

#include <cstddef>
#include <cstdint>
#include <exception>
#include <string>
#include <variant>
#include <vector>

namespace abut {

/// Messages of a crew in the clash job of a store. The leader sends a Briefing, then tasks
/// (Task). A helper sends results, or a Failure as its last message.

/// The data that a helper needs before its first task.
struct Briefing {
    std::uint64_t budget = 0;        ///< bytes of models in memory
    std::uint64_t blocks_budget = 0; ///< bytes of mesh blocks in memory
    Hash128 models;                  ///< parts_key of the leader's store
};

/// An exception as it is sent to another process.
struct Failure {
    bool is_error = false; ///< an Error; else another exception, of which only the text is kept
    ErrorCode code{};
    std::string file, text; ///< text: the message without the file's name
    /// Returns the message for the exception that is being handled.
    static Failure of(const std::exception& exception);
    [[noreturn]] void rethrow() const;
};

/// Sent instead of a task when all have been handed out.
struct NoMoreWork {};

using CrewMessage = std::variant<Briefing, Task, NoMoreWork, TaskResult, Failure>;

std::vector<std::byte> encode(const CrewMessage& message);
/// Errors      std::length_error for bytes that are too short or of an unknown kind. Only encode()
///             of the same build writes valid bytes.
CrewMessage decode(const std::vector<std::byte>& bytes);

} // namespace abut
