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
#include <thread>
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

/// How many seconds a picture took.
struct Drawn {
    double uploading = 0, drawing = 0;
    double processor = 0;           ///< of all threads while it was drawn
    double uploading_processor = 0; ///< of the calling thread
};

/// Draws a picture as while the eye moves.
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

/// Replays a path, frame by frame.
class Replay {
public:
    Replay(Session& session, const Arguments& arguments, Tour tour)
        : session_(session), arguments_(arguments), tour_(std::move(tour)) {}

    [[nodiscard]] Json run() {
        const Camera begin = camera_at(tour_, 0, session_.lens);
        last_ = begin.eye;
        Json first = draw_first(session_, scene_, begin);
        if (arguments_.paced)
            follow_clock();
        else
            follow_rate();
        return {{"first", std::move(first)}, {"frames", std::move(frames_)}};
    }

private:
    /// Every frame of the path, with its picture.
    void follow_rate() {
        const auto count = static_cast<std::size_t>(duration(tour_) * arguments_.rate) + 1;
        for (std::size_t i = 0; i < count; ++i) {
            Json row = draw(static_cast<double>(i) / arguments_.rate, 1 / arguments_.rate);
            Lap lap;
            const Picture picture = scene_.read();
            row["read"] = lap.seconds();
            frames_.push_back(std::move(row));
            write_png(picture, fmt::format("{}/{:05}.png", arguments_.frames, i));
        }
    }

    /// As a window does: where the clock is when a frame begins, and with as many triangles as this
    /// machine draws in time. A frame that ends early waits.
    void follow_clock() {
        const auto start = std::chrono::steady_clock::now();
        const std::chrono::duration<double> period(1 / arguments_.rate);
        double last = -period.count();
        for (;;) {
            const auto begin = std::chrono::steady_clock::now();
            const double now =
                frames_.empty() ? 0 : std::chrono::duration<double>(begin - start).count();
            if (now > duration(tour_))
                return;
            const std::uint64_t budget = session_.pace.triangles();
            Json row = draw(now, now - last);
            last = now;
            const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
            session_.pace.add_frame(taken.count());
            row["budget"] = budget;
            row["frame"] = taken.count();
            frames_.push_back(std::move(row));
            if (taken < period)
                std::this_thread::sleep_until(begin + period);
        }
    }

    /// Asks, chooses and draws at a time of the path.
    ///
    /// In          since: seconds since the last frame.
    [[nodiscard]] Json draw(double seconds, double since) {
        const Camera camera = camera_at(tour_, seconds, session_.lens);
        const Vec3 velocity = (1 / since) * (camera.eye - last_);
        last_ = camera.eye;
        Lap lap;
        ProcessorLap own;
        session_.walk.move_to(camera.eye, velocity);
        const NearestPart nearest =
            session_.walk.distance(head_, Pose{camera.eye}, {.missing = MissingParts::skip});
        const double querying = lap.seconds(), querying_processor = own.seconds();
        const ViewFrame& frame = session_.frame(camera, velocity);
        const double selecting = lap.seconds(), selecting_processor = own.seconds();
        const Drawn drawn = draw_moving(session_, scene_, camera, frame);
        Json row{{"seconds", seconds},
                 {"query", querying},
                 {"query_processor", querying_processor},
                 {"selection", selecting},
                 {"selection_processor", selecting_processor},
                 {"upload", drawn.uploading},
                 {"upload_processor", drawn.uploading_processor},
                 {"draw", drawn.drawing},
                 {"draw_processor", drawn.processor},
                 {"pixel_error", frame.pixel_error}};
        row.update(figures_of(session_, nearest));
        return row;
    }

    Session& session_;
    const Arguments& arguments_;
    Tour tour_;
    SceneBuffer scene_;
    Probe head_{Sphere{{0, 0, 0}, 0.1}};
    Vec3 last_; ///< eye of the last frame
    Json frames_ = Json::array();
};

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
    Json figures{{"store", store}, {"width", arguments.width}, {"height", arguments.height}};
    figures.update(Replay(session, arguments, tour).run());
    figures["peak_rss_mib"] = peak_resident_mib();
    write_figures(arguments.frames + "/figures.json", figures);
}

} // namespace abut::viewer
