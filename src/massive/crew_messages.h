#pragma once

#include <abut/clash.h>
#include <abut/error.h>

#include "core/hash.h"
#include "massive/work_piece.h"

#include <cstddef>
#include <cstdint>
#include <exception>
#include <string>
#include <variant>
#include <vector>

namespace abut {

/// What the processes of a crew say to each other in the clash job of a store: the leader a briefing,
/// then pieces; a helper results, or, once and last, what went wrong.

/// What a helper must know before its first piece.
struct Briefing {
    ClashOptions options;            ///< without progress
    std::uint64_t budget = 0;        ///< bytes of models
    std::uint64_t blocks_budget = 0; ///< bytes of blocks of large meshes
    Hash128 models;                  ///< what the store holds
};

/// An exception on its way to another process.
struct Failure {
    bool is_error = false; ///< Error; else another exception of which the text is left
    ErrorCode code{};
    std::string file, text; ///< text: what follows the file's name
    /// Of the exception that is being handled.
    static Failure of(const std::exception& exception);
    [[noreturn]] void rethrow() const;
};

/// In place of a piece.
struct NoMoreWork {};

using CrewMessage = std::variant<Briefing, WorkPiece, NoMoreWork, PieceResult, Failure>;

std::vector<std::byte> encode(const CrewMessage& message);
/// Errors      std::length_error for bytes that encode() of the same build has not made.
CrewMessage decode(const std::vector<std::byte>& bytes);

} // namespace abut
