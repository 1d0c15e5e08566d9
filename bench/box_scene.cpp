#include "box_scene.h"

#include <algorithm>
#include <cmath>

namespace abut::bench {

namespace {

constexpr double kPartners = 10;
constexpr double kClusterBoxes = 1000;
constexpr double kFloors = 10;

/// Sides vary between half of the mean and one and a half: (a + b)^3 of two of them is about 8.3 on
/// the average, in mean sides, and (a + b)^2 4.2.
double mean_side(BoxLayout layout, std::size_t count) {
    const auto n = static_cast<double>(count);
    if (layout == BoxLayout::planes)
        return std::sqrt(kPartners * kFloors / 4.2 / n);
    return std::cbrt(kPartners / 8.3 / n);
}

} // namespace

BoxScene::BoxScene(BoxLayout layout, std::size_t count, std::uint64_t seed)
    : layout_(layout), random_(seed), side_(mean_side(layout, count)) {
    for (double n = 0; n < static_cast<double>(count); n += kClusterBoxes)
        centres_.push_back({draw(0, 1), draw(0, 1), draw(0, 1)});
    for (std::size_t i = 0; i < count; ++i) {
        boxes_.push_back(draw_box());
        const double v = 0.02 * side_;
        velocities_.push_back({draw(-v, v), draw(-v, v), draw(-v, v)});
    }
    add_spanning_box();
}

void BoxScene::add_spanning_box() {
    if (layout_ == BoxLayout::spanned)
        boxes_[boxes_.size() / 2] = {{0, 0, 0}, {1, 1, 1}};
}

double BoxScene::draw(double low, double high) {
    return std::uniform_real_distribution(low, high)(random_);
}

Vec3 BoxScene::draw_point() {
    if (layout_ != BoxLayout::clustered)
        return {draw(0, 1), draw(0, 1), draw(0, 1)};
    const Vec3& centre =
        centres_[std::uniform_int_distribution<std::size_t>(0, centres_.size() - 1)(random_)];
    std::normal_distribution<double> normal(0, side_);
    const double x = normal(random_), y = normal(random_), z = normal(random_);
    return {centre.x + x, centre.y + y, centre.z + z};
}

Box3 BoxScene::draw_box() {
    const Vec3 p = draw_point();
    double side = side_;
    if (layout_ == BoxLayout::clustered) // a thousand boxes' partners, at a deviation of side_
        side *= 0.38;
    if (layout_ == BoxLayout::sizes)
        side *= 0.1 * std::pow(1000.0, 0.6 * draw(0, 1) * draw(0, 1));
    const Vec3 h{0.5 * side * draw(0.5, 1.5), 0.5 * side * draw(0.5, 1.5),
                 0.5 * side * draw(0.5, 1.5)};
    if (layout_ == BoxLayout::planes) {
        const double floor = std::floor(kFloors * p.z) / kFloors;
        return {{p.x - h.x, p.y - h.y, floor}, {p.x + h.x, p.y + h.y, floor + h.z}};
    }
    return {{p.x - h.x, p.y - h.y, p.z - h.z}, {p.x + h.x, p.y + h.y, p.z + h.z}};
}

void BoxScene::drift() {
    const auto move = [](double& lower, double& upper, double& velocity) {
        if (lower + upper < 0 || lower + upper > 2)
            velocity = std::copysign(velocity, 1 - lower - upper);
        lower += velocity, upper += velocity;
    };
    for (std::size_t i = 0; i < boxes_.size(); ++i) {
        Box3& box = boxes_[i];
        Vec3& v = velocities_[i];
        move(box.lower.x, box.upper.x, v.x);
        move(box.lower.y, box.upper.y, v.y);
        if (layout_ != BoxLayout::planes)
            move(box.lower.z, box.upper.z, v.z);
    }
}

void BoxScene::teleport() {
    std::generate(boxes_.begin(), boxes_.end(), [&] { return draw_box(); });
    add_spanning_box();
}

} // namespace abut::bench
