#include "massive/rule_match.h"

#include <algorithm>

namespace abut {

namespace {

bool any_matches(const std::vector<std::string>& globs, std::string_view text,
                 std::string_view other) {
    return globs.empty() || std::any_of(globs.begin(), globs.end(), [&](const std::string& g) {
               return glob_match(g, text) || glob_match(g, other);
           });
}

bool selects(const PartSelector& selector, const Scene& model, const Part& part) {
    const std::string_view path = model.file;
    const std::string_view file = path.substr(path.find_last_of('/') + 1);
    return any_matches(selector.file, path, file) &&
           any_matches(selector.name, part.name, part.id) &&
           any_matches(selector.type, part.type, part.type);
}

bool ignores(const IgnoreRule& rule, const Scene& model_a, const Part& a, const Scene& model_b,
             const Part& b) {
    const std::size_t n = rule.same_name_prefix;
    return (rule.same_file && &model_a == &model_b) || (rule.same_type && a.type == b.type) ||
           (n > 0 && a.name.size() >= n && b.name.size() >= n &&
            a.name.compare(0, n, b.name, 0, n) == 0);
}

} // namespace

bool glob_match(std::string_view glob, std::string_view text) {
    // After a star, the shortest run that lets the rest match: on a mismatch, the last star takes
    // one more.
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

std::optional<PairTerms> terms_of(const ClashOptions& options, const Scene& model_a, const Part& a,
                                  const Scene& model_b, const Part& b) {
    if (options.rules.empty())
        return PairTerms{options.clearance, options.touch, nullptr};
    for (const ClashRule& rule : options.rules) {
        if (!(selects(rule.a, model_a, a) && selects(rule.b, model_b, b)) &&
            !(selects(rule.a, model_b, b) && selects(rule.b, model_a, a)))
            continue;
        if (ignores(rule.ignore, model_a, a, model_b, b))
            return std::nullopt;
        return PairTerms{rule.clearance.value_or(options.clearance),
                         rule.touch.value_or(options.touch), &rule};
    }
    return std::nullopt;
}

} // namespace abut
