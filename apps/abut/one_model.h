#pragma once

#include <abut/model.h>
#include <abut/types.h>

#include "common.h"

#include <string>
#include <vector>

/// What nearest, ray, contains and overlap share: one model under its pose, and points to ask for.
namespace abut::command {

struct OneModelOptions {
    std::string file;
    std::string pose; ///< as given; empty: identity
    ReadOptions read;
};

/// A model ready for a query.
struct OneModel {
    Model model;
    Transform world_from_model;
    double seconds_import = 0, seconds_build = 0;
    nlohmann::ordered_json frame; ///< as describe_frame has it
};

/// Declares MODEL, --pose and the options of reading.
void add_one_model(CLI::App& app, OneModelOptions& options);

/// Checks the pose, reads the file, builds the hierarchy.
OneModel load(const OneModelOptions& options, const CommonOptions& common);

/// {import, build, query}
nlohmann::ordered_json describe_seconds(const OneModel& model, double query);

struct PointsOptions {
    std::vector<std::string> points; ///< as given, x,y,z each
    std::string file;                ///< a line a point
};

/// Declares --point, which may be repeated, and --points.
void add_points(CLI::App& app, PointsOptions& options);

/// The points of the command line, then those of the file: a line x,y,z each; empty lines and those
/// that begin with # are skipped.
///
/// Errors      Error naming the option, or the file and the line; bad_argument where there is no
///             point at all.
std::vector<Vec3> load(const PointsOptions& options);

} // namespace abut::command
