#pragma once

#include <abut/model.h>
#include <abut/types.h>

#include "arguments/common.h"

#include <string>
#include <vector>

/// Shared code of nearest, ray, contains and overlap: one model with its pose, and query points.
namespace abut::command {

struct OneModelOptions {
    std::string file;
    std::string pose; ///< as given; identity if empty
    ReadOptions read;
};

/// A model ready for a query.
struct OneModel {
    Model model;
    Transform world_from_model;
    double seconds_import = 0, seconds_build = 0;
    nlohmann::ordered_json frame; ///< as describe_frame returns it
};

/// Declares MODEL, --pose and the options of reading.
void add_one_model(CLI::App& app, OneModelOptions& options);

/// Checks the pose, reads the file, builds the hierarchy.
OneModel load(const OneModelOptions& options, const CommonOptions& common);

/// Returns {import, build, query}, in seconds.
nlohmann::ordered_json describe_seconds(const OneModel& model, double query);

struct PointsOptions {
    std::vector<std::string> points; ///< as given, each "x,y,z"
    std::string file;                ///< one point per line
};

/// Declares --point, which may be repeated, and --points.
void add_points(CLI::App& app, PointsOptions& options);

/// Returns the points of the command line, then those of the file. Each line of the file is
/// "x,y,z"; empty lines and lines that begin with # are skipped.
///
/// Errors      Error naming the option, or the file and the line; bad_argument if there is no point
///             at all.
std::vector<Vec3> load(const PointsOptions& options);

} // namespace abut::command
