#include <abut/assembly.h>
#include <abut/broad_phase.h>
#include <abut/error.h>

#include "assembly/pair_timeline.h"
#include "core/arguments.h"
#include "core/parallel.h"
#include "core/progress.h"
#include "core/stop.h"
#include "math/vector.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

namespace abut {

namespace {

/// Rounding of a place and of a gap, as a share of the largest coordinate. It exceeds that of a
/// chain of 1,000 joints, and of loops, whose rounding the transmission divides.
constexpr double kRoundingShare = 1e-11;

/// Rounding of the sine of an angle, as a share of the angle: also of its interpolation.
constexpr double kMotionAngleShare = 1e-15;
/// Rounding of a place at rest, as a share of the coordinates of the model and of the place.
constexpr double kMotionPlaceShare = 1e-14;

/// The values that a motion is computed from. They may be larger than all coordinates of places.
struct MotionSizes {
    double length = 0; ///< of origins, pins, slides and poses
    double angle = 0;  ///< the largest sum of angles along a chain of joints
};

/// The largest size of a joint's value. For one that follows another joint, the sizes of both terms
/// are added, because these are rounded.
double value_size(const Assembly& assembly, const AssemblyJoint& joint) {
    double size = 0;
    if (!joint.follow) {
        for (const double value : joint.keys.values)
            size = std::max(size, std::abs(value));
        return size;
    }
    for (const double value : assembly.parts[joint.follow->part].joint.keys.values)
        size = std::max(size, std::abs(joint.follow->ratio * value));
    return size + std::abs(joint.follow->offset);
}

MotionSizes motion_sizes(const AssemblyKinematics& kinematics) {
    const Assembly& assembly = kinematics.assembly();
    MotionSizes sizes;
    std::vector<double> angles(assembly.parts.size());
    for (const std::uint32_t part : kinematics.order()) {
        const AssemblyPart& p = assembly.parts[part];
        const double value = value_size(assembly, p.joint);
        const bool turns = p.joint.type == AssemblyJointType::revolute;
        angles[part] = (turns ? value : 0) + (p.on ? angles[*p.on] : 0);
        sizes.angle = std::max(sizes.angle, angles[part]);
        sizes.length = std::max({sizes.length, max_abs(p.joint.origin), turns ? 0 : value});
        for (const Pose& pose : p.joint.keys.poses)
            sizes.length = std::max(sizes.length, max_abs(pose.translation));
    }
    for (const AssemblyLoop& loop : assembly.loops)
        sizes.length = std::max(sizes.length, max_abs(loop.pin));
    return sizes;
}

/// A slice in which the swept boxes of two bodies are near.
struct NearSlice {
    IndexPair pair;
    std::uint32_t slice = 0;
    friend bool operator<(const NearSlice& a, const NearSlice& b) {
        return std::tie(a.pair, a.slice) < std::tie(b.pair, b.slice);
    }
};

/// Runs the stages of a query.
class MotionClashSearch {
public:
    MotionClashSearch(const Assembly& assembly, const MotionClashOptions& options)
        : options_(options),
          kinematics_(assembly), moving_{kinematics_, {}, cut_into_slices(kinematics_), 0} {
        std::vector<std::vector<RobotBody>> made(assembly.parts.size());
        parallel_for(made.size(), 1, [&](std::size_t i) {
            const AssemblyPart& part = assembly.parts[i];
            made[i] = make_body(static_cast<std::uint32_t>(i), part.model, part.place);
        });
        for (std::vector<RobotBody>& each : made)
            std::ranges::move(each, std::back_inserter(moving_.bodies));
        for (const auto& [a, b] : assembly.ignored)
            ignored_.push_back(IndexPair(a, b).key());
        std::ranges::sort(ignored_);
    }

    MotionReport run() {
        report_.start = moving_.slices.front().start;
        report_.end = moving_.slices.back().end;
        report_.clearance = options_.clearance;
        report_.tolerance = options_.tolerance;
        report_.slices = moving_.slices.size();
        count_pairs();
        const std::vector<NearSlice> near = find_near_slices();
        follow_pairs(near);
        sort_clashes();
        return std::move(report_);
    }

private:
    enum class Choice : std::uint8_t { tested, still, joined, ignored };

    /// In          indices of bodies.
    [[nodiscard]] Choice choose(std::uint32_t i, std::uint32_t k) const {
        const std::uint32_t a = moving_.bodies[i].owner;
        const std::uint32_t b = moving_.bodies[k].owner;
        if (kinematics_.rigid_group(a) == kinematics_.rigid_group(b))
            return Choice::still;
        if (!options_.joined && kinematics_.are_joined(a, b))
            return Choice::joined;
        if (!ignored_.empty() && std::ranges::binary_search(ignored_, IndexPair(a, b).key()))
            return Choice::ignored;
        return Choice::tested;
    }

