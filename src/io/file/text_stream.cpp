#include "io/file/text_stream.h"

#include <abut/error.h>

#include <filesystem>
#include <system_error>

namespace abut {

std::ifstream open_text(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    if (in)
        return in;
    std::error_code unknown; // a folder that may not be looked into: the file may exist
    if (!std::filesystem::exists(path, unknown) && !unknown)
        throw Error(ErrorCode::file_not_found, path, "no such file");
    throw Error(ErrorCode::unreadable, path, "cannot be read");
}

} // namespace abut
