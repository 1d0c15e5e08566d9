#pragma once

#include <abut/scene.h>

#include <string>
#include <vector>

namespace abut {

/// The command line of the process that reads a file: `abut-reader` with Assimp, or, for IFC,
/// `abut-reader` turning itself into Node.js with the converter (so that the same care is taken of
/// both).
///
/// `abut-reader` is taken from the environment variable ABUT_READER, else beside the running
/// program, else from ../libexec/abut of it, else from helper_folder(), else where it was installed
/// or built. Node.js: ABUT_NODE, else `node` or `nodejs` on the PATH. The converter's folder:
/// ABUT_IFC_CONVERTER, else ../libexec/abut/ifc of the running program, else ifc of
/// helper_folder(), else where it was installed, else in the source tree; of several, the first
/// where `web-ifc` is installed.
///
/// Errors      Error{unsupported}, naming the file, if no reader knows the extension or a program
///             is missing.
std::vector<std::string> reader_command(const std::string& file, const ReadOptions& options);

/// The command line of the process that decodes a model's compressed geometry (decode_request.h).
/// Errors as reader_command.
std::vector<std::string> decoder_command(const std::string& file, std::uint64_t memory_limit);

} // namespace abut
