#include "scenes/clash_drafts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

/// The planted clashes. Where a distance is given, sizes are multiples of 1/1024 m and poses are
/// quarter turns. Contacts and gaps are then exact in double arithmetic, and survive a file of
/// floats.
namespace abut::scenes {
namespace {

ShapeId planted_pipe(PlantBuilder& b, double length) {
    return b.shape(fmt::format("planted pipe {}", length),
                   [&] { return pipe(length, kBore, b.sides); });
}

ShapeId planted_bar(PlantBuilder& b, double length, double height, double width) {
    return b.shape(fmt::format("planted bar {} {} {}", length, height, width),
                   [&] { return bar(length, height, width); });
}

ShapeId planted_block(PlantBuilder& b, double x, double y, double z) {
    return b.shape(fmt::format("planted block {} {} {}", x, y, z), [&] { return block(x, y, z); });
}

ShapeId planted_beam(PlantBuilder& b) {
    return b.shape("planted beam", [] { return i_section(1.5, 0.5, 0.25, 0.015625, 0.03125); });
}

// ---- hard

Draft pipe_through_web(PlantBuilder& b) {
    return {planted_pipe(b, 1.5),
            planted_beam(b),
            along(kZ, {0, 0.25, -0.75}),
            at({-0.75, 0.25, 0}),
            "IfcPipeSegment",
            "IfcBeam",
            {},
            "pipe through the web of a beam"};
}

Draft duct_grazes_column(PlantBuilder& b) {
    constexpr double kDepth = 48 * kGrid; // no part of the duct's sheet within the column is deeper
    const ShapeId duct_shape = b.shape("planted duct", [] { return duct(1.5, 0.5, 0.75); });
    return {duct_shape,        planted_block(b, 0.25, 2, 0.25),
            at({-0.75, 1, 0}), at({0, 0, 0.375 + 0.125 - kDepth}),
            "IfcDuctSegment",  "IfcColumn",
            -kDepth,           "duct grazes a column"};
}

Draft pipe_in_pipe(PlantBuilder& b) {
    constexpr double kDepth = 0.0625; // less than the inradius of the section: the ends are nearest
    const ShapeId half = planted_pipe(b, 1);
    return {half,
            half,
            at({-1, kBore, 0}),
            at({-kDepth, kBore, 0}),
            "IfcPipeSegment",
            "IfcPipeSegment",
            -kDepth,
            "pipes of one axis and bore laid into each other: only coplanar faces overlap"};
}

Draft shallow_crossing(PlantBuilder& b) {
    constexpr double kDepth = 3 * kGrid;
    const ShapeId rail = planted_bar(b, 1.5, 0.25, 0.25);
    return {rail,
            rail,
            at({-0.75, 0.125, 0}),
            along(kZ, {0, 0.375 - kDepth, -0.75}),
            "IfcBeam",
            "IfcBeam",
            -kDepth,
            "beams cross, 3 mm deep"};
}

Draft brace_through_post(PlantBuilder& b) {
    const ShapeId post = planted_block(b, 0.1875, 1.75, 0.1875);
    const ShapeId brace =
        b.shape("planted brace", [] { return hollow_section(1.5, 0.125, 0.125, 0.0078125); });
    return {brace,
            post,
            turned({0.8, 0.6, 0}, {-0.6, 0.8, 0}, {-0.625, 0.25, 0.0625}),
            at({0, 0, 0}),
            "IfcMember",
            "IfcColumn",
            {},
            "slanting brace runs into a post"};
}

// ---- touch

Draft cabinet_on_plinth(PlantBuilder& b) {
    return {planted_block(b, 0.5, 1, 0.5),
            planted_block(b, 1, 0.125, 1),
            at({0.125, 0.125, 0}),
            at({0, 0, 0}),
            "IfcElectricDistributionBoard",
            "IfcSlab",
            0,
            "cabinet rests on a plinth: face on face"};
}

Draft wedge_on_plinth(PlantBuilder& b) {
    const ShapeId ridge = b.shape("planted wedge", [] { return wedge(0.75, 0.5, 0.5); });
    return {ridge,
            planted_block(b, 1, 0.125, 1),
            at({-0.375, 0.125, 0.0625}),
            at({0, 0, 0}),
            "IfcMember",
            "IfcSlab",
            0,
            "wedge stands on its ridge: edge on face"};
}

Draft tip_on_plinth(PlantBuilder& b) {
    const ShapeId tip = b.shape("planted octahedron", [] { return octahedron(0.25); });
    return {tip,
            planted_block(b, 1, 0.125, 1),
            at({0.0625, 0.125, 0.03125}),
            at({0, 0, 0}),
            "IfcBuildingElementProxy",
            "IfcSlab",
            0,
            "tip stands on a plinth: vertex on face"};
}

Draft pipes_end_to_end(PlantBuilder& b) {
    const ShapeId half = planted_pipe(b, 1);
    return {half,
            half,
            at({-1, kBore, 0}),
            at({0, kBore, 0}),
            "IfcPipeSegment",
            "IfcPipeSegment",
            0,
            "pipes meet end to end: equal faces"};
}

Draft ridges_cross(PlantBuilder& b) {
    const ShapeId ridge = b.shape("planted wedge", [] { return wedge(0.75, 0.5, 0.5); });
    // The lower wedge is turned over: its ridge is up.
    return {ridge,
            ridge,
            at({-0.375, 0.5, 0}),
            turned(kZ, scaled(kY, -1), {0, 0.5, -0.375}),
            "IfcMember",
            "IfcMember",
            0,
            "ridges of two wedges cross: edge on edge"};
}

// ---- contained

Draft bolt_in_tank(PlantBuilder& b) {
    const ShapeId shell =
        b.shape("planted tank", [&] { return tank(1.75, 0.625, 0.25, b.sides, 3); });
    const ShapeId stud = b.shape("planted bolt", [] { return bolt(0.125, 0.01171875, false); });
    return {stud,
            shell,
            at({-0.0625, 0.625, 0.03125}),
            at({-0.875, 0.625, 0}),
            "IfcMechanicalFastener",
            "IfcTank",
            {},
            "bolt left in a tank"};
}

Draft box_in_box(PlantBuilder& b) {
    const double gap = on_grid(std::max(0.3125, b.gap)); // gap below, the smallest of the six gaps
    return {planted_block(b, 0.25, 0.25, 0.25),
            planted_block(b, 1.25, 1.25, 1.25),
            at({0.0625, gap, -0.0625}),
            at({0, 0, 0}),
            "IfcBuildingElementProxy",
            "IfcElectricDistributionBoard",
            -gap,
            "box inside a closed box"};
}

Draft elbow_in_vessel(PlantBuilder& b) {
    const ShapeId shell =
        b.shape("planted vessel", [&] { return tank(1.75, 0.75, 0.125, b.sides, 2); });
    const ShapeId bend =
        b.shape("planted elbow", [&] { return elbow(0.0625, 0.1875, b.sides, 3); });
    return {bend,      shell, at({-0.09375, 0.6875, 0}), at({-0.875, 0.75, 0}), "IfcPipeFitting",
            "IfcTank", {},    "elbow inside a vessel"};
}

// ---- duplicate

Draft twice(ShapeId shape, const Transform& pose, const char* type, const char* what) {
    return {shape, shape, pose, pose, type, type, {}, what};
}

Draft pipe_twice(PlantBuilder& b) {
    return twice(planted_pipe(b, 1.5), along(kZ, {0, kBore, -0.75}), "IfcPipeSegment",
                 "pipe placed twice");
}

Draft beam_twice(PlantBuilder& b) {
    return twice(planted_beam(b), at({-0.75, 0.25, 0}), "IfcBeam", "beam placed twice");
}

Draft tray_twice(PlantBuilder& b) {
    const ShapeId shell = b.shape("planted tray", [] { return tray(1.5, 0.5, 0.125); });
    return twice(shell, at({-0.75, 0, 0}), "IfcCableCarrierSegment", "open shell placed twice");
}

/// The second mesh has the same triangles in reverse order, each starting at a different corner: a
/// different mesh of the same surface.
Draft block_reordered(PlantBuilder& b) {
    const ShapeId first = planted_block(b, 1, 0.5, 0.75);
    const ShapeId second = b.shape("planted block reordered", [&] {
        Shape copy = b.shape(first);
        std::reverse(copy.mesh.triangles.begin(), copy.mesh.triangles.end());
        for (auto& t : copy.mesh.triangles) {
            std::rotate(t.begin(), t.begin() + 1, t.end());
        }
        return copy;
    });
    return {first,
            second,
            at({0, 0, 0}),
            at({0, 0, 0}),
            "IfcFooting",
            "IfcFooting",
            {},
            "block placed twice, its triangles in another order"};
}

// ---- clearance

/// A known gap of this many fifths of the clearance, rounded down to the grid.
double known_gap(const PlantBuilder& b, int fifths) {
    return std::max(1.0, std::floor(b.options.clearance / 5 * fifths / kGrid)) * kGrid;
}

Draft pipe_over_plinth(PlantBuilder& b) {
    const double gap = known_gap(b, 1);
    return {planted_pipe(b, 1),
            planted_block(b, 1.25, 0.125, 0.5),
            at({-0.5, 0.125 + gap + kBore, 0}),
            at({0, 0, 0}),
            "IfcPipeSegment",
            "IfcSlab",
            gap,
            "pipe just above a plinth"};
}

Draft bars_cross_apart(PlantBuilder& b) {
    const double gap = known_gap(b, 2);
    const ShapeId rail = planted_bar(b, 1.5, 0.25, 0.25);
    return {rail,
            rail,
            at({-0.75, 0.125, 0}),
            along(kZ, {0, 0.375 + gap, -0.75}),
            "IfcBeam",
            "IfcBeam",
            gap,
            "beams cross with a small gap"};
}

Draft pipes_cross_apart(PlantBuilder& b) {
    const double gap = known_gap(b, 4);
    const ShapeId line = planted_pipe(b, 1.5);
    return {line,
            line,
            at({-0.75, kBore, 0}),
            along(kZ, {0, 3 * kBore + gap, -0.75}),
            "IfcPipeSegment",
            "IfcPipeSegment",
            gap,
            "pipes cross with a small gap"};
}

Draft duct_beside_column(PlantBuilder& b) {
    const double gap = known_gap(b, 2);
    const ShapeId duct_shape = b.shape("planted duct", [] { return duct(1.5, 0.5, 0.75); });
    return {duct_shape,
            planted_block(b, 0.25, 2, 0.25),
            at({-0.75, 1, 0}),
            at({0, 0, 0.375 + 0.125 + gap}),
            "IfcDuctSegment",
            "IfcColumn",
            gap,
            "duct just beside a column"};
}

Draft tip_over_plinth(PlantBuilder& b) {
    const double gap = known_gap(b, 4);
    const ShapeId tip = b.shape("planted octahedron", [] { return octahedron(0.25); });
    return {tip,           planted_block(b, 1, 0.125, 1), at({0.0625, 0.125 + gap, 0.03125}),
            at({0, 0, 0}), "IfcBuildingElementProxy",     "IfcSlab",
            gap,           "tip just above a plinth"};
}

} // namespace

ShapeId planted_riser(PlantBuilder& b) {
    return planted_pipe(b, 1.5);
}

const std::vector<ClashRecipes>& clash_recipes() {
    static const std::vector<ClashRecipes> all{
        {ClashKind::hard,
         {pipe_through_web, duct_grazes_column, pipe_in_pipe, shallow_crossing,
          brace_through_post}},
        {ClashKind::touch,
         {cabinet_on_plinth, wedge_on_plinth, tip_on_plinth, pipes_end_to_end, ridges_cross}},
        {ClashKind::contained, {bolt_in_tank, box_in_box, elbow_in_vessel}},
        {ClashKind::duplicate, {pipe_twice, beam_twice, tray_twice, block_reordered}},
        {ClashKind::clearance,
         {pipe_over_plinth, bars_cross_apart, pipes_cross_apart, duct_beside_column,
          tip_over_plinth}}};
    return all;
}

} // namespace abut::scenes
