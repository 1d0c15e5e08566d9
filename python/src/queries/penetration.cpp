#include <abut/penetration.h>

#include "module.h"
#include "queries/queries.h"

namespace abut::python {

namespace {

py::object run_penetration(const Arguments& arguments) {
    const Model& a = get<Model>(arguments[0], "a");
    const Model& b = get<Model>(arguments[2], "b");
    const PosePair poses(arguments, 1, 3);
    PenetrationOptions options;
    arguments.take(4, "relative_error", options.relative_error);
    arguments.take(5, "separation", options.separation);
    arguments.take(6, "max_steps", options.max_steps);
    Work work(arguments[7]);
    if (!poses.many())
        return py::cast(work.run([&](const Progress& progress) {
            options.progress = progress;
            return penetration(a, poses.a.one, b, poses.b.one, options);
        }));
    const auto placements = poses.placements();
    return py::cast(work.run([&](const Progress& progress) {
        options.progress.stop = progress.stop;
        std::vector<Depth> list;
        for (const auto& [world_from_a, world_from_b] : placements) {
            list.push_back(penetration(a, world_from_a, b, world_from_b, options));
            if (progress.report)
                progress.report("penetration", static_cast<double>(list.size()) /
                                                   static_cast<double>(placements.size()));
        }
        return list;
    }));
}

} // namespace

void bind_penetration(py::module_& module) {
    PlainBinder<ContactRegion>(module, "ContactRegion", "A place where two models meet.")
        .property(
            "pairs", [](const ContactRegion& r) { return rows<std::uint32_t>(r.pairs); },
            "uint32 array of shape (n, 2): triangles of a and of b")
        .field("touching", &ContactRegion::touching, "nothing crosses: depth 0")
        .field("area", &ContactRegion::area, "enclosed by the intersection curve, along the normal")
        .field("normal", &ContactRegion::normal, "unit vector from a to b")
        .field("depth", &ContactRegion::depth,
               "length, of the deepest point of either surface inside the other")
        .field("depth_at_most", &ContactRegion::depth_at_most, "proven: no such point lies deeper")
        .field("point_a", &ContactRegion::point_a, "on the surface of a, world frame")
        .field("point_b", &ContactRegion::point_b, "on the surface of b, world frame")
        .field("direction", &ContactRegion::direction, "unit vector in which b moves to get out")
        .done();
    PlainBinder<Depth>(module, "Depth", "Returned by penetration. True if the models meet.")
        .field("meet", &Depth::meet, "they share a point, or one lies inside the other")
        .field("interpenetrate", &Depth::interpenetrate, "they do more than touch")
        .field("depth", &Depth::depth, "length; a lower bound of every separating translation's")
        .field("depth_at_most", &Depth::depth_at_most, "upper bound of the deepest point's depth")
        .field("direction", &Depth::direction, "unit vector, of the deepest region")
        .field("point_a", &Depth::point_a, "of the deepest region")
        .field("point_b", &Depth::point_b, "of the deepest region")
        .field("separation", &Depth::separation,
               "translation of b after which the models are apart: verified")
        .field("regions", &Depth::regions, "list of ContactRegion")
        .field("status", &Depth::status, "Status")
        .field("out_of_steps", &Depth::out_of_steps, "whether max_steps ended the search")
        .field("steps", &Depth::steps, "steps of the search")
        .field("counters", &Depth::counters, "Counters")
        .done()
        .def("__bool__", [](const Depth& depth) { return depth.meet; });
    add_verb(
        module, "penetration",
        "penetration(a, pose_a, b, pose_b, *, relative_error=0.01, separation=True, "
        "max_steps=None, warm_start=None,\n"
        "            progress=None)\n"
        "--\n\n"
        "How deep two models go into each other, where, and a translation that parts them.\n\n"
        "a, b            two Model, two Convex or two ConvexPieces\n"
        "pose_a, pose_b  as for collide\n"
        "relative_error  width that [depth, depth_at_most] should have, as a share (models only)\n"
        "separation      False: leave `separation` zero, and save its time (not for Convex)\n"
        "max_steps       limit of the search (models only)\n"
        "warm_start      a ConvexWarmStart (Convex only); not with many poses\n"
        "progress        function of (stage, fraction)\n\n"
        "Returns Depth, ConvexDepth or PiecesDepth. With many poses a list of Depth, or a record "
        "array of the\n"
        "others; only those of ConvexPieces are computed in parallel. Raises Error (bad_argument) "
        "if a pose is not\n"
        "finite; KeyboardInterrupt at Ctrl-C.");
    add_overload("penetration",
                 {both<Model>,
                  {"a pose_a b pose_b * relative_error separation max_steps progress", 4},
                  run_penetration});
}

} // namespace abut::python
