#pragma once

#include <abut/scene.h>

#include <string>
#include <vector>

namespace abut {

/// Returns the command line of the process that reads a file: `abut-reader` with Assimp. For IFC,
/// `abut-reader` confines itself and then becomes Node.js with the converter.
///
/// `abut-reader` is searched for in this order: the environment variable ABUT_READER, beside the
/// running program, ../libexec/abut relative to it, helper_folder(), where it was installed or
/// built. Node.js is ABUT_NODE, else `node` or `nodejs` on the PATH. The converter's folder is
/// searched for in this order: ABUT_IFC_CONVERTER, ../libexec/abut/ifc relative to the running
/// program, `ifc` in helper_folder(), where it was installed, the source tree. The first folder
/// with `web-ifc` installed is used.
///
/// Errors      Error{unsupported}, naming the file, if no reader knows the extension or a program
///             is missing.
std::vector<std::string> reader_command(const std::string& file, const ReadOptions& options);

/// Returns the command line of the process that decodes a model's compressed geometry
/// (decode_request.h). Errors as reader_command.
std::vector<std::string> decoder_command(const std::string& file, std::uint64_t memory_limit);

} // namespace abut
