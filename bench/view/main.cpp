// Measures the viewer at random eyes in a store with levels: the cost of drawing a frame, and how far
// the picture within an error in pixels differs from that of the full geometry.
#include <abut/picture.h>
#include <abut/renderer.h>
#include <abut/tour.h>
#include <abut/view.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <epoxy/gl.h>
#include <numbers>
#include <random>
#include <sys/resource.h>

namespace abut::bench {
namespace {

struct Options {
    std::string store;
    int eyes = 30, repeats = 5;
    std::uint32_t width = 1280, height = 720, samples = 1;
    std::uint64_t seed = 1, triangles = 500'000;
    double pixel_error = 1;
    bool fidelity = false, budgeted = false;
    std::string pictures, path;
};

double processor_seconds(int whose) {
    rusage used{};
    getrusage(whose, &used);
    const auto seconds = [](const timeval& t) {
        return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    return seconds(used.ru_utime) + seconds(used.ru_stime);
}

/// Random eyes in the lower, middle part of a model, which look in any level direction; or those of a
/// path at equal times.
class Eyes {
public:
    Eyes(const Box3& box, UpAxis up, std::uint64_t seed)
        : box_(box), up_(static_cast<int>(up)), random_(seed) {}

    Camera next(const Options& options) {
        if (!options.path.empty()) {
            const Tour tour = read_tour(options.path);
            Camera lens;
            lens.field_of_view = 1.1;
            lens.width = options.width, lens.height = options.height;
            lens.far = 4000;
            return camera_at(tour, duration(tour) * (count_++ + 0.5) / options.eyes, lens);
        }
        const auto between = [&](double a, double b) {
            return a + (b - a) * static_cast<double>(random_() >> 11) * 0x1p-53;
        };
        const auto along = [&](int axis) {
            const double low = axis == 0 ? box_.lower.x : axis == 1 ? box_.lower.y : box_.lower.z;
            const double high = axis == 0 ? box_.upper.x : axis == 1 ? box_.upper.y : box_.upper.z;
            return axis == up_ ? between(low + 0.02 * (high - low), low + 0.4 * (high - low))
                               : between(low + 0.1 * (high - low), high - 0.1 * (high - low));
        };
        const double yaw = between(0, 2 * std::numbers::pi), tilt = between(-0.3, 0.3);
        std::array<double, 3> way{}, up{};
        way.at(static_cast<std::size_t>(up_)) = tilt;
        way.at(static_cast<std::size_t>((up_ + 1) % 3)) = std::cos(yaw);
        way.at(static_cast<std::size_t>((up_ + 2) % 3)) = std::sin(yaw);
        up.at(static_cast<std::size_t>(up_)) = 1;
        Camera camera;
        camera.eye = {along(0), along(1), along(2)};
        camera.forward = {way[0], way[1], way[2]};
        camera.up = {up[0], up[1], up[2]};
        camera.field_of_view = 1.1;
        camera.width = options.width, camera.height = options.height;
        camera.far = 4000;
        return camera;
    }

private:
    Box3 box_;
    int up_, count_ = 0;
    std::mt19937_64 random_;
};

/// A view with a renderer of its own, whose frames read all that they need.
struct Shown {
    Shown(const Store& store, const ViewOptions& options)
        : view(store, options), renderer(view.parts().size(), view.origin()) {
        const std::vector<Colour> colours = part_colours(store, ColourBy::material);
        for (std::uint32_t i = 0; i < colours.size(); ++i)
            renderer.set_state(i, {.colour = colours[i]});
    }
    View view;
    Renderer renderer;
};

double median(std::vector<double> values) {
    if (values.empty())
        return 0;
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

RenderStyle style_of(const Options& options, UpAxis up) {
    RenderStyle style;
    style.up = {up == UpAxis::x ? 1.0 : 0, up == UpAxis::y ? 1.0 : 0, up == UpAxis::z ? 1.0 : 0};
    style.samples = options.samples;
    style.ambient_occlusion = options.samples > 1;
    return style;
}

/// A framebuffer to draw into; without one, OpenGL leaves out the last pass.
class Target {
public:
    Target(std::uint32_t width, std::uint32_t height) {
        glGenFramebuffers(1, &framebuffer_);
        glGenRenderbuffers(1, &colours_);
        glBindRenderbuffer(GL_RENDERBUFFER, colours_);
        glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, static_cast<GLsizei>(width),
                              static_cast<GLsizei>(height));
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
        glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, colours_);
    }
    ~Target() {
        glDeleteFramebuffers(1, &framebuffer_);
        glDeleteRenderbuffers(1, &colours_);
    }
    Target(const Target&) = delete;
    Target& operator=(const Target&) = delete;

private:
    GLuint framebuffer_ = 0, colours_ = 0;
};

/// Draws each frame several times, as while the eye moves.
void measure_drawing(const Store& store, const Options& options) {
    ViewOptions limits;
    limits.triangle_budget = options.triangles;
    limits.pixel_error = options.pixel_error;
    limits.memory = limits.gpu_memory = std::uint64_t{1} << 30;
    limits.background = false;
    Shown shown(store, limits);
    const Target target(options.width, options.height);
    Eyes eyes(shown.view.bounds(), shown.view.up(), options.seed);
    std::vector<double> all, main, wall, selecting, errors, triangles, hidden, calls;
    for (int i = 0; i < options.eyes; ++i) {
        const Camera camera = eyes.next(options);
        for (int k = 0; k < 4; ++k) // occluders come with what is read
            shown.renderer.draw(shown.view.frame(camera), camera,
                                style_of(options, shown.view.up()));
        RenderStyle style = style_of(options, shown.view.up());
        style.leave_out_backs = style.quick = true;
        std::vector<double> all_here, main_here, wall_here, selecting_here;
        ViewFrame frame = shown.view.frame(camera);
        for (int k = 0; k < options.repeats; ++k) {
            glFinish();
            frame = shown.view.frame(camera);
            selecting_here.push_back(shown.view.statistics().seconds_selecting);
            const double a = processor_seconds(RUSAGE_SELF), m = processor_seconds(RUSAGE_THREAD);
            const auto start = std::chrono::steady_clock::now();
            shown.renderer.draw(frame, camera, style);
            glFinish();
            wall_here.push_back(
                std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
            all_here.push_back(processor_seconds(RUSAGE_SELF) - a);
            main_here.push_back(processor_seconds(RUSAGE_THREAD) - m);
        }
        all.push_back(1e3 * median(all_here)), main.push_back(1e3 * median(main_here));
        wall.push_back(1e3 * median(wall_here));
        selecting.push_back(1e3 * median(selecting_here));
        errors.push_back(frame.pixel_error);
        triangles.push_back(static_cast<double>(shown.renderer.statistics().triangles));
        hidden.push_back(static_cast<double>(shown.renderer.statistics().hidden_triangles));
        calls.push_back(static_cast<double>(shown.renderer.statistics().draw_calls));
    }
    std::printf(
        "draw: processor %.1f ms of all threads, %.1f ms of the calling one; wall "
        "%.1f ms; selection %.2f ms; %.0f triangles and %.0f left out, %.0f calls, error %.2f "
        "px (medians of %d eyes)\n",
        median(all), median(main), median(wall), median(selecting), median(triangles),
        median(hidden), median(calls), median(errors), options.eyes);
}

double share_of_different(const Picture& a, const Picture& b) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.pixels.size(); i += 3) {
        int most = 0;
        for (std::size_t k = 0; k < 3; ++k)
            most = std::max(most, std::abs(int{a.pixels[i + k]} - int{b.pixels[i + k]}));
        count += most > 16 ? 1 : 0;
    }
    return 3.0 * static_cast<double>(count) / static_cast<double>(a.pixels.size());
}

void compare_pictures(const Store& store, const Options& options) {
    ViewOptions fine;
    fine.triangle_budget = fine.memory = fine.gpu_memory = std::uint64_t{6} << 30;
    fine.draw_budget = 1'000'000;
    fine.background = false;
    ViewOptions full = fine;
    if (options.budgeted)
        fine.triangle_budget = options.triangles;
    fine.pixel_error = options.pixel_error;
    full.pixel_error = 1e-9;
    Shown coarse(store, fine), exact(store, full);
    exact.view.set_occlusion(false);
    Eyes eyes(coarse.view.bounds(), coarse.view.up(), options.seed);
    std::vector<double> shares, coarse_triangles, full_triangles;
    for (int i = 0; i < options.eyes; ++i) {
        const Camera camera = eyes.next(options);
        const RenderStyle style = style_of(options, coarse.view.up());
        Picture of_coarse;
        for (int k = 0; k < 3; ++k)
            of_coarse = coarse.renderer.picture(coarse.view.frame(camera), camera, style);
        const Picture of_full = exact.renderer.picture(exact.view.frame(camera), camera, style);
        shares.push_back(share_of_different(of_coarse, of_full));
        coarse_triangles.push_back(static_cast<double>(coarse.renderer.statistics().triangles));
        full_triangles.push_back(static_cast<double>(exact.renderer.statistics().triangles));
        std::printf("eye %d: %.3f %% of the pixels differ; %.0f triangles of %.0f\n", i,
                    100 * shares.back(), coarse_triangles.back(), full_triangles.back());
        std::fflush(stdout);
        if (!options.pictures.empty()) {
            write_png(of_coarse, options.pictures + "/" + std::to_string(i) + "-levels.png");
            write_png(of_full, options.pictures + "/" + std::to_string(i) + "-full.png");
        }
    }
    std::printf("fidelity: at %.2f px, %.3f %% of the pixels differ by more than 16 of 255 at the "
                "median, %.3f %% at most; %.0f triangles of %.0f (medians)\n",
                options.pixel_error, 100 * median(shares),
                100 * *std::max_element(shares.begin(), shares.end()), median(coarse_triangles),
                median(full_triangles));
}

int run(int argc, char** argv) {
    Options options;
    CLI::App app("Measures the viewer at random eyes in a store with levels", "abut-bench-view");
    app.add_option("STORE", options.store, "Store with levels of detail")->required();
    app.add_option("--eyes", options.eyes, "Number of eyes");
    app.add_option("--path", options.path, "Path whose eyes are taken in place of random ones");
    app.add_option("--repeats", options.repeats, "Drawings of each frame");
    app.add_option("--seed", options.seed, "Seed of the eyes");
    app.add_option("--triangles", options.triangles, "Triangle budget of a frame");
    app.add_option("--pixel-error", options.pixel_error, "Largest error in pixels");
    app.add_option("--samples", options.samples, "Samples along a side of a pixel");
    app.add_option("--width", options.width, "Pixels");
    app.add_option("--height", options.height, "Pixels");
    app.add_flag("--fidelity", options.fidelity, "Compare with pictures of the full geometry");
    app.add_flag("--budgeted", options.budgeted, "Keep the triangle budget in --fidelity, too");
    app.add_option("--pictures", options.pictures, "Folder for the pictures that are compared");
    CLI11_PARSE(app, argc, argv);
    const OffscreenContext context;
    const Store store = open_store(options.store);
    if (options.fidelity)
        compare_pictures(store, options);
    else
        measure_drawing(store, options);
    return 0;
}

} // namespace
} // namespace abut::bench

int main(int argc, char** argv) {
    try {
        return abut::bench::run(argc, argv);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "abut-bench-view: %s\n", error.what());
        return 2;
    }
}
