#pragma once

#include <abut/clash.h>
#include <abut/progress.h>
#include <abut/scene.h>
#include <abut/store.h>
#include <abut/store_clash.h>
#include <abut/types.h>

#include <cstdint>
#include <string>
#include <vector>

/// Cameras from which clashes are seen best, for reports, pictures and BCF. They are chosen by
/// drawing the triangles near a clash into small depth pictures; no graphics card is needed.
namespace abut {

/// A part by the indices that clashes use.
struct ReportPart {
    std::uint32_t model = 0, part = 0;
    friend bool operator==(const ReportPart&, const ReportPart&) = default;
    // NOLINTNEXTLINE(modernize-use-nullptr): clang-tidy 14 misreads the comparison
    friend auto operator<=>(const ReportPart&, const ReportPart&) = default;
};

/// A part by its words.
struct NamedPart {
    std::string file, id;
    friend bool operator==(const NamedPart&, const NamedPart&) = default;
    // NOLINTNEXTLINE(modernize-use-nullptr): clang-tidy 14 misreads the comparison
    friend auto operator<=>(const NamedPart&, const NamedPart&) = default;
};

/// A camera that shows one clash or several, in the frame of the report.
struct ClashViewpoint {
    Vec3 eye, direction, up; ///< direction and up: unit vectors, perpendicular to each other
    double fov = 0;          ///< vertical angle, radians
    double aspect = 1;       ///< width of the picture, divided by its height
    /// The surroundings that make the clash understandable. What lies outside may be hidden: it was
    /// ignored in the choice of the camera, and may be in its way. If one part hides the other, a
    /// face of the box cuts the part open.
    Box3 section_box;
    /// Fractions of the picture that the sides cover. If one of them is nearly 0, that side cannot
    /// be seen together with the other from outside.
    double shown_a = 0, shown_b = 0;
    /// The parts of both sides, sorted. With several clashes, side a is the part that most of them
    /// share (of several the first), or, if none is shared, each clash's first part.
    std::vector<ReportPart> side_a, side_b;
    std::vector<NamedPart> near; ///< other parts whose boxes meet the section box, sorted
};

struct ViewpointOptions {
    double fov = 0.7853981633974483; ///< vertical angle, radians, in (0, pi)
    double aspect = 1.6;             ///< of the picture: width / height, in [0.1, 10]
    bool near = false;               ///< whether ClashViewpoint::near is filled
    Progress progress{};
};

/// Chooses a viewpoint for each list of clashes: one clash, or the members of a group.
///
/// The camera looks from one of 48 directions, mostly from above, and shows the surroundings of the
/// clashes' witness points. Of all directions it is the one from which most of both sides is
/// visible between the other parts. Viewpoints are the same for any number of threads.
///
/// In          clashes: indices in report.clashes. models: those that the report is about.
/// Degenerate  an empty list gives a viewpoint without parts, of an empty box.
/// Errors      Error{bad_argument} for an index out of range or an option outside its domain;
///             Error{interrupted}.
/// Cost        a pass over the vertices of all models; then for each list a pass over the boxes of
///             all parts, and 48 small pictures of at most 20,000 triangles. Parallel over lists.
std::vector<ClashViewpoint> clash_viewpoints(const ClashReport& report,
                                             const std::vector<Scene>& models,
                                             const std::vector<std::vector<std::uint32_t>>& clashes,
                                             const ViewpointOptions& options = {});
/// As above, for a job on a store. Reads the parts near the clashes only.
///
/// Errors      as above; those of the store.
std::vector<ClashViewpoint> clash_viewpoints(const StoreClashReport& found, const Store& store,
                                             const std::vector<std::vector<std::uint32_t>>& clashes,
                                             const ViewpointOptions& options = {});

/// As clash_viewpoints, for one clash.
ClashViewpoint clash_viewpoint(const ClashReport& report, const std::vector<Scene>& models,
                               std::uint32_t clash, const ViewpointOptions& options = {});
ClashViewpoint clash_viewpoint(const StoreClashReport& found, const Store& store,
                               std::uint32_t clash, const ViewpointOptions& options = {});

/// Chooses the viewpoint of a clash as a store's review lists it (abut/clash_review.h), without the
/// report of its job.
///
/// Out         sides: the place of a part's model among StoreSummary::models, and its place in
///             read_parts. Otherwise as of a report, if the parts have not changed.
/// Errors      Error{bad_argument} if the store lacks a part of the clash; Error{interrupted};
///             those of the store.
/// Cost        a pass over the boxes of all parts; both parts are classified again, as by a job;
///             and as above for one list.
ClashViewpoint clash_viewpoint(const Store& store, const ListedClash& clash,
                               const ViewpointOptions& options = {});

} // namespace abut
