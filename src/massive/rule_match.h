#pragma once

#include <abut/clash.h>

#include <optional>
#include <string_view>

namespace abut {

/// Whether a text matches a glob: `*` any run, `?` one character, all others themselves. Case
/// counts.
bool glob_match(std::string_view glob, std::string_view text);

/// What the rules say of a pair of parts.
struct PairTerms {
    double clearance, touch;
    const ClashRule* rule; ///< null: there are no rules
};

/// The first rule that selects the pair, in either order, gives its terms; none if it ignores the
/// pair or no rule selects it. Without rules, every pair has the options' terms.
///
/// Selectors match a file by its path or by its name alone, a name by `name` or `id`.
std::optional<PairTerms> terms_of(const ClashOptions& options, const Scene& model_a, const Part& a,
                                  const Scene& model_b, const Part& b);

} // namespace abut
