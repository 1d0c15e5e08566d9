#pragma once

#include "massive/piece_tester.h"
#include "massive/work_piece.h"

#include <optional>

namespace abut {

/// Where a worker gets its pieces from, and where it leaves what it found.
class WorkSource {
public:
    virtual ~WorkSource() = default;
    /// The next piece; none if there is no more work. Waits until that is known.
    virtual std::optional<WorkPiece> next() = 0;
    virtual void done(PieceResult result) = 0;
    /// After each pair, from any thread. What it throws ends the work.
    virtual void on_pair() = 0;
    /// The work has failed: `next`, which another thread may be in, waits no longer.
    virtual void give_up() {}
};

/// Does pieces until there are none: while one is tested, what the next one needs comes into memory.
/// `done` is called while nothing is being read; `next` and `done` never at once.
///
/// Errors      those of the tester and the source.
void work(PieceTester& tester, WorkSource& source);

} // namespace abut
