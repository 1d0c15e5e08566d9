#include <abut/maintenance_path.h>

#include "clash/report/json_lines.h"
#include "core/arguments.h"
#include "core/stop.h"
#include "math/transform.h"
#include "walk/path_clearance.h"
#include "walk/probe.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace abut {

namespace {

class PathCheck {
public:
    PathCheck(Walk& walk, const Probe& probe, std::span<const Pose> poses,
              const PathOptions& options)
        : walk_(walk), probe_(probe), options_(options) {
        const Box3& box = probe.data().own_bounds();
        const Vec3 middle = is_empty(box) ? Vec3{} : 0.5 * box.lower + 0.5 * box.upper;
        const double reach = reach_from(probe.data().shape(), box, middle);
        if (poses.size() == 1)
            add(Motion::fixed(poses[0]), reach);
        for (std::size_t i = 1; i < poses.size(); ++i)
            add(Motion::between(poses[i - 1], poses[i], middle), reach);
        report_.poses = poses.size();
    }

    PathReport run() {
        for (std::size_t i = 0; i < motions_.size(); ++i) {
            poll_stop();
            if (options_.progress.report)
                options_.progress.report("path", double(i) / double(motions_.size()));
            check(i);
        }
        for (const auto& [part, contact] : first_)
            report_.contacts.push_back(contact);
        std::ranges::stable_sort(report_.contacts, {}, &PathContact::time);
        measure_clearance();
        return std::move(report_);
    }

private:
    void add(const Motion& motion, double reach) {
        motions_.push_back(motion);
        report_.length += length(motion.velocity);
        speeds_.push_back((1 + 0x1p-40) *
                          (length(motion.velocity) + length(motion.angular_velocity) * reach));
    }

    void check(std::size_t i) {
        WalkQuery query;
        query.except = options_.except;
        query.absolute_error = options_.absolute_error;
        std::set<WalkPart> touching;
        for (const PartImpact& impact : walk_.parts_in_way(probe_, motions_[i], query).parts) {
            const bool touches = impact.time == 0 && impact.gap == 0;
            if (touches && (i == 0 || still_.contains(impact.part)))
                touching.insert(impact.part);
            else
                first_.try_emplace(impact.part, PathContact{double(i) + impact.time, impact});
        }
        still_ = std::move(touching);
        if (i == 0)
            report_.touched_at_start.assign(still_.begin(), still_.end());
    }

    void measure_clearance() {
        if (report_.contacts.empty()) {
            report_.clearance = least_clearance(walk_, probe_, motions_, speeds_,
                                                report_.touched_at_start, options_);
            return;
        }
        const PathContact& first = report_.contacts.front();
        report_.clearance = {true,
                             0,
                             0,
                             first.time,
                             first.impact.part,
                             first.impact.point_part,
                             first.impact.point_probe};
    }

    Walk& walk_;
    const Probe& probe_;
    const PathOptions& options_;
    std::vector<Motion> motions_;
    std::vector<double> speeds_;
    std::set<WalkPart> still_; ///< touched at the start, and at each pose since
    std::map<WalkPart, PathContact> first_;
    PathReport report_;
};

nlohmann::ordered_json json_part(WalkPart part, Walk& walk) {
    const WalkPartName name = walk.name(part);
    return {{"part", part.number},
            {"file", name.file},
            {"id", name.id},
            {"name", name.name},
            {"type", name.type}};
}

} // namespace

Transform CarriedPart::world_from_part(const Pose& at) const {
    return compose(at, linear);
}

CarriedPart carried_part(Walk& walk, WalkPart part) {
    Transform linear = walk.world_from_part(part);
    const Vec3 origin{linear.m[9], linear.m[10], linear.m[11]};
    linear.m[9] = linear.m[10] = linear.m[11] = 0;
    const Model model = walk.model(part);
    if (linear == Transform())
        return {model, Pose{origin}, linear};
    Mesh mesh = model.mesh();
    for (Vec3& p : mesh.positions)
        p = apply(linear, p);
    return {Model(std::move(mesh)), Pose{origin}, linear};
}

PathReport check_path(Walk& walk, const Probe& probe, std::span<const Pose> poses,
                      const PathOptions& options) {
    require(!poses.empty(), "a path needs a pose");
    require_not_negative(options.largest_clearance, "largest clearance");
    require_not_negative(options.clearance_error, "clearance error");
    require(options.largest_clearance < 1e18, "largest clearance must be finite");
    const StopScope stopping(options.progress);
    return PathCheck(walk, probe, poses, options).run();
}

PathReport check_path(Walk& walk, WalkPart part, std::span<const Pose> poses, PathOptions options) {
    options.except = part;
    return check_path(walk, carried_part(walk, part).model, poses, options);
}

std::string to_json(const PathReport& report, Walk& walk) {
    using Json = nlohmann::ordered_json;
    Json contacts = Json::array(), touched = Json::array();
    for (const PathContact& contact : report.contacts) {
        Json one = json_part(contact.impact.part, walk);
        one["time"] = json_number(contact.time);
        one["point"] = json_point(contact.impact.point_part);
        one["normal"] = json_point(contact.impact.normal);
        contacts.push_back(std::move(one));
    }
    for (const WalkPart part : report.touched_at_start)
        touched.push_back(json_part(part, walk));
    Json clearance{{"at_least", json_number(report.clearance.at_least)}};
    if (report.clearance.found) {
        clearance["distance"] = json_number(report.clearance.distance);
        clearance["time"] = json_number(report.clearance.time);
        clearance.update(json_part(report.clearance.part, walk));
        clearance["point_part"] = json_point(report.clearance.point_part);
        clearance["point_carried"] = json_point(report.clearance.point_probe);
    }
    const Json all{{"free", report.is_free()},
                   {"poses", report.poses},
                   {"length", json_number(report.length)},
                   {"contacts", contacts},
                   {"clearance", clearance},
                   {"touched_at_start", touched}};
    return all.dump(2, ' ', false, Json::error_handler_t::replace);
}

} // namespace abut
