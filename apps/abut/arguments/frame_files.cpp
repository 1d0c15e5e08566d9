#include "arguments/frame_files.h"

#include <abut/error.h>

#include <algorithm>
#include <glob.h>
#include <string_view>

namespace abut::command {

namespace {

std::string_view leading_digits(std::string_view text) {
    return text.substr(0, std::min(text.find_first_not_of("0123456789"), text.size()));
}

/// Returns whether a sorts before b if runs of digits are compared as numbers. Names that differ
/// only in leading zeros are equal.
bool naturally_less(std::string_view a, std::string_view b) {
    while (!a.empty() && !b.empty()) {
        std::string_view number_a = leading_digits(a), number_b = leading_digits(b);
        if (number_a.empty() || number_b.empty()) {
            if (a.front() != b.front())
                return a.front() < b.front();
            a.remove_prefix(1);
            b.remove_prefix(1);
            continue;
        }
        a.remove_prefix(number_a.size());
        b.remove_prefix(number_b.size());
        for (std::string_view* const number : {&number_a, &number_b})
            number->remove_prefix(std::min(number->find_first_not_of('0'), number->size()));
        if (number_a.size() != number_b.size())
            return number_a.size() < number_b.size();
        if (number_a != number_b)
            return number_a < number_b;
    }
    return a.size() < b.size();
}

std::vector<std::string> matches(const std::string& pattern) {
    glob_t found{};
    const int fault = glob(pattern.c_str(), 0, nullptr, &found);
    std::vector<std::string> files(found.gl_pathv, found.gl_pathv + found.gl_pathc);
    globfree(&found);
    if (fault != 0)
        throw Error(ErrorCode::file_not_found, pattern, "matches no file");
    return files;
}

} // namespace

std::vector<std::string> frame_files(const std::vector<std::string>& arguments) {
    std::vector<std::string> files = arguments;
    if (arguments.size() == 1) {
        files = matches(arguments.front());
        // Stable, so that names that differ only in leading zeros keep the byte order of glob().
        std::stable_sort(files.begin(), files.end(), naturally_less);
    }
    if (files.size() < 2)
        throw Error(ErrorCode::bad_argument, files.front(),
                    "is only one frame; a sequence needs at least two");
    return files;
}

} // namespace abut::command
