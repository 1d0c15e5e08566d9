#include "ccd/elementary_stages.h"

#include <abut/error.h>

#include "ccd/conservative_advancement.h"
#include "ccd/difference_patch.h"
#include "ccd/elementary_exact.h"
#include "ccd/elementary_interval.h"

#include <cmath>

namespace abut {

void require_valid(const ElementaryOptions& options) {
    if (!(options.absolute_error >= 0 && std::isfinite(options.absolute_error)))
        throw Error(ErrorCode::bad_argument,
                    "the error allowed must be a finite number of at least 0");
    if (!(options.thickness >= 0 && std::isfinite(options.thickness)))
        throw Error(ErrorCode::bad_argument, "thickness must be a finite number of at least 0");
}

ElementaryImpact impact_of_crossing(const ElementaryPair& pair, const CrossingBatch& crossings,
                                    std::size_t lane) {
    ElementaryImpact impact;
    impact.decided_by = ElementaryStage::interval;
    if ((crossings.meet >> lane & 1) == 0)
        return impact;
    impact.meet = true;
    impact.time = crossings.time[lane];
    impact.barycentric = patch_barycentric(pair.kind, crossings.x[lane], crossings.y[lane]);
    impact.normal = impact_normal(
        pair, impact.barycentric,
        {crossings.normal[0][lane], crossings.normal[1][lane], crossings.normal[2][lane]}, {});
    return impact;
}

ElementaryImpact decide_singly(const ElementaryPair& pair, const ElementaryOptions& options) {
    if (options.thickness > 0)
        return elementary_impact_advancement(pair, options.thickness, options.absolute_error);
    if (const auto impact = elementary_impact_interval(pair, options.absolute_error))
        return *impact;
    return elementary_impact_exact(pair);
}

} // namespace abut
