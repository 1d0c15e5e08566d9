#include "assembly/pair_timeline.h"

#include <abut/penetration.h>
#include <abut/rigid.h>

#include "core/stop.h"
#include "math/vector.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace abut {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// A measured gap may exceed the true one by this share where only contacts are of interest.
constexpr double kGapShare = 0.1;
/// From this many tolerances on, convex hulls suffice.
constexpr double kFar = 16;
/// When the steps are used up, the duration is passed in at least this many more.
constexpr double kCoarseSteps = 2000;
/// Places in an interval at which a contact is looked for, if none was seen.
constexpr int kProbes = 8;
/// The least gap is found to this share, in at most this many measurements.
constexpr double kLeastGapShare = 0.01;
constexpr std::size_t kMostGapSteps = 400;
constexpr std::size_t kLeastGapSteps = 16; ///< of each approach
/// The largest depth is found to this share, in at most this many measurements.
constexpr double kDepthShare = 0.05;
constexpr std::size_t kMostDepthSteps = 32;
/// Limits the work of one depth, which then has a looser bound.
constexpr std::uint64_t kMostPenetrationSteps = 20'000;
/// Of pairs with more contacts than this, the depth is not bounded.
constexpr std::size_t kMostDepthContacts = 16;
constexpr std::size_t kMostSamples = 400; ///< of a result

} // namespace

PairTimeline::PairTimeline(const MovingBodies& moving, std::uint32_t a, std::uint32_t b,
                           std::span<const std::uint32_t> slices, const MotionClashOptions& options)
    : moving_(moving), a_(moving.bodies[a]), b_(moving.bodies[b]), options_(options),
      needed_(moving.kinematics.needed_for(a_.owner, b_.owner)),
      displacements_(moving.kinematics.size()) {
    const double duration = moving.slices.back().end - moving.slices.front().start;
    step_ = options.step > 0 ? options.step : 1e-3 * duration;
    SliceMotion motion(moving.kinematics);
    for (const std::uint32_t slice : slices) {
        poll_stop();
        motion.set(moving.slices[slice], needed_);
        slices_.push_back({moving.slices[slice], motion.relative_speed(a_, b_)});
    }
    approaches_.gap = options.clearance;
}

std::optional<MotionClash> PairTimeline::run() {
    for (std::size_t i = 0; i < slices_.size(); ++i) {
        if (i > 0 && slices_[i - 1].time.end != slices_[i].time.start)
            for (Level* const level : {&contacts_, &approaches_})
                close(*level, slices_[i - 1].time.end);
        scan(slices_[i]);
    }
    for (Level* const level : {&contacts_, &approaches_})
        close(*level, slices_.back().time.end);
    std::ranges::sort(samples_, {}, &TimeValue::time);
    const auto same_time = [](const TimeValue& a, const TimeValue& b) { return a.time == b.time; };
    samples_.erase(std::unique(samples_.begin(), samples_.end(), same_time), samples_.end());
    search_approaches();
    if (contacts_.found.empty() && approaches_.found.empty())
        return std::nullopt;
    return clash();
}

void PairTimeline::place(double time) {
    moving_.kinematics.place(time, needed_, displacements_);
    place_a_ = compose(displacements_[a_.owner], a_.owner_from_model);
    place_b_ = compose(displacements_[b_.owner], b_.owner_from_model);
}

PairTimeline::Measured PairTimeline::measure(double time, double far) {
    ++steps_;
    place(time);
    const double level = options_.clearance;
    const auto bound = [&](double at_least) {
        return Measured{time, kInfinity, at_least - moving_.rounding, {}, {}};
    };
    const Vec3 centre_a = apply(displacements_[a_.owner], a_.centre);
    const Vec3 centre_b = apply(displacements_[b_.owner], b_.centre);
    const double ball_gap = length(centre_b - centre_a) - a_.radius - b_.radius;
    // Rough bounds suffice, unless the gap itself is wanted or the tolerance has become large.
    const bool is_rough = far < kInfinity && steps_ <= options_.max_steps;
    const double rough = std::max(std::min(a_.radius, b_.radius), kFar * options_.tolerance);
    if (ball_gap > far || (is_rough && ball_gap > level + rough))
        return bound(ball_gap);
    const double hull_gap = abut::distance(a_.hull, place_a_, b_.hull, place_b_).at_least;
    if (hull_gap > far || (is_rough && hull_gap > level + kFar * options_.tolerance))
        return bound(hull_gap);
    DistanceOptions asked{.upper_bound = far, .warm_start = &warm_start_};
    if (level == 0)
        asked.relative_error = kGapShare;
    const Gap gap = distance(a_.model, place_a_, b_.model, place_b_, asked);
    if (gap.distance > 0 &&
        (is_inside(a_, place_a_, b_, place_b_) || is_inside(b_, place_b_, a_, place_a_))) {
        const Vec3 inner = centre_a;
        return {time, 0, 0, inner, inner};
    }
    if (gap.status == Status::bound_only)
        return bound(gap.at_least);
    return {time, gap.distance, std::max(0.0, gap.at_least - moving_.rounding), gap.point_a,
            gap.point_b};
}

