#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace abut::viewer {

/// The arguments of the command line.
struct Arguments {
    std::vector<std::string> files; ///< models, or one store
    std::uint64_t memory = std::uint64_t{1} << 30;
    std::uint64_t gpu_memory = std::uint64_t{512} << 20;
    double pixel_error = 1;
    std::uint32_t width = 1280, height = 720;
    std::string part;   ///< id or name of a part to begin at
    std::string carry;  ///< a model file to carry
    std::string path;   ///< a tour to replay without a window
    std::string frames; ///< folder for its pictures and figures
    double rate = 15;   ///< pictures a second of the tour
    bool paced = false; ///< replay by the clock, without pictures
    std::string log;    ///< file for the states of the window
    bool quiet = false;
};

/// Parses the command line. Returns false if all was done already: help, the version, or the
/// documents.
///
/// Errors      Error{bad_argument}.
bool parse(int argc, char** argv, Arguments& arguments);

} // namespace abut::viewer
