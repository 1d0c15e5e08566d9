#pragma once

#include <abut/bcf.h>
#include <abut/clash.h>
#include <abut/clash_viewpoint.h>
#include <abut/progress.h>
#include <abut/scene.h>
#include <abut/store.h>
#include <abut/store_clash.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

/// Clashes as topics of BCF. docs/bcf.md explains what becomes what.
namespace abut {

/// A topic and the clashes that it is about.
struct ClashTopic {
    BcfTopic topic;                     ///< without files and viewpoints
    std::vector<std::uint32_t> clashes; ///< indices in ClashReport::clashes
};

struct ClashBcfOptions {
    /// The topics; if empty, one for each clash. What a topic does not state is filled in: GUID (from
    /// the ids of its clashes), title, type, status, author and time.
    std::vector<ClashTopic> topics{};
    std::string author = "Abut"; ///< who creates the topics
    std::int64_t time = 0;       ///< when they are created, seconds since 1970; 0: the clock
    std::string project{};       ///< name of the project; may be empty
    bool clip = true;            ///< whether planes cut away what lies outside the section box
    /// Returns a PNG file of what a viewpoint shows, or nothing. Called for one topic at a time.
    std::function<std::string(const ClashViewpoint&)> snapshot{};
    Progress progress{};
};

/// Returns topics with viewpoints, files and labels. The GUID of a topic is derived from the id of
/// its clash, so that a program that imports two exports updates the topics of the first.
///
/// Coordinates are those of the report's frame with z up, in metres: on the map, unless the models
/// were read without ReadOptions::map.
///
/// Errors      as clash_viewpoints; those of `snapshot`.
/// Cost        that of clash_viewpoints and the snapshots.
BcfFile clash_bcf(const ClashReport& report, const std::vector<Scene>& models,
                  const ClashBcfOptions& options = {});
/// As above, for a job on a store.
BcfFile clash_bcf(const StoreClashReport& found, const Store& store,
                  const ClashBcfOptions& options = {});

/// Updates a file by a later export: topics of one GUID get the description, the labels and the
/// viewpoint of the later one and keep what people have done in the earlier one: title, status,
/// assignee, dates, comments, other viewpoints, documents and unknown elements. Topics and entries of
/// one file alone stay.
BcfFile update_bcf(const BcfFile& earlier, const BcfFile& later);

} // namespace abut
