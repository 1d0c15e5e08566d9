#include "clash/query/glob.h"

#include <string>

namespace abut {

namespace {

std::string in_lower_case(std::string_view text) {
    std::string result(text);
    for (char& c : result)
        if (c >= 'A' && c <= 'Z')
            c = static_cast<char>(c - 'A' + 'a');
    return result;
}

} // namespace

bool glob_match(std::string_view glob, std::string_view text) {
    // A star first matches an empty run. On a mismatch, the last star takes one more character.
    std::size_t g = 0, t = 0, after_star = std::string_view::npos, retry = 0;
    while (t < text.size()) {
        if (g < glob.size() && glob[g] == '*') {
            after_star = ++g;
            retry = t;
        } else if (g < glob.size() && glob[g] == '?') {
            ++g, ++t;
            while (t < text.size() && continues_character(text[t]))
                ++t;
        } else if (g < glob.size() && glob[g] == text[t]) {
            ++g, ++t;
        } else if (after_star != std::string_view::npos) {
            g = after_star;
            t = ++retry;
        } else {
            return false;
        }
    }
    return glob.find_first_not_of('*', g) == std::string_view::npos;
}

bool glob_found(std::string_view glob, std::string_view text) {
    return glob_match('*' + in_lower_case(glob) + '*', in_lower_case(text));
}

} // namespace abut
