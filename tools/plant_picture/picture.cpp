/// Draws a procedural plant as a binary PPM on standard output, with a z-buffer, a sun with its
/// shadow, and four samples for each pixel. It makes a picture for the README and is not a viewer.
#include "scenes/plant/plant.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

namespace {

using abut::Vec3;

Vec3 operator+(const Vec3& a, const Vec3& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
Vec3 operator-(const Vec3& a, const Vec3& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
Vec3 operator*(const Vec3& a, double s) {
    return {a.x * s, a.y * s, a.z * s};
}
double dot(const Vec3& a, const Vec3& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
Vec3 cross(const Vec3& a, const Vec3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
Vec3 unit(const Vec3& a) {
    return a * (1 / std::sqrt(dot(a, a)));
}

struct Triangle {
    std::array<Vec3, 3> p;
    Vec3 colour;
};

/// The directions right, up and forward of a viewer who looks along `forward`.
struct View {
    explicit View(const Vec3& direction)
        : forward(unit(direction)), right(unit(cross(forward, {0, 1, 0}))),
          up(cross(right, forward)) {}
    Vec3 forward, right, up;
    [[nodiscard]] Vec3 seen(const Vec3& v) const {
        return {dot(v, right), dot(v, up), dot(v, forward)};
    }
};

/// A rectangular depth buffer; larger values are nearer.
struct Depths {
    Depths(int w, int h, float far)
        : width(w), height(h), at(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), far) {}
    int width, height;
    std::vector<float> at;
    float& operator()(int x, int y) {
        return at[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(x)];
    }
};

/// Visits the pixels of a triangle where it is nearer than the current depth.
template <class Visit>
void draw(Depths& depths, const std::array<Vec3, 3>& q, Visit visit) {
    const double area =
        (q[1].x - q[0].x) * (q[2].y - q[0].y) - (q[1].y - q[0].y) * (q[2].x - q[0].x);
    if (area == 0) {
        return;
    }
    const auto [x0, x1] = std::minmax({q[0].x, q[1].x, q[2].x});
    const auto [y0, y1] = std::minmax({q[0].y, q[1].y, q[2].y});
    const int left = static_cast<int>(std::max(0.0, x0)),
              right = static_cast<int>(std::min(depths.width - 1.0, x1));
    const int low = static_cast<int>(std::max(0.0, y0)),
              high = static_cast<int>(std::min(depths.height - 1.0, y1));
    for (int y = low; y <= high; ++y) {
        for (int x = left; x <= right; ++x) {
            const double px = x + 0.5, py = y + 0.5;
            const double a = ((q[1].x - px) * (q[2].y - py) - (q[1].y - py) * (q[2].x - px)) / area;
            const double b = ((q[2].x - px) * (q[0].y - py) - (q[2].y - py) * (q[0].x - px)) / area;
            const double depth = a * q[0].z + b * q[1].z + (1 - a - b) * q[2].z;
            if (a >= 0 && b >= 0 && a + b <= 1 && depth > depths(x, y)) {
                depths(x, y) = static_cast<float>(depth);
                visit(x, y, depth);
            }
        }
    }
}

std::vector<Triangle> coloured(const abut::Scene& scene) {
    const Vec3 steel{.72, .32, .21}, concrete{.66, .66, .64}, pipe{.53, .67, .78},
        safety{.92, .76, .16};
    const std::map<std::string, Vec3> colours{{"IfcBeam", steel},
                                              {"IfcColumn", steel},
                                              {"IfcMember", {.74, .47, .2}},
                                              {"IfcSlab", concrete},
                                              {"IfcFooting", concrete},
                                              {"IfcChimney", {.82, .8, .76}},
                                              {"IfcPipeSegment", pipe},
                                              {"IfcPipeFitting", {.43, .59, .74}},
                                              {"IfcTank", {.86, .87, .84}},
                                              {"IfcRailing", safety},
                                              {"IfcStairFlight", safety},
                                              {"IfcPlate", {.55, .63, .66}},
                                              {"IfcPump", {.2, .45, .5}},
                                              {"IfcElectricMotor", {.2, .35, .6}},
                                              {"IfcDuctSegment", {.75, .78, .8}}};
    std::vector<Triangle> result;
    for (const abut::Part& part : scene.parts) {
        const auto colour = colours.find(part.type);
        const auto& m = part.world_from_mesh.m;
        for (const auto& t : scene.meshes[part.mesh].triangles) {
            Triangle& moved = result.emplace_back();
            moved.colour = colour == colours.end() ? Vec3{.5, .5, .5} : colour->second;
            for (std::size_t k = 0; k < 3; ++k) {
                const Vec3& p = scene.meshes[part.mesh].positions[t[k]];
                moved.p[k] = Vec3{m[0], m[1], m[2]} * p.x + Vec3{m[3], m[4], m[5]} * p.y +
                             Vec3{m[6], m[7], m[8]} * p.z + Vec3{m[9], m[10], m[11]};
            }
        }
    }
    return result;
}

} // namespace

int main() {
    constexpr int kSamples = 2, kWidth = 1000 * kSamples, kHeight = 500 * kSamples, kShadow = 5000;
    constexpr double kFocus = 1.3 * kHeight, kShadowScale = kShadow / 190.0;
    const std::vector<Triangle> triangles =
        coloured(abut::make_plant({.triangles = 300'000, .seed = 1}).scene);
    const Vec3 eye{-20, 19, -40}, target{24, 6.5, 4}, centre{40, 0, 0};
    const View view(target - eye), sun({.45, -.8, .55});
    const auto in_shadow_map = [&](const Vec3& p) {
        const Vec3 q = sun.seen(p - centre);
        return Vec3{q.x * kShadowScale + kShadow / 2.0, q.y * kShadowScale + kShadow / 2.0, -q.z};
    };
    Depths shadow(kShadow, kShadow, -1e9F), depths(kWidth, kHeight, 0);
    for (const Triangle& t : triangles) {
        draw(shadow, {in_shadow_map(t.p[0]), in_shadow_map(t.p[1]), in_shadow_map(t.p[2])},
             [](int, int, double) {});
    }
    std::vector<Vec3> image;
    for (int y = 0; y < kHeight; ++y) {
        const double k = static_cast<double>(y) / kHeight;
        image.insert(image.end(), kWidth, {.66 + .24 * k, .78 + .15 * k, .92 + .05 * k});
    }
    for (const Triangle& t : triangles) {
        std::array<Vec3, 3> q;
        double nearest = 1e9;
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3 p = view.seen(t.p[k] - eye);
            nearest = std::min(nearest, p.z);
            q[k] = {kWidth / 2.0 + kFocus * p.x / p.z, kHeight / 2.0 - kFocus * p.y / p.z, 1 / p.z};
        }
        const Vec3 normal = cross(t.p[1] - t.p[0], t.p[2] - t.p[0]);
        if (nearest < 0.5 || dot(normal, normal) == 0) {
            continue; // the eye is outside the plant, so only ground behind the eye needs
                      // clipping
        }
        const Vec3 n = unit(normal) * (dot(normal, eye - t.p[0]) < 0 ? -1 : 1);
        draw(depths, q, [&](int x, int y, double inverse) {
            const Vec3 p = eye + (view.forward + view.right * ((x + .5 - kWidth / 2.0) / kFocus) +
                                  view.up * ((kHeight / 2.0 - y - .5) / kFocus)) *
                                     (1 / inverse);
            double light = std::max(0.0, -dot(n, sun.forward));
            const Vec3 s = in_shadow_map(p + n * 0.04);
            if (s.x >= 0 && s.y >= 0 && s.x < kShadow && s.y < kShadow &&
                shadow(static_cast<int>(s.x), static_cast<int>(s.y)) > s.z + 0.06) {
                light = 0;
            }
            image[static_cast<std::size_t>(y) * kWidth + static_cast<std::size_t>(x)] =
                t.colour * (.44 + .15 * n.y + .06 * n.x + .6 * light);
        });
    }
    std::printf("P6\n%d %d\n255\n", kWidth / kSamples, kHeight / kSamples);
    for (int y = 0; y < kHeight; y += kSamples) {
        for (int x = 0; x < kWidth; x += kSamples) {
            Vec3 sum;
            for (int k = 0; k < kSamples * kSamples; ++k) {
                sum = sum + image[static_cast<std::size_t>(y + k / kSamples) * kWidth +
                                  static_cast<std::size_t>(x + k % kSamples)];
            }
            for (const double c : {sum.x, sum.y, sum.z}) {
                std::putchar(static_cast<int>(std::min(255.0, c * 255 / (kSamples * kSamples))));
            }
        }
    }
}
