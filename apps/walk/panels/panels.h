#pragma once

#include "tools.h"

/// The panels of the window, one file each. Each draws itself with Dear ImGui in every frame.
namespace abut::viewer {

void show_parts_panel(Session& session, Tools& tools); ///< search, properties of the chosen part
void show_proximity_panel(Session& session, Tools& tools); ///< nearest part, list of near parts
void show_measure_panel(Session& session, Tools& tools);
void show_section_panel(Session& session); ///< planes, box, colours
void show_clash_panel(Session& session, Tools& tools);
void show_carry_panel(Session& session, Tools& tools);
void show_viewpoint_panel(Session& session, Tools& tools);
void show_help_panel(Tools& tools);
void show_status_line(Session& session, Tools& tools);

} // namespace abut::viewer
