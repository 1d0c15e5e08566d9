#include "toolbox/event_log.h"

#include <abut/error.h>

#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

namespace abut::viewer {

namespace {

using LogLine = nlohmann::ordered_json;

LogLine log_point(const Vec3& p) {
    return {p.x, p.y, p.z};
}

LogLine log_part(const Session& session, std::uint32_t part) {
    return session.facts(part).id;
}

LogLine log_gizmo(const Session& session, const Carrying& carrying) {
    const Camera camera = session.camera();
    const Gizmo gizmo = carrying.gizmo(session);
    LogLine grips = LogLine::object();
    for (const Handle handle : kHandles)
        if (const auto grip = grip_of(camera, gizmo, handle))
            grips[to_string(handle)] = {std::round(grip->x), std::round(grip->y)};
    return grips;
}

LogLine log_way(Session& session, const Carrying& carrying) {
    if (!carrying.report)
        return nullptr;
    const PathReport& report = *carrying.report;
    LogLine meets = LogLine::array();
    for (const PathContact& contact : report.contacts)
        meets.push_back(name_of(session, contact.impact.part));
    return {{"length", report.length},
            {"free", report.is_free()},
            {"meets", std::move(meets)},
            {"clearance", report.clearance.found ? LogLine(report.clearance.distance) : LogLine()}};
}

LogLine log_carried(Session& session, const Carrying& carrying) {
    if (!carrying.carry)
        return nullptr;
    const CarryStep& step = carrying.carry->state();
    LogLine touched = LogLine::array();
    for (const WalkGap& gap : step.touched)
        touched.push_back({{"part", gap.part.number}, {"depth", -gap.distance}});
    return {{"part", log_part(session, carrying.part)},
            {"mode", to_string(carrying.mode)},
            {"place", log_point(step.pose.translation)},
            {"rotation", step.pose.rotation},
            {"blocked", step.blocked},
            {"waits", step.waits},
            {"at_rest", carrying.at_rest},
            {"touched", std::move(touched)},
            {"near", step.near.size()},
            {"gizmo", log_gizmo(session, carrying)},
            {"way", log_way(session, carrying)}};
}

LogLine log_clashes(const ClashList& clashes) {
    std::string status, note;
    for (const ClashReview& review : clashes.reviews)
        for (const ListedClash& clash : review.clashes)
            if (clashes.shown == clash.id)
                status = to_string(clash.status), note = clash.note;
    return {{"count", clashes.count()},
            {"running", clashes.job.is_running()},
            {"shown", clashes.shown ? clash_id_text(*clashes.shown) : ""},
            {"status", status},
            {"note", note},
            {"message", clashes.message}};
}

LogLine log_state(Session& session, const Tools& tools, bool is_complete) {
    static constexpr const char* kMoves[]{"walk", "fly", "orbit"};
    const Camera camera = session.camera();
    const WalkerState& person = session.walker->state();
    const Viewpoints& viewpoints = tools.viewpoints;
    const std::optional<WalkGap>& nearest = tools.proximity.nearest;
    return {{"mode", kMoves[static_cast<int>(session.move)]}, // NOLINT
            {"eye", log_point(camera.eye)},
            {"forward", log_point(camera.forward)},
            {"on_ground", person.on_ground},
            {"blocked", person.blocked},
            {"ducked", person.ducked},
            {"waits", person.waits},
            {"squeezed", person.squeezed},
            {"chosen", session.chosen ? log_part(session, *session.chosen) : LogLine()},
            {"removed", session.removed()},
            {"nearest", nearest ? LogLine(nearest->distance) : LogLine()},
            {"picks", tools.measure.picks.size()},
            {"measured", tools.measure.result},
            {"carried", log_carried(session, tools.carrying)},
            {"clashes", log_clashes(tools.clashes)},
            {"planes", session.sections.size()},
            {"box", session.section_box.has_value()},
            {"distances", session.distances.has_value()},
            {"colour_by", to_string(session.colour_by)},
            {"viewpoints", viewpoints.saved.points.size()},
            {"recording", viewpoints.recording},
            {"replaying", viewpoints.replaying},
            {"path_points", viewpoints.path.points.size()},
            {"typing", tools.is_typing},
            {"message", tools.message},
            {"complete", is_complete}};
}

} // namespace

void EventLog::Close::operator()(std::FILE* file) const {
    std::fclose(file); // NOLINT
}

EventLog::EventLog(const std::string& path) {
    if (path.empty())
        return;
    file_.reset(std::fopen(path.c_str(), "w")); // NOLINT
    if (!file_)
        throw Error(ErrorCode::cannot_write, path,
                    std::string("cannot be written: ") + std::strerror(errno));
}

void EventLog::write(Session& session, const Tools& tools, bool is_complete, double seconds) {
    constexpr double kBetween = 0.1;
    if (!file_ || (written_ >= 0 && seconds - written_ < kBetween))
        return;
    const LogLine state = log_state(session, tools, is_complete);
    std::string text = state.dump(-1, ' ', false, LogLine::error_handler_t::replace);
    if (text == last_)
        return;
    last_ = std::move(text);
    written_ = seconds;
    LogLine line{{"seconds", seconds}};
    line.update(state);
    std::fputs((line.dump(-1, ' ', false, LogLine::error_handler_t::replace) + '\n').c_str(),
               file_.get());
    std::fflush(file_.get());
}

} // namespace abut::viewer
