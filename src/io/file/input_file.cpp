#include "io/file/input_file.h"

#include "io/file/fault.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <sys/stat.h>
#include <unistd.h>

namespace abut {

std::string lower_extension(const std::string& path) {
    std::string extension = std::filesystem::path(path).extension();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}

OpenFile open_readable(const std::string& path) {
    // O_NONBLOCK, because opening a named pipe without a writer would block.
    const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (descriptor < 0) {
        if (errno == ENOENT || errno == ENOTDIR)
            throw Fault(ErrorCode::file_not_found, "no such file");
        throw Fault(ErrorCode::unreadable, std::string("cannot be read: ") + std::strerror(errno));
    }
    struct stat status {};
    const bool known = fstat(descriptor, &status) == 0;
    if (known && S_ISREG(status.st_mode) && status.st_size > 0)
        return {descriptor, static_cast<std::uint64_t>(status.st_size)};
    close(descriptor);
    if (known && S_ISREG(status.st_mode))
        malformed("is empty");
    throw Fault(ErrorCode::unreadable,
                known && S_ISDIR(status.st_mode) ? "is a folder" : "is not a regular file");
}

std::uint64_t readable_size(const std::string& path) {
    const OpenFile file = open_readable(path);
    close(file.descriptor);
    return file.size;
}

std::string read_file(const std::string& path) {
    std::string content(readable_size(path), '\0');
    std::ifstream stream(path, std::ios::binary);
    if (!stream.read(content.data(), static_cast<std::streamsize>(content.size())))
        throw Fault(ErrorCode::unreadable, "cannot be read");
    return content;
}

} // namespace abut
