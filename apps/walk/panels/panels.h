#pragma once

#include "toolbox/tools.h"

/// The panels of the window, one file each. Each draws itself with Dear ImGui in every frame.
namespace abut::viewer {

void show_parts_panel(Session& session, Tools& tools); ///< search, properties of the chosen part
void show_proximity_panel(Session& session, Tools& tools); ///< nearest part, list of near parts
void show_measure_panel(Session& session, Tools& tools);
void show_section_panel(Session& session, Tools& tools); ///< planes, box
void show_colour_panel(Session& session);                ///< colours, their legend, style
void show_clash_panel(Session& session, Tools& tools);
void show_carry_panel(Session& session, Tools& tools);
void show_viewpoint_panel(Session& session, Tools& tools);
void show_help_panel(Tools& tools); ///< all keys
void show_status_line(Session& session, Tools& tools);
void show_gizmo(const Session& session, const Tools& tools); ///< over the picture
void show_distance_legend(const Session& session);
/// The progress of an import, in the middle of an empty window.
void show_import(const std::string& stage, double fraction);

} // namespace abut::viewer
