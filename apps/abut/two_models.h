#pragma once

#include <abut/batch.h>
#include <abut/model.h>
#include <abut/rigid.h>
#include <abut/types.h>

#include "common.h"

#include <array>
#include <string>
#include <vector>

/// Two models, each under its pose: options, reading, parts of the answer.
namespace abut::command {

struct TwoModelsOptions {
    std::array<std::string, 2> files;
    std::array<std::string, 2> poses; ///< as given; empty: identity
    ReadOptions read;
    Volume volume = Volume::automatic;
};

/// --poses FILE: many poses of B in one run.
struct PosesOption {
    std::string file; ///< empty: the one pose of --pose-b
};

/// Declares it; it excludes --pose-b.
void add_poses(CLI::App& app, PosesOption& option);

/// One row a pose, as --pose-b takes it; empty lines and lines that begin with # are skipped.
///
/// Errors      Error naming the file, and the line: file_not_found, unreadable, malformed.
std::vector<Pose> read_poses(const std::string& file);

/// Two models ready for a query.
struct TwoModels {
    Model a, b;
    Transform world_from_a, world_from_b;
    double seconds_import = 0, seconds_build = 0;
    UpAxis up = UpAxis::z; ///< of the frame, which is A's
};

/// Declares A, B, --pose-a, --pose-b and the options of reading.
void add_two_models(CLI::App& app, TwoModelsOptions& options);

/// Declares --volume: the kind of bounding volume that both models are built with.
void add_volume(CLI::App& app, TwoModelsOptions& options);

/// "x,y,z,qw,qx,qy,qz": translation, then a quaternion of any length but zero.
///
/// Errors      Error{bad_argument} naming the option.
Pose parse_pose(const std::string& option, const std::string& text);

/// Checks the poses, reads the files into the frame of A, builds the hierarchies.
TwoModels load(const TwoModelsOptions& options, const CommonOptions& common);

/// A under its pose, B under each of the poses.
std::vector<Placement> placements(const TwoModels& models, const std::vector<Pose>& poses_of_b);

/// {a, b}: the beginning of each JSON answer.
nlohmann::ordered_json describe(const TwoModelsOptions& options);
/// {up, unit, of}: after a and b.
nlohmann::ordered_json describe_frame(const TwoModelsOptions& options, const TwoModels& models);
nlohmann::ordered_json describe(const Counters& counters);
/// [[a, b], ...]
nlohmann::ordered_json to_json(const std::vector<TrianglePair>& pairs);
/// {import, build, query}
nlohmann::ordered_json describe_seconds(const TwoModels& models, double query);

} // namespace abut::command
