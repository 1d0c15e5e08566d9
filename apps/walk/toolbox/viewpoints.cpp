#include "toolbox/viewpoints.h"

#include <abut/error.h>

#include <filesystem>
#include <fmt/format.h>

namespace abut::viewer {

std::string viewpoint_file(const std::string& store) {
    return std::filesystem::path(store).replace_extension(".views.json").string();
}

void Viewpoints::open(const std::string& store) {
    const std::string known = viewpoint_file(store);
    if (std::filesystem::exists(known))
        saved = read_tour(known);
    kept_in = known;
}

void Viewpoints::keep() const {
    if (kept_in.empty())
        throw Error(ErrorCode::cannot_write,
                    "the file of viewpoints could not be read, and is not overwritten");
    write_tour(saved, kept_in);
}

void Viewpoints::save(Session& session) {
    const double last = saved.points.empty() ? -1 : saved.points.back().seconds;
    record(saved, last + 1, session.camera(), fmt::format("view {}", saved.points.size() + 1));
    keep();
}

void Viewpoints::rename(std::size_t which, const std::string& name) {
    saved.points[which].name = name;
    keep();
}

void Viewpoints::remove(std::size_t which) {
    saved.points.erase(saved.points.begin() + static_cast<std::ptrdiff_t>(which));
    next = 0;
    keep();
}

void Viewpoints::visit(Session& session, std::size_t which) {
    replaying = false;
    ++session.jumps;
    session.look(saved.points[which].eye, saved.points[which].forward);
    next = (which + 1) % saved.points.size();
}

void Viewpoints::visit_next(Session& session) {
    if (!saved.points.empty())
        visit(session, next);
}

void Viewpoints::toggle_recording() {
    recording = !recording;
    replaying = false;
    if (recording)
        path = {}, clock = 0;
}

void Viewpoints::replay(Session& session) {
    if (recording || path.points.empty())
        return;
    ++session.jumps; // to its beginning
    replaying = true;
    clock = 0;
}

void Viewpoints::update(Session& session, double seconds) {
    if (!recording && !replaying)
        return;
    clock += seconds;
    if (recording) {
        record(path, clock, session.camera());
        return;
    }
    const Camera camera = camera_at(path, clock, session.lens);
    session.look(camera.eye, camera.forward);
    replaying = clock < duration(path);
}

} // namespace abut::viewer
