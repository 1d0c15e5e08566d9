#include "text/text_lines.h"

#include <abut/error.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace abut::command {

void for_each_line(const std::string& file,
                   const std::function<void(std::size_t number, const std::string& line)>& take) {
    if (!std::filesystem::exists(file))
        throw Error(ErrorCode::file_not_found, file, "no such file");
    std::ifstream stream(file, std::ios::binary);
    if (!stream || std::filesystem::is_directory(file))
        throw Error(ErrorCode::unreadable, file, "cannot be read");
    std::string text{std::istreambuf_iterator<char>(stream), {}};
    if (stream.bad())
        throw Error(ErrorCode::unreadable, file, "cannot be read");
    if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff"))
        throw Error(ErrorCode::malformed, file, "is UTF-16 text: save it as UTF-8");
    if (text.find('\0') != std::string::npos)
        throw Error(ErrorCode::malformed, file, "contains zero bytes: it is not text");
    std::size_t at = text.starts_with("\xef\xbb\xbf") ? 3 : 0;
    for (std::size_t number = 1; at < text.size(); ++number) {
        const std::size_t end = std::min(text.find_first_of("\r\n", at), text.size());
        take(number, text.substr(at, end - at));
        at = end + (text.compare(end, 2, "\r\n") == 0 ? 2 : 1);
    }
}

} // namespace abut::command
