#pragma once

#include "arguments/common.h"

/// The subcommands, one file each. Each function declares one. `common` must outlive the parser.
namespace abut::command {

Subcommand add_info(CLI::App& root, CommonOptions& common);
Subcommand add_import(CLI::App& root, CommonOptions& common);
Subcommand add_picture(CLI::App& root, CommonOptions& common);
Subcommand add_collide(CLI::App& root, CommonOptions& common);
Subcommand add_distance(CLI::App& root, CommonOptions& common);
Subcommand add_within(CLI::App& root, CommonOptions& common);
Subcommand add_time_of_impact(CLI::App& root, CommonOptions& common);
Subcommand add_nearest(CLI::App& root, CommonOptions& common);
Subcommand add_ray(CLI::App& root, CommonOptions& common);
Subcommand add_overlap(CLI::App& root, CommonOptions& common);
Subcommand add_contains(CLI::App& root, CommonOptions& common);
Subcommand add_penetration(CLI::App& root, CommonOptions& common);
Subcommand add_clash(CLI::App& root, CommonOptions& common);
Subcommand add_review(CLI::App& root, CommonOptions& common);
Subcommand add_graph(CLI::App& root, CommonOptions& common);
Subcommand add_ccd(CLI::App& root, CommonOptions& common);
Subcommand add_ccd_query(CLI::App& root, CommonOptions& common);
Subcommand add_robot(CLI::App& root, CommonOptions& common);
Subcommand add_motion(CLI::App& root, CommonOptions& common);
Subcommand add_scene(CLI::App& root, CommonOptions& common);
Subcommand add_generate(CLI::App& root, CommonOptions& common);

} // namespace abut::command
