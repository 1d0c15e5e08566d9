#pragma once

#include <abut/batch.h>
#include <abut/model.h>
#include <abut/rigid.h>
#include <abut/types.h>

#include "arguments/common.h"

#include <array>
#include <string>
#include <vector>

/// Two models with their poses: options, reading, shared members of the answer.
namespace abut::command {

struct TwoModelsOptions {
    std::array<std::string, 2> files;
    std::array<std::string, 2> poses; ///< as given; identity if empty
    ReadOptions read;
    Volume volume = Volume::automatic;
};

/// The option --poses FILE, which gives many poses of B in one run.
struct PosesOption {
    std::string file; ///< if empty, the pose of --pose-b is used
};

/// Declares --poses, which excludes --pose-b.
void add_poses(CLI::App& app, PosesOption& option);

/// Reads poses from a file, one per line in the form of --pose-b. Empty lines and lines that begin
/// with # are skipped.
///
/// Errors      Error naming the file, and the line: file_not_found, unreadable, malformed.
std::vector<Pose> read_poses(const std::string& file);

/// Two models ready for a query.
struct TwoModels {
    Model a, b;
    Transform world_from_a, world_from_b;
    double seconds_import = 0, seconds_build = 0;
    UpAxis up = UpAxis::z; ///< of A's frame, in which both are
};

/// Declares A, B, --pose-a, --pose-b and the options of reading.
void add_two_models(CLI::App& app, TwoModelsOptions& options);

/// Declares --volume: the kind of bounding volume that both models are built with.
void add_volume(CLI::App& app, TwoModelsOptions& options);

/// Parses "x,y,z,qw,qx,qy,qz": a translation, then a quaternion of any length except zero.
///
/// Errors      Error{bad_argument} naming the option.
Pose parse_pose(const std::string& option, const std::string& text);

/// Checks the poses, reads the files into the frame of A, builds the hierarchies.
TwoModels load(const TwoModelsOptions& options, const CommonOptions& common);

/// Returns A at its pose with B at each of the poses.
std::vector<Placement> placements(const TwoModels& models, const std::vector<Pose>& poses_of_b);

/// Returns {a, b}, the first members of each JSON answer.
nlohmann::ordered_json describe(const TwoModelsOptions& options);
/// Returns {up, unit, of}, which follows a and b.
nlohmann::ordered_json describe_frame(const TwoModelsOptions& options, const TwoModels& models);
nlohmann::ordered_json describe(const Counters& counters);
/// Returns {kind, index}: the part of a triangle that a point lies on.
nlohmann::ordered_json describe_feature(Feature kind, std::uint8_t index);
/// Returns [[a, b], ...].
nlohmann::ordered_json to_json(const std::vector<TrianglePair>& pairs);
/// Returns {import, build, query}, in seconds.
nlohmann::ordered_json describe_seconds(const TwoModels& models, double query);

} // namespace abut::command
