#pragma once

#include <abut/model.h>
#include <abut/rigid.h>
#include <abut/types.h>

#include "common.h"

#include <array>
#include <string>

/// What collide, distance and within share: two models, each under its pose.
namespace abut::command {

struct TwoModelsOptions {
    std::array<std::string, 2> files;
    std::array<std::string, 2> poses; ///< as given; empty: identity
    double unit = 0;
};

/// Two models ready for a query.
struct TwoModels {
    Model a, b;
    Transform world_from_a, world_from_b;
    double seconds_import = 0, seconds_build = 0;
};

/// Declares A, B, --pose-a, --pose-b and --unit.
void add_two_models(CLI::App& app, TwoModelsOptions& options);

/// "x,y,z,qw,qx,qy,qz": translation, then a quaternion of any length but zero.
///
/// Errors      Error{bad_argument} naming the option.
Pose parse_pose(const std::string& option, const std::string& text);

/// Checks the poses, reads the files, builds the hierarchies.
TwoModels load(const TwoModelsOptions& options, const CommonOptions& common);

/// {a, b}: the beginning of each JSON answer.
nlohmann::ordered_json describe(const TwoModelsOptions& options);
nlohmann::ordered_json describe(const Counters& counters);
/// {import, build, query}
nlohmann::ordered_json describe_seconds(const TwoModels& models, double query);
const char* to_string(Status status);

} // namespace abut::command
