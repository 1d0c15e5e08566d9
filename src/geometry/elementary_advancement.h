#pragma once

#include <abut/elementary_impact.h>

namespace abut {

/// `elementary_impact` of features with a thickness: when they first come as near as that. Time
/// advances by steps, each as long as it is proven that they are farther apart during it.
///
/// In          finite coordinates of any size; thickness above 0; delta as ElementaryOptions.
/// Accuracy    certified, as ElementaryOptions::thickness says.
/// Cost        some 100 ns a step: one or two of pairs that do not come near, three to six of others.
/// Source      conservative advancement [Mirtich 1996], differs: a step is proven by directions that
///             separate the features all through it, and so may be longer than a bound of speed
///             allows. See docs/elementary-tests.md.
ElementaryImpact elementary_impact_advancement(const ElementaryPair& pair, double thickness,
                                               double delta);

} // namespace abut
