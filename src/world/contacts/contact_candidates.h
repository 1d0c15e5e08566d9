#pragma once

#include "world/contacts/contact_face.h"
#include "world/solids/contact_candidate.h"
#include "world/solids/write_points.h"

namespace abut {

/// Adds the corners of the region in which two faces lie over each other along the normal. Their
/// names differ: of corners with the same name, the deepest remains. None if the faces do not
/// overlap, if they are two crossing segments, or if neither is a polygon and one is a point.
///
/// In          faces relative to the frame's origin; no candidates yet.
/// Names       a corner is named by the two features that cross there. Vertices within 1/64 of the
///             region's extent take part in the name, so that the name also stays where vertices
///             and edges of both bodies lie over each other, up to small motions.
/// Cost        proportional to the product of the faces' numbers of corners.
/// Source      [Sutherland, Hodgman 1974]; a segment by [Cyrus, Beck 1978].
void add_overlap_corners(const ContactFace& a, const ContactFace& b, const ContactFrame& frame,
                         ContactCandidates& candidates);

} // namespace abut
