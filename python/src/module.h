#pragma once

#include "support/python.h"

/// Each function adds to the module what one public header declares.
namespace abut::python {

void bind_error(py::module_& module);
void bind_types(py::module_& module);
void bind_progress(py::module_& module);
void bind_mesh(py::module_& module);
void bind_volume(py::module_& module);
void bind_model(py::module_& module);
void bind_rigid(py::module_& module);
void bind_motion(py::module_& module);
void bind_penetration(py::module_& module);
void bind_model_contacts(py::module_& module);
void bind_shapes(py::module_& module);
void bind_shape_queries(py::module_& module);
void bind_convex(py::module_& module);
void bind_convex_pieces(py::module_& module);
void bind_broad_phase(py::module_& module);
void bind_elementary_impact(py::module_& module);
void bind_deformable(py::module_& module);
void bind_world(py::module_& module);
void bind_scene(py::module_& module);
void bind_frame(py::module_& module);
void bind_clash(py::module_& module);
void bind_store(py::module_& module);
void bind_crew(py::module_& module);
void bind_store_clash(py::module_& module);
void bind_topic_records(py::module_& module);
void bind_group_records(py::module_& module);
void bind_clash_groups(py::module_& module);
void bind_topics(py::module_& module);
void bind_clash_review(py::module_& module);
void bind_clash_viewpoint(py::module_& module);
void bind_bcf(py::module_& module);
void bind_clash_bcf(py::module_& module);
void bind_walk(py::module_& module);
void bind_maintenance_path(py::module_& module);
void bind_carry(py::module_& module);
void bind_walker(py::module_& module);
void bind_levels(py::module_& module);
void bind_camera(py::module_& module);
void bind_tour(py::module_& module);
void bind_view(py::module_& module);
void bind_renderer(py::module_& module);
void bind_picture(py::module_& module);
void bind_robot_description(py::module_& module);
void bind_robot(py::module_& module);
void bind_assembly(py::module_& module);
void bind_helper_programs(py::module_& module);

} // namespace abut::python