double PairTimeline::touch(const PairSlice& slice) const {
    if (steps_ < options_.max_steps)
        return options_.tolerance;
    const double duration = moving_.slices.back().end - moving_.slices.front().start;
    return std::max(options_.tolerance, slice.speed * duration / kCoarseSteps);
}

double PairTimeline::near_step() const {
    if (steps_ < options_.max_steps)
        return step_;
    const double duration = moving_.slices.back().end - moving_.slices.front().start;
    return std::max(step_, duration / kCoarseSteps);
}

void PairTimeline::scan(const PairSlice& slice) {
    const double level = options_.clearance;
    const double end = slice.time.end;
    double time = slice.time.start;
    while (true) {
        poll_stop();
        const double reach = level + slice.speed * (end - time);
        const double tolerance = touch(slice);
        const Measured at = measure(time, reach + 2 * tolerance);
        note(at, slice);
        if (time >= end)
            return;
        double step = kInfinity;
        if (at.gap > level + tolerance) {
            if (at.at_least > reach)
                return; // free until the end
            step = (at.at_least - level) / slice.speed;
        } else {
            step = near_step();
            if (at.gap > tolerance && slice.speed > 0)
                step = std::min(step, at.at_least / slice.speed);
        }
        const double next = std::min(time + step, end);
        time = next > time ? next : std::nextafter(time, kInfinity);
    }
}

void PairTimeline::note(const Measured& at, const PairSlice& slice) {
    if (at.gap <= options_.clearance + touch(slice))
        samples_.push_back({at.time, at.gap, at.at_least});
    note(contacts_, at, slice);
    if (options_.clearance > 0)
        note(approaches_, at, slice);
}

void PairTimeline::note(Level& level, const Measured& at, const PairSlice& slice) {
    if (at.gap <= level.gap + touch(slice)) {
        if (!level.is_open)
            level.found.push_back({at.time, at.time, kInfinity});
        level.is_open = true;
        level.last = at.time;
        if (at.gap == 0 && level.found.back().seen == kInfinity)
            level.found.back().seen = at.time;
    } else if (level.is_open) {
        close(level, find_end(level, at, slice));
    }
}

double PairTimeline::find_end(Level& level, Measured free, const PairSlice& slice) {
    while (free.time > level.last) {
        poll_stop();
        const double way = free.at_least - level.gap;
        const double time = slice.speed > 0 ? free.time - way / slice.speed : level.last;
        if (time <= level.last || !(time < free.time))
            break;
        const Measured at =
            measure(time, level.gap + slice.speed * (time - level.last) + 2 * touch(slice));
        if (at.gap <= options_.clearance + touch(slice))
            samples_.push_back({at.time, at.gap, at.at_least});
        if (at.gap <= level.gap + touch(slice))
            return time;
        free = at;
    }
    return level.last;
}

void PairTimeline::close(Level& level, double time) {
    if (level.is_open)
        level.found.back().end = time;
    level.is_open = false;
}

double PairTimeline::way_between(double from, double to) const {
    auto slice =
        std::ranges::lower_bound(slices_, from, {}, [](const PairSlice& s) { return s.time.end; });
    double way = 0;
    for (; slice != slices_.end() && slice->time.start < to; ++slice)
        way += slice->speed * (std::min(to, slice->time.end) - std::max(from, slice->time.start));
    return way;
}

MotionClash PairTimeline::clash() {
    MotionClash clash;
    clash.a = a_.owner;
    clash.b = b_.owner;
    clash.contacts = contacts_.found;
    clash.approaches = approaches_.found;
    find_proofs(clash);
    find_least_gap(clash);
    if (!clash.contacts.empty())
        find_depth(clash);
    const std::size_t stride = 1 + samples_.size() / kMostSamples;
    for (std::size_t i = 0; i < samples_.size(); ++i)
        if (i % stride == 0 || i + 1 == samples_.size() || samples_[i].time == clash.gap_time)
            clash.samples.push_back({samples_[i].time, samples_[i].value});
    clash.steps = steps_;
    return clash;
}

