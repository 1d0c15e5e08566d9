#include "scenes/deforming/frame.h"
#include "scenes/shapes.h"

#include <algorithm>
#include <cmath>

namespace abut::scenes {

Shape pipe(double length, double radius, int sides, const PipeEnds& flanges) {
    const double thick = std::min(0.03125, length / 4);
    std::vector<Point2> profile;
    if (flanges.start > 0) {
        profile.insert(profile.end(),
                       {{0, flanges.start}, {thick, flanges.start}, {thick, radius}});
    } else {
        profile.push_back({0, radius});
    }
    if (flanges.end > 0) {
        profile.insert(
            profile.end(),
            {{length - thick, radius}, {length - thick, flanges.end}, {length, flanges.end}});
    } else {
        profile.push_back({length, radius});
    }
    return lathe(profile, sides);
}

Shape tank(double length, double radius, double dish, int sides, int steps) {
    std::vector<Point2> profile{{0, 0}};
    for (int k = 1; k <= steps; ++k) {
        const Point2 c = on_circle(k, 4 * steps);
        profile.push_back({dish * (1 - c.u), radius * c.v});
    }
    for (int k = steps; k > 0; --k) {
        const Point2 c = on_circle(k, 4 * steps);
        profile.push_back({length - dish * (1 - c.u), radius * c.v});
    }
    profile.push_back({length, 0});
    return lathe(profile, sides);
}

Shape bolt(double length, double radius, bool plain) {
    if (plain) {
        return lathe({{0, radius}, {length, radius}}, 6);
    }
    const double nut = length / 4, shank = radius * 0.625;
    return lathe({{0, radius},
                  {nut, radius},
                  {nut, shank},
                  {length - nut, shank},
                  {length - nut, radius},
                  {length, radius}},
                 6);
}

Shape railing(double length, double height) {
    constexpr double kThick = 0.046875;
    Shape whole;
    // The posts are thinner than the rail that they carry. With a common edge, four triangles would
    // share it.
    constexpr double kPost = 0.75 * kThick;
    const Shape post = block(kPost, height - kThick, kPost);
    const int spans = std::max(1, static_cast<int>(length / 1.5));
    for (int k = 0; k <= spans; ++k) {
        append(whole, post, at({kThick / 2 + (length - kThick) * k / spans, 0, 0}));
    }
    append(whole, bar(length, kThick, kThick), at({0, height - kThick / 2, 0}));
    append(whole, bar(length, kThick / 2, kThick / 2),
           at({0, height / 2, (kPost + kThick / 2) / 2}));
    whole.cover = {{{0, 0, -kThick / 2}, {length, height, kThick}}};
    return whole;
}

Shape ladder(double height) {
    constexpr double kThick = 0.046875, kWidth = 0.5;
    Shape whole;
    for (const double side : {-1.0, 1.0}) {
        append(whole, block(kThick, height, kThick), at({side * kWidth / 2, 0, 0}));
    }
    const double clear = kWidth - kThick;
    const Shape rung = bar(clear, 0.03125, 0.03125);
    for (double y = 0.25; y < height - 0.125; y += 0.3125) {
        append(whole, rung, at({-clear / 2, y, 0}));
    }
    whole.cover = {
        {{-(kWidth + kThick) / 2, 0, -kThick / 2}, {(kWidth + kThick) / 2, height, kThick / 2}}};
    return whole;
}

} // namespace abut::scenes
