#include "suites/box_scene.h"

#include <cmath>

namespace abut::bench {

namespace {

constexpr double kPartners = 10;
constexpr double kClusterBoxes = 1000;
constexpr double kFloors = 10;
constexpr std::size_t kBoxesOfPile = 20;
constexpr std::size_t kManySpanning = 100;
/// Steps from one burst to the next.
constexpr std::size_t kBurst = 5;
/// In a burst, one of this many boxes is replaced.
constexpr std::size_t kBurstShare = 10;

/// Sides vary between half and one and a half times the mean. On average, (a + b)^3 of two sides is
/// about 8.3 and (a + b)^2 about 4.2, in units of the mean side.
double mean_side(BoxLayout layout, std::size_t count) {
    const auto n = static_cast<double>(count);
    if (layout == BoxLayout::heap)
        return 1 / std::ceil(std::cbrt(n));
    if (layout == BoxLayout::planes)
        return std::sqrt(kPartners * kFloors / 4.2 / n);
    // Two partners are in the box's own pile; the others are in three levels of each pile that it
    // meets.
    if (layout == BoxLayout::piles)
        return std::sqrt((kPartners - 2) / 3 * kBoxesOfPile / 4.2 / n);
    return std::cbrt(kPartners / 8.3 / n);
}

} // namespace

BoxScene::BoxScene(BoxLayout layout, std::size_t count, std::uint64_t seed)
    : layout_(layout), random_(seed), side_(mean_side(layout, count)), count_(count) {
    draw_centres();
    for (std::size_t i = 0; i < count; ++i) {
        boxes_.push_back(draw_box(i));
        const double v = (layout == BoxLayout::heap ? 0.002 : 0.02) * side_;
        velocities_.push_back({draw(-v, v), draw(-v, v), draw(-v, v)});
    }
    add_spanning_boxes();
}

void BoxScene::draw_centres() {
    const double each = layout_ == BoxLayout::piles ? double{kBoxesOfPile} : kClusterBoxes;
    centres_.clear();
    for (double n = 0; n < static_cast<double>(count_); n += each)
        centres_.push_back({draw(0, 1), draw(0, 1), draw(0, 1)});
}

void BoxScene::add_spanning_boxes() {
    const std::size_t count = layout_ == BoxLayout::spanned   ? 1
                              : layout_ == BoxLayout::crossed ? kManySpanning
                                                              : 0;
    for (std::size_t i = 0; i < count; ++i)
        boxes_[(2 * i + 1) * boxes_.size() / (2 * count)] = {{0, 0, 0}, {1, 1, 1}};
}

/// Whether boxes keep their heights.
bool BoxScene::stands() const {
    return layout_ == BoxLayout::planes || layout_ == BoxLayout::piles;
}

double BoxScene::draw(double low, double high) {
    return std::uniform_real_distribution(low, high)(random_);
}

Vec3 BoxScene::draw_point(std::size_t index) {
    if (layout_ == BoxLayout::piles) {
        const Vec3& pile = centres_[index / kBoxesOfPile];
        const double x = draw(-0.1, 0.1) * side_, y = draw(-0.1, 0.1) * side_;
        return {pile.x + x, pile.y + y, 0};
    }
    if (layout_ == BoxLayout::heap) {
        const auto row = static_cast<std::size_t>(std::lround(1 / side_));
        const auto along = [&](std::size_t place) {
            return side_ * (static_cast<double>(place) + 0.5 + draw(-0.05, 0.05));
        };
        const double x = along(index % row), y = along(index / row % row);
        return {x, y, along(index / row / row)};
    }
    if (layout_ != BoxLayout::clustered)
        return {draw(0, 1), draw(0, 1), draw(0, 1)};
    const Vec3& centre =
        centres_[std::uniform_int_distribution<std::size_t>(0, centres_.size() - 1)(random_)];
    std::normal_distribution<double> normal(0, side_);
    const double x = normal(random_), y = normal(random_), z = normal(random_);
    return {centre.x + x, centre.y + y, centre.z + z};
}

Box3 BoxScene::draw_box(std::size_t index) {
    const Vec3 p = draw_point(index);
    double side = side_;
    if (layout_ == BoxLayout::clustered) // gives about ten partners within a cluster
        side *= 0.38;
    if (layout_ == BoxLayout::sizes)
        side *= 0.1 * std::pow(1000.0, 0.6 * draw(0, 1) * draw(0, 1));
    if (layout_ == BoxLayout::heap) {
        const double h = 0.5 * side;
        return {{p.x - h, p.y - h, p.z - h}, {p.x + h, p.y + h, p.z + h}};
    }
    const Vec3 h{0.5 * side * draw(0.5, 1.5), 0.5 * side * draw(0.5, 1.5),
                 0.5 * side * draw(0.5, 1.5)};
    if (layout_ == BoxLayout::planes) {
        const double floor = std::floor(kFloors * p.z) / kFloors;
        return {{p.x - h.x, p.y - h.y, floor}, {p.x + h.x, p.y + h.y, floor + h.z}};
    }
    if (layout_ == BoxLayout::piles) {
        const auto level = static_cast<double>(index % kBoxesOfPile);
        return {{p.x - h.x, p.y - h.y, level * side_}, {p.x + h.x, p.y + h.y, (level + 1) * side_}};
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
        if (!stands())
            move(box.lower.z, box.upper.z, v.z);
    }
}

void BoxScene::teleport(std::size_t first, std::size_t stride) {
    for (std::size_t i = first; i < boxes_.size(); i += stride)
        boxes_[i] = draw_box(i);
    add_spanning_boxes();
}

void BoxScene::step(BoxMotion motion) {
    ++steps_;
    const bool now = steps_ % kBurst == 0;
    if (motion == BoxMotion::teleport || (motion == BoxMotion::resets && now)) {
        draw_centres();
        teleport(0, 1);
        return;
    }
    drift();
    if (motion == BoxMotion::bursts && now)
        teleport(steps_ / kBurst % kBurstShare, kBurstShare);
}

} // namespace abut::bench
