#pragma once

#include <string>
#include <vector>

namespace abut {

/// The limits that the kernel enforces from now on. A kernel before 5.13, or without a feature,
/// enforces fewer; the process then keeps the rights of its user.
struct Confinement {
    bool files = false; ///< Landlock: only the named files can be opened
    bool calls = false; ///< seccomp: only the system calls that a reader makes are allowed
};

/// Removes the rights that a reader of untrusted bytes does not need: other files, writing, the
/// network, other processes. Open descriptors stay usable. This is permanent, also for child
/// processes.
///
/// In          file: the only file that can still be opened, for reading; empty: none can.
Confinement confine_reader(const std::string& file);

/// Confines the program that this process is about to become. That program runs threads and
/// generates code, so only these calls are refused: sockets, new processes, signals to others, and
/// calls that inspect or escape. It reads the system's files and the named ones, and writes none.
///
/// In          program: the file to be executed; readable: files and folders.
Confinement confine_program(const std::string& program, const std::vector<std::string>& readable);

} // namespace abut
