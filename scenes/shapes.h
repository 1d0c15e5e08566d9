#pragma once

#include <abut/mesh.h>
#include <abut/types.h>

#include <functional>
#include <vector>

/// The shapes that a plant is built from, in metres. Every position is exact as a float. Members,
/// pipes and all turned shapes lie along +x from the origin, centred on the axis. Standing shapes
/// stand on y = 0.
namespace abut::scenes {

/// A mesh, and boxes in its frame that cover it. Other parts are kept out of these boxes.
struct Shape {
    Mesh mesh;
    std::vector<Box3> cover;
    bool closed = true; ///< watertight after equal positions are merged, facing outward
};

/// A point of a profile: (y, z) in the section of a prism, or (position on the axis, radius) for a
/// turned solid.
struct Point2 {
    double u = 0, v = 0;
};

/// Cosine and sine of `k / n` of a full turn. They are exact at quarter turns and the same on every
/// machine.
Point2 on_circle(int k, int n);

/// Adds a copy of `piece`, moved by the transform, to `whole`.
void append(Shape& whole, const Shape& piece, const Transform& whole_from_piece);

// ---- prisms
Shape box(const Box3& bounds);
/// A block that stands on the origin.
Shape block(double size_x, double height, double size_z);
/// A bar along x.
Shape bar(double length, double height, double width);
/// A prism with a simple polygon as section, counter-clockwise in (y, z).
Shape prism(double length, const std::vector<Point2>& section);
Shape i_section(double length, double depth, double width, double web, double flange);
/// A rectangular hollow section with open ends, as in steel construction. The wall is the solid.
Shape hollow_section(double length, double depth, double width, double wall);
/// A plate in x and z between two heights, made of the `solid` cells of a grid. Cells must not meet
/// only at a corner: the solid would be pinched there.
Shape plate(const std::vector<double>& x_cuts, const std::vector<double>& z_cuts, double y_low,
            double y_high, const std::function<bool(std::size_t, std::size_t)>& solid);

// ---- turned solids
/// The solid that a profile sweeps about the x axis. The ends are closed by flat caps, or by the
/// axis where the profile meets it. `ring`: the profile's end joins its start instead.
Shape lathe(const std::vector<Point2>& profile, int sides, bool ring = false);

struct PipeEnds {
    double start = 0, end = 0; ///< radius of the flange there; 0: none
};
Shape pipe(double length, double radius, int sides, const PipeEnds& flanges = {});
/// A quarter bend: it enters at the origin along +x and leaves at (bend, bend, 0) along +y.
Shape elbow(double radius, double bend, int sides, int steps);
/// A cylinder with dished ends, `length` overall.
Shape tank(double length, double radius, double dish, int sides, int steps);
/// A stud with two nuts. `plain`: a bare hexagonal prism.
Shape bolt(double length, double radius, bool plain);

// ---- assembled shapes
/// Posts, hand rail and knee rail in one part.
Shape railing(double length, double height);
Shape ladder(double height);

// ---- sheet metal: open shells
/// A trough: bottom, two sides and their lips.
Shape tray(double length, double width, double height);
Shape duct(double length, double height, double width);
/// Corrugated cladding: `waves` trapezoids over `width` in z, `length` in x.
Shape cladding(double length, double width, double depth, int waves);

// ---- shapes used only by planted clashes
/// A roof-shaped prism along x, with its ridge down, on y = 0.
Shape wedge(double length, double height, double width);
/// Eight faces; the lowest vertex is the origin.
Shape octahedron(double radius);

} // namespace abut::scenes
