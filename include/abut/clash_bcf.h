#pragma once

#include <abut/bcf.h>
#include <abut/clash.h>
#include <abut/clash_viewpoint.h>
#include <abut/progress.h>
#include <abut/scene.h>
#include <abut/store.h>
#include <abut/store_clash.h>
#include <abut/topics.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

/// Clashes as topics of BCF, and back. docs/bcf.md explains what becomes what.
namespace abut {

struct ClashBcfOptions {
    /// Who creates the topics that no store has yet.
    std::string author = "Abut";
    std::int64_t time = 0; ///< when they are created, seconds since 1970; 0: the clock
    std::string project;   ///< name of the project; may be empty
    bool clip = true;      ///< whether planes cut away what lies outside the section box
    /// Returns a PNG file of what a viewpoint shows, or nothing. Called for one topic at a time.
    std::function<std::string(const ClashViewpoint&)> snapshot{};
    Progress progress{};
};

/// Returns one topic for each innermost group of a report or, if the report is not grouped, for
/// each clash; and the report's other topics. A topic's GUID is derived from the id of its group or
/// clash, so that a program that imports two exports updates the topics of the first.
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

/// Updates a file by a later export. Topics of one GUID get the viewpoint and the derived words of
/// the later one. Of title, status, assignee and the like, those stay that were changed last: the
/// earlier file's, unless a store has changed the topic since. Comments are united. Other viewpoints,
/// documents and unknown elements stay, as do topics and entries of one file alone.
BcfFile update_bcf(const BcfFile& earlier, const BcfFile& later);

/// Returns the revision of a store's topics that a file was exported from; none if it does not say.
std::optional<std::int64_t> bcf_revision(const BcfFile& file);

/// Merges the topics of a BCF file into a store, as merge_topics does: fields, labels and comments
/// of the topics of its groups and clashes, and other topics as new ones. Topics of which nobody has
/// said anything are not stored. Viewpoints stay in the file.
///
/// In          options.base: none means the revision of the file. If the file does not say one (some
///             programs drop it), the topic that was changed last gives the fields, and comments,
///             labels and links are united.
/// Errors      as merge_topics.
TopicMerge merge_bcf(const Store& store, const BcfFile& file, const MergeOptions& options = {});

} // namespace abut
