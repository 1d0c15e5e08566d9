#include "replay.h"

#include <abut/error.h>
#include <abut/progress.h>
#include <abut/tour.h>

#include "open_model.h"
#include "session/scene_buffer.h"
#include "session/session.h"
#include "vec.h"

#include <chrono>
#include <cmath>
#include <epoxy/gl.h>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sys/resource.h>
#include <time.h> // NOLINT(modernize-deprecated-headers): clock_gettime is of POSIX

namespace abut::viewer {

namespace {

using Json = nlohmann::ordered_json;

constexpr int kFirstPictures = 2;

/// Processor time of all threads of the process in seconds, OpenGL's threads included.
double processor_seconds() {
    rusage used{};
    getrusage(RUSAGE_SELF, &used);
    const auto seconds = [](const timeval& t) {
        return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    return seconds(used.ru_utime) + seconds(used.ru_stime);
}

/// Seconds since the last call.
class Lap {
public:
    double seconds() {
        const auto now = std::chrono::steady_clock::now();
        const double passed = std::chrono::duration<double>(now - last_).count();
        last_ = now;
        return passed;
    }

private:
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// Seconds of the calling thread since the last call. Other programs do not lengthen them.
class ProcessorLap {
public:
    double seconds() {
        const double now = thread_seconds(), passed = now - last_;
        last_ = now;
        return passed;
    }

private:
    static double thread_seconds() {
        timespec used{};
        clock_gettime(CLOCK_THREAD_CPUTIME_ID, &used);
        return static_cast<double>(used.tv_sec) + 1e-9 * static_cast<double>(used.tv_nsec);
    }
    double last_ = thread_seconds();
};

Json figures_of(const Session& session, const NearestPart& nearest) {
    const ViewStatistics& view = session.view.statistics();
    const WalkStatistics walk = session.walk.statistics();
    const RenderStatistics drawn = session.renderer.statistics();
    return {{"triangles", drawn.triangles},
            {"hidden_triangles", drawn.hidden_triangles},
            {"draw_calls", drawn.draw_calls},
            {"bytes_uploaded", drawn.uploaded_bytes},
            {"bytes_loaded", view.bytes_loaded},
            {"wanted", view.wanted},
            {"missing", view.missing},
            {"view_bytes", view.bytes},
            {"gpu_bytes", view.gpu_bytes},
            {"walk_bytes", walk.bytes},
            {"query_misses", nearest.misses},
            {"nearest", nearest.found ? Json(nearest.gap.distance) : Json()}};
}

/// A picture as while the eye moves, with seconds that it took.
struct Drawn {
    Picture picture;
    double uploading = 0, drawing = 0, reading = 0;
    double processor = 0;           ///< of all threads while it was drawn
    double uploading_processor = 0; ///< of the calling thread
};

Drawn draw_moving(Session& session, SceneBuffer& scene, const Camera& camera,
                  const ViewFrame& frame) {
    Drawn drawn;
    Lap lap;
    ProcessorLap own;
    scene.bind(camera.width, camera.height);
    session.renderer.begin(camera, session.style(false));
    ViewFrame uploads = frame;
    uploads.draws = {};
    session.renderer.add(uploads);
    drawn.uploading = lap.seconds();
    drawn.uploading_processor = own.seconds();
    glFinish(); // what was drawn before
    const double before = processor_seconds();
    (void)lap.seconds();
    ViewFrame draws = frame;
    draws.uploads = {};
    draws.drops = {};
    session.renderer.add(draws);
    session.renderer.end();
    glFinish();
    drawn.drawing = lap.seconds();
    drawn.processor = processor_seconds() - before;
    drawn.picture = scene.read();
    drawn.reading = lap.seconds();
    return drawn;
}

/// Draws the first picture, complete, before the path begins: the way of a window, where the eye
/// rests at first.
Json draw_first(Session& session, SceneBuffer& scene, const Camera& camera) {
    Lap lap;
    (void)session.view.frame(camera);
    session.view.wait();
    const double loading = lap.seconds();
    const ViewFrame& frame = session.view.frame(camera);
    const double selecting = lap.seconds();
    const Drawn drawn = draw_moving(session, scene, camera, frame);
    // What it hides lets others be finer, which are read too before the path begins.
    for (int k = 0; k < kFirstPictures; ++k) {
        (void)session.frame(camera);
        session.view.wait();
        (void)draw_moving(session, scene, camera, session.frame(camera));
    }
    return {{"loading", loading},
            {"selection", selecting},
            {"upload", drawn.uploading},
            {"draw", drawn.drawing}};
}

void write_figures(const std::string& path, const Json& figures) {
    std::ofstream file(path);
    file << figures.dump(1) << '\n';
    if (!file.flush())
        throw Error(ErrorCode::cannot_write, path, "cannot be written");
}

} // namespace

void replay(const Arguments& arguments) {
    const Tour tour = read_tour(arguments.path);
    if (tour.points.empty())
        throw Error(ErrorCode::malformed, arguments.path, "has no points");
    std::error_code fault;
    std::filesystem::create_directories(arguments.frames, fault);
    if (fault)
        throw Error(ErrorCode::cannot_write, arguments.frames,
                    "cannot be created: " + fault.message());
    OffscreenContext context;
    const std::string store = ready_store(arguments.files, terminal_progress(arguments.quiet));
    Session session(store, {arguments.memory, arguments.gpu_memory, arguments.pixel_error},
                    arguments.width, arguments.height);
    SceneBuffer scene;
    const Probe head(Sphere{{0, 0, 0}, 0.1});
    const auto count = static_cast<std::size_t>(duration(tour) * arguments.rate) + 1;
    Json frames = Json::array();
    const Json first = draw_first(session, scene, camera_at(tour, 0, session.lens));
    Vec3 last = camera_at(tour, 0, session.lens).eye;
    for (std::size_t i = 0; i < count; ++i) {
        const double seconds = static_cast<double>(i) / arguments.rate;
        const Camera camera = camera_at(tour, seconds, session.lens);
        const Vec3 velocity = arguments.rate * (camera.eye - last);
        last = camera.eye;
        Lap lap;
        ProcessorLap own;
        session.walk.move_to(camera.eye, velocity);
        const NearestPart nearest =
            session.walk.distance(head, Pose{camera.eye}, {.missing = MissingParts::skip});
        const double querying = lap.seconds(), querying_processor = own.seconds();
        const ViewFrame& frame = session.frame(camera, velocity);
        const double selecting = lap.seconds(), selecting_processor = own.seconds();
        const Drawn drawn = draw_moving(session, scene, camera, frame);
        Json row{{"seconds", seconds},
                 {"query", querying},
                 {"query_processor", querying_processor},
                 {"selection", selecting},
                 {"selection_processor", selecting_processor},
                 {"upload", drawn.uploading},
                 {"upload_processor", drawn.uploading_processor},
                 {"draw", drawn.drawing},
                 {"draw_processor", drawn.processor},
                 {"read", drawn.reading},
                 {"pixel_error", frame.pixel_error}};
        row.update(figures_of(session, nearest));
        frames.push_back(std::move(row));
        write_png(drawn.picture, fmt::format("{}/{:05}.png", arguments.frames, i));
    }
    write_figures(arguments.frames + "/figures.json", {{"store", store},
                                                       {"width", arguments.width},
                                                       {"height", arguments.height},
                                                       {"peak_rss_mib", peak_resident_mib()},
                                                       {"first", first},
                                                       {"frames", std::move(frames)}});
}

} // namespace abut::viewer
