#include "module.h"

#include "support/work.h"

namespace abut::python {

PYBIND11_MODULE(_abut, module) {
    module.doc() = "The part of abut that is written in C++.";
    module.attr("__version__") = ABUT_VERSION;
    begin_watch();
    // A header that uses another's types comes after it.
    bind_error(module);
    bind_types(module);
    bind_progress(module);
    bind_volume(module);
    bind_mesh(module);
    bind_model(module);
    bind_rigid(module);
    bind_motion(module);
    bind_penetration(module);
    bind_model_contacts(module);
    bind_shapes(module);
    bind_shape_queries(module);
    bind_convex(module);
    bind_convex_pieces(module);
    bind_broad_phase(module);
    bind_elementary_impact(module);
    bind_deformable(module);
    bind_world(module);
    bind_scene(module);
    bind_frame(module);
    bind_topic_records(module);
    bind_group_records(module);
    bind_clash(module);
    bind_store(module);
    bind_crew(module);
    bind_store_clash(module);
    bind_topics(module);
    bind_clash_groups(module);
    bind_clash_review(module);
    bind_clash_viewpoint(module);
    bind_bcf(module);
    bind_clash_bcf(module);
    bind_walk(module);
    bind_maintenance_path(module);
    bind_carry(module);
    bind_walker(module);
    bind_levels(module);
    bind_camera(module);
    bind_tour(module);
    bind_view(module);
    bind_renderer(module);
    bind_picture(module);
    bind_robot_description(module);
    bind_robot(module);
    bind_assembly(module);
    bind_helper_programs(module);
}

} // namespace abut::python
