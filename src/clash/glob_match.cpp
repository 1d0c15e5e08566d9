#include "clash/glob_match.h"

namespace abut {

bool glob_match(std::string_view glob, std::string_view text) {
    // A star first matches an empty run. On a mismatch, the last star takes one more character.
    std::size_t g = 0, t = 0, after_star = std::string_view::npos, retry = 0;
    while (t < text.size()) {
        if (g < glob.size() && glob[g] == '*') {
            after_star = ++g;
            retry = t;
        } else if (g < glob.size() && (glob[g] == '?' || glob[g] == text[t])) {
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

} // namespace abut
