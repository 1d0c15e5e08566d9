#include <abut/carry.h>

#include "core/arguments.h"
#include "core/stop.h"
#include "math/transform.h"
#include "rigid/shapes/shape_arguments.h"
#include "view/walker/clip_planes.h"
#include "walk/probe.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace abut {

namespace {

/// The pose of a motion at a time.
Pose pose_at(const Motion& motion, double t) {
    const Transform then = at(motion, t);
    const double rate = length(motion.angular_velocity), half = 0.5 * rate * t;
    const Vec3 v = rate > 0 ? (std::sin(half) / rate) * motion.angular_velocity : Vec3{};
    const double w = std::cos(half);
    const auto& r = motion.start.rotation;
    const Vec3 u{r[1], r[2], r[3]};
    const Vec3 turned = w * u + r[0] * v + cross(v, u);
    return {{then.m[9], then.m[10], then.m[11]},
            {w * r[0] - dot(v, u), turned.x, turned.y, turned.z}};
}

} // namespace

class CarryData {
public:
    CarryData(Walk& walk, WalkPart part)
        : walk_(walk), part_(part), carried_(carried_part(walk, part)), probe_(carried_.model) {
        const Box3& box = probe_.data().own_bounds();
        middle_ = is_empty(box) ? Vec3{} : 0.5 * box.lower + 0.5 * box.upper;
        reach_ = reach_from(probe_.data().shape(), box, middle_);
        step_.pose = carried_.pose;
        WalkQuery query;
        query.except = part;
        held_ = walk.collide(probe_, step_.pose, query).parts;
    }

    void move_to(const Pose& pose, const CarryOptions& options) {
        require_point(pose.translation, "pose");
        require_not_negative(options.clearance, "clearance");
        require_not_negative(options.skin, "skin");
        const StopScope stopping(options.progress);
        const Transform checked(pose);
        static_cast<void>(walk_.world_from_part(part_)); // throws if it was removed
        options_ = options;
        step_ = CarryStep{.pose = step_.pose, .contacts = {}, .touched = {}, .near = {}};
        if (options.mode == CarryMode::through)
            step_.pose = pose;
        else
            go(pose);
        walk_.move(part_, carried_.world_from_part(step_.pose));
        look_around();
    }

    [[nodiscard]] WalkPart part() const { return part_; }
    [[nodiscard]] const CarriedPart& carried() const { return carried_; }
    [[nodiscard]] const Probe& probe() const { return probe_; }
    [[nodiscard]] const CarryStep& state() const { return step_; }

private:
    [[nodiscard]] WalkQuery query() const {
        WalkQuery query;
        query.except = part_;
        query.missing = options_.missing;
        return query;
    }
    [[nodiscard]] bool is_held_by(WalkPart part) const {
        return std::binary_search(held_.begin(), held_.end(), part);
    }
    [[nodiscard]] Vec3 middle_at(const Pose& pose) const { return apply(Transform(pose), middle_); }
    /// The pose with another rotation whose middle is at a place.
    [[nodiscard]] Pose placed_at(const Vec3& middle, const std::array<double, 4>& rotation) const {
        const Vec3 from_origin = apply(Transform(Pose{{}, rotation}), middle_);
        return {middle - from_origin, rotation};
    }

    void go(const Pose& pose) {
        const Vec3 goal = middle_at(pose);
        ClipPlanes planes;
        bool is_free = advance(pose, planes);
        if (options_.mode == CarryMode::stop)
            return;
        while (!is_free && !step_.waits && !planes.full()) {
            const Vec3 middle = middle_at(step_.pose);
            const Vec3 way = planes.clipped(goal - middle);
            if (!(length(way) > options_.skin))
                break;
            is_free = advance(placed_at(middle + way, step_.pose.rotation), planes);
        }
        if (!is_free && !step_.waits) // turns where it is
            (void)advance(placed_at(middle_at(step_.pose), pose.rotation), planes);
    }

    /// Goes towards a pose up to the first contact. Returns whether it has got there.
    bool advance(const Pose& pose, ClipPlanes& planes) {
        const Motion motion = Motion::between(step_.pose, pose, middle_);
        const double way = length(motion.velocity) + length(motion.angular_velocity) * reach_;
        if (!(way > 0))
            return true;
        WalkQuery in_way = query();
        if (options_.skin > 0)
            in_way.absolute_error = 0.1 * options_.skin;
        const PartsInWay found = walk_.parts_in_way(probe_, motion, in_way);
        const auto first = std::ranges::find_if(
            found.parts, [&](const PartImpact& impact) { return !is_held_by(impact.part); });
        const double contact = first != found.parts.end() ? first->time : 1;
        const double unknown = found.complete ? 1 : found.time_free;
        const double back = options_.skin / way;
        if (first == found.parts.end() && found.complete) {
            step_.pose = pose;
            return true;
        }
        if (!found.complete && unknown < contact) {
            step_.waits = true;
        } else {
            step_.blocked = true;
            step_.contacts.push_back(*first);
            planes.add(first->normal);
        }
        double time = std::max(0.0, std::min(contact, unknown) - back);
        // The pose is rounded: it must not touch what the motion does not touch.
        for (int halvings = 0; time > 0 && touches(pose_at(motion, time)); ++halvings)
            time = halvings < 8 ? 0.5 * time : 0;
        if (time > 0)
            step_.pose = pose_at(motion, time);
        return false;
    }

    [[nodiscard]] bool touches(const Pose& pose) {
        const TouchedParts touched = walk_.collide(probe_, pose, query());
        return std::ranges::any_of(touched.parts, [&](WalkPart part) { return !is_held_by(part); });
    }

    void look_around() {
        const NearParts near = walk_.within(probe_, step_.pose, options_.clearance, query());
        step_.complete = near.complete;
        for (const WalkGap& gap : near.parts)
            (gap.distance > 0 ? step_.near : step_.touched).push_back(gap);
        std::erase_if(held_, [&](WalkPart part) {
            return near.complete &&
                   std::ranges::find(step_.touched, part, &WalkGap::part) == step_.touched.end();
        });
        if (options_.mode == CarryMode::through)
            for (const WalkGap& gap : step_.touched) // they do not hold it when the mode changes
                if (!is_held_by(gap.part))
                    held_.insert(std::lower_bound(held_.begin(), held_.end(), gap.part), gap.part);
        if (options_.depths && !step_.touched.empty()) {
            WalkQuery deep = query();
            deep.max_steps = options_.depth_steps;
            step_.touched = walk_.penetration(probe_, step_.pose, deep).parts;
        }
    }

    Walk& walk_;
    WalkPart part_;
    CarriedPart carried_;
    Probe probe_;
    Vec3 middle_; ///< of the probe's box, in its frame
    double reach_ = 0;
    CarryOptions options_;
    std::vector<WalkPart> held_; ///< parts that it touched when it was taken, sorted
    CarryStep step_;
};

Carry::Carry(Walk& walk, WalkPart part) : data_(std::make_unique<CarryData>(walk, part)) {}
Carry::~Carry() = default;
Carry::Carry(Carry&&) noexcept = default;
Carry& Carry::operator=(Carry&&) noexcept = default;

const CarryStep& Carry::move_to(const Pose& pose, const CarryOptions& options) {
    data_->move_to(pose, options);
    return data_->state();
}
WalkPart Carry::part() const {
    return data_->part();
}
const CarriedPart& Carry::carried() const {
    return data_->carried();
}
const Probe& Carry::probe() const {
    return data_->probe();
}
const CarryStep& Carry::state() const {
    return data_->state();
}

} // namespace abut