/// Looks for a common point in each contact where none was seen.
void PairTimeline::find_proofs(MotionClash& clash) {
    for (MotionInterval& contact : clash.contacts) {
        for (int i = 0; i < kProbes && contact.seen == kInfinity; ++i) {
            const double time = contact.start + (i + 0.5) / kProbes * (contact.end - contact.start);
            if (measure(time, options_.clearance + options_.tolerance).gap == 0)
                contact.seen = time;
        }
        if (contact.seen == kInfinity)
            clash.status = Status::bound_only;
    }
    clash.kind = clash.contacts.empty() ? MotionClashKind::clearance : MotionClashKind::contact;
}

/// Finds the least gap of each approach. Drops those that stay beyond the clearance: the scan looks
/// for gaps a little above it, so that it misses none below. An approach whose search ended too
/// early to prove that is kept.
void PairTimeline::search_approaches() {
    const auto gap_at = [&](double time) {
        const Measured at = measure(time, kInfinity);
        return TimeValue{time, at.gap, at.at_least};
    };
    const auto change = [&](double from, double to) { return way_between(from, to); };
    const std::size_t most = std::max(
        kLeastGapSteps, kMostGapSteps / std::max<std::size_t>(1, approaches_.found.size()));
    least_ = {0, kInfinity, kInfinity};
    std::vector<MotionInterval> found;
    for (MotionInterval& near : approaches_.found) {
        TimeSearch search(gap_at, change);
        const TimeValue* before = nullptr;
        auto sample = std::ranges::lower_bound(samples_, near.start, {}, &TimeValue::time);
        for (; sample != samples_.end() && sample->time <= near.end; ++sample) {
            search.add(before == nullptr ? *sample : *before, *sample);
            before = &*sample;
        }
        if (search.best().value > 0) // no gap is less than 0
            search.run(options_.tolerance, kLeastGapShare, most);
        const double at_least = std::min(least_.at_least, search.at_least());
        least_.at_least = at_least; // a dropped approach counts too
        if (search.best().value > options_.clearance &&
            search.at_least() >= (1 - 2 * kLeastGapShare) * options_.clearance - options_.tolerance)
            continue;
        near.seen = search.best().time;
        found.push_back(near);
        if (search.best().value < least_.value)
            least_ = search.best();
        least_.at_least = at_least;
    }
    approaches_.found = std::move(found);
}

void PairTimeline::find_least_gap(MotionClash& clash) {
    const auto seen = std::ranges::find_if(
        clash.contacts, [](const MotionInterval& each) { return each.seen < kInfinity; });
    if (seen != clash.contacts.end()) {
        clash.gap_time = seen->seen;
    } else if (!clash.contacts.empty()) {
        clash.gap_time = clash.contacts.front().start;
    } else {
        clash.gap_time = least_.time;
        clash.gap_at_least = std::max(0.0, least_.at_least);
    }
    const Measured at = measure(clash.gap_time, kInfinity);
    clash.gap = at.gap;
    clash.point_a = at.point_a;
    clash.point_b = at.point_b;
}

void PairTimeline::find_depth(MotionClash& clash) {
    double deepest = 0;
    // Depths are negative, because the search looks for the least value.
    const auto depth_at = [&](double time) {
        ++steps_;
        place(time);
        const Depth depth = penetration(a_.model, place_a_, b_.model, place_b_,
                                        {.relative_error = kDepthShare,
                                         .separation = false,
                                         .max_steps = kMostPenetrationSteps});
        if (depth.depth > deepest) {
            deepest = depth.depth;
            clash.depth_time = time;
            clash.depth_point = depth.point_b;
        }
        return TimeValue{time, -depth.depth, -depth.depth_at_most};
    };
    clash.depth_time = clash.gap_time;
    clash.depth_point = clash.point_b;
    TimeSearch search(depth_at, [&](double from, double to) { return way_between(from, to); });
    const std::size_t count = std::min(clash.contacts.size(), kMostDepthContacts);
    for (std::size_t i = 0; i < count; ++i) {
        const MotionInterval& contact = clash.contacts[i];
        const TimeValue first = depth_at(contact.start);
        search.add(first, contact.end > contact.start ? depth_at(contact.end) : first);
    }
    search.run(options_.tolerance, kDepthShare, kMostDepthSteps);
    clash.depth = deepest;
    const bool is_bounded =
        (a_.is_solid || b_.is_solid) && clash.contacts.size() <= kMostDepthContacts;
    clash.depth_at_most = is_bounded ? std::max(deepest, -search.at_least()) : kInfinity;
}

} // namespace abut
