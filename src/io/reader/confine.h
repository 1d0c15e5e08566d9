#pragma once

#include <string>
#include <vector>

namespace abut {

/// What the kernel enforces from now on. Kernels before 5.13, or without a feature, enforce less:
/// the process then keeps the rights of its user.
struct Confinement {
    bool files = false; ///< Landlock: no file but the named ones
    bool calls = false; ///< seccomp: no system call but those that a reader makes
};

/// Takes from this process what a reader of untrusted bytes does not need: other files, writing,
/// the network, other processes. Open descriptors stay. There is no way back, for its children
/// neither.
///
/// In          file: the only one that can still be opened, for reading; empty: none can.
Confinement confine_reader(const std::string& file);

/// Confines the program that this process is about to become. That program runs threads and makes code
/// at run time, so that only these calls are taken from it: sockets, new processes, signals to others, and what
/// serves to inspect or escape. It reads the system's files and the named ones, and writes none.
///
/// In          program: the file to be executed; readable: files and folders.
Confinement confine_program(const std::string& program, const std::vector<std::string>& readable);

} // namespace abut