    /// Counts without a loop over all pairs, of which there may be very many.
    void count_pairs() {
        const auto pairs_of = [](std::uint64_t count) {
            return count < 2 ? 0 : count * (count - 1) / 2;
        };
        std::map<std::uint32_t, std::uint64_t> groups;
        std::map<std::uint32_t, std::uint32_t> body_of;
        for (std::uint32_t i = 0; i < moving_.bodies.size(); ++i) {
            ++groups[kinematics_.rigid_group(moving_.bodies[i].owner)];
            body_of[moving_.bodies[i].owner] = i;
        }
        report_.pairs = pairs_of(moving_.bodies.size());
        for (const auto& [group, count] : groups)
            report_.still += pairs_of(count);
        std::set<std::uint64_t> special; // keys of pairs that are joined or ignored
        const Assembly& assembly = kinematics_.assembly();
        const auto add = [&](std::uint32_t a, std::uint32_t b) {
            if (a != b && body_of.contains(a) && body_of.contains(b))
                special.insert(IndexPair(body_of[a], body_of[b]).key());
        };
        for (std::uint32_t part = 0; part < assembly.parts.size(); ++part)
            if (assembly.parts[part].on)
                add(part, *assembly.parts[part].on);
        for (const AssemblyLoop& loop : assembly.loops)
            add(loop.coupler, loop.closer);
        for (const auto& [a, b] : assembly.ignored)
            add(a, b);
        for (const std::uint64_t key : special) {
            const IndexPair pair = IndexPair::of_key(key);
            const Choice choice = choose(pair.a(), pair.b());
            report_.joined += choice == Choice::joined ? 1 : 0;
            report_.ignored += choice == Choice::ignored ? 1 : 0;
        }
    }

    std::vector<NearSlice> find_near_slices() {
        const std::size_t count = moving_.slices.size();
        std::vector<std::vector<IndexPair>> pairs(count);
        std::vector<double> largest(count);
        ProgressMeter meter(options_.progress, "sweep", count);
        parallel_for(count, 1, [&](std::size_t s) {
            SliceMotion motion(kinematics_);
            motion.set(moving_.slices[s], kinematics_.order());
            std::vector<Box3> boxes;
            for (const RobotBody& body : moving_.bodies) {
                boxes.push_back(motion.swept_box(body, body.owner_from_model));
                largest[s] = std::max(
                    {largest[s], max_abs(boxes.back().lower), max_abs(boxes.back().upper)});
            }
            const double gap = options_.clearance + 2 * options_.tolerance;
            pairs[s] = overlapping_boxes(boxes, gap, [&](std::uint32_t i, std::uint32_t k) {
                return choose(i, k) == Choice::tested;
            });
            meter.advance();
        });
        moving_.rounding = rounding_of(std::ranges::max(largest));
        require(options_.tolerance > 8 * moving_.rounding,
                "the tolerance is below the rounding of such large coordinates: it must exceed " +
                    std::to_string(8e3 * moving_.rounding) + " mm");
        std::vector<NearSlice> near;
        for (std::uint32_t s = 0; s < count; ++s)
            for (const IndexPair& pair : pairs[s])
                near.push_back({pair, s});
        parallel_sort(near.begin(), near.end());
        return near;
    }

    /// In          largest: of the coordinates of all places.
    [[nodiscard]] double rounding_of(double largest) const {
        const MotionSizes sizes = motion_sizes(kinematics_);
        const bool has_loops = !kinematics_.assembly().loops.empty();
        const double angle = kMotionAngleShare * sizes.angle / (has_loops ? kLeastTransmission : 1);
        double local = 0;
        for (const RobotBody& body : moving_.bodies) {
            const auto& m = body.owner_from_model.m;
            local = std::max({local, max_abs(body.box.lower), max_abs(body.box.upper),
                              max_abs(Vec3{m[9], m[10], m[11]})});
        }
        return (kRoundingShare + angle) * std::max(largest, sizes.length) +
               kMotionPlaceShare * local;
    }

    void follow_pairs(const std::vector<NearSlice>& near) {
        std::vector<std::size_t> starts;
        for (std::size_t i = 0; i < near.size(); ++i)
            if (i == 0 || !(near[i - 1].pair == near[i].pair))
                starts.push_back(i);
        report_.near = starts.size();
        std::vector<std::optional<MotionClash>> clashes(starts.size());
        std::vector<std::uint64_t> steps(starts.size());
        ProgressMeter meter(options_.progress, "pairs", starts.size());
        parallel_for(starts.size(), 1, [&](std::size_t p) {
            const std::size_t end = p + 1 < starts.size() ? starts[p + 1] : near.size();
            std::vector<std::uint32_t> slices;
            for (std::size_t i = starts[p]; i < end; ++i)
                slices.push_back(near[i].slice);
            const IndexPair pair = near[starts[p]].pair;
            PairTimeline timeline(moving_, pair.a(), pair.b(), slices, options_);
            clashes[p] = timeline.run();
            steps[p] = timeline.steps();
            meter.advance();
        });
        for (std::size_t p = 0; p < starts.size(); ++p) {
            report_.steps += steps[p];
            if (clashes[p])
                report_.clashes.push_back(std::move(*clashes[p]));
        }
    }

    void sort_clashes() {
        const auto key = [](const MotionClash& clash) {
            const bool contact = clash.kind == MotionClashKind::contact;
            return std::tuple(!contact, contact ? clash.contacts.front().start : clash.gap, clash.a,
                              clash.b);
        };
        std::ranges::sort(report_.clashes, {}, key);
    }

    const MotionClashOptions& options_;
    AssemblyKinematics kinematics_;
    MovingBodies moving_;
    std::vector<std::uint64_t> ignored_; ///< keys of pairs of parts, sorted
    MotionReport report_;
};

} // namespace

MotionReport find_motion_clashes(const Assembly& assembly, const MotionClashOptions& options) {
    const auto is_length = [](double value) { return value >= 0 && std::isfinite(value); };
    require(is_length(options.clearance), "the clearance must not be negative, and finite");
    require(is_length(options.step), "the step must not be negative, and finite");
    require(is_length(options.tolerance) && options.tolerance > 0,
            "the tolerance must be positive");
    const StopScope stopping(options.progress);
    return MotionClashSearch(assembly, options).run();
}

} // namespace abut
