// Conservative advancement [Mirtich 1996]: continuous collision detection by proven steps in time.
//
// At each moment the closest points of the features prove a time span in which the features cannot
// come nearer than the thickness. Time advances by that span, and the closest points are computed
// anew. The search ends when the features are as near as the thickness, or at the end of the
// motion. Each step is proven, so no contact is missed.

#pragma once

#include <abut/elementary_impact.h>

namespace abut {

/// `elementary_impact` of features with a thickness: the first time at which their distance is the
/// thickness. Time advances in steps; during each, the features are proven to be farther apart.
///
/// In          finite coordinates of any size; thickness above 0; absolute_error as in
///             ElementaryOptions.
/// Accuracy    certified, as ElementaryOptions::thickness says.
/// Cost        some 100 ns a step; one or two steps if the pair stays apart, three to six
///             otherwise.
/// Source      [Mirtich 1996]. Differs: a step is proven by directions that separate the features
///             throughout it, so it may be longer than a bound on speed allows. See
///             docs/elementary-tests.md.
ElementaryImpact elementary_impact_advancement(const ElementaryPair& pair, double thickness,
                                               double absolute_error);

} // namespace abut
