// Walks through a store from place to place in real time, and prints the nearest part every second.
//
//     abut-walk-through STORE X,Y,Z X,Y,Z ...

#include <abut/walk.h>

#include "program.h"
#include "walker.h"

#include <chrono>
#include <cstdio>
#include <string>
#include <thread>
#include <vector>

namespace {

bool parse_place(const char* text, abut::Vec3& place) {
    char rest = 0;
    return std::sscanf(text, "%lf,%lf,%lf%c", &place.x, &place.y, &place.z, &rest) == 3;
}

void print(int second, const walker::Frame& frame, abut::Walk& walk) {
    const auto& [p, nearest] = frame;
    std::printf("%4d s  at %.2f,%.2f,%.2f", second, p.x, p.y, p.z);
    if (nearest.found)
        std::printf("  %.3f m from %s\n", nearest.gap.distance,
                    walk.name(nearest.gap.part).name.c_str());
    else
        std::puts("  no part anywhere");
    std::fflush(stdout);
}

int run(int argc, char** argv) {
    std::vector<abut::Vec3> places(argc > 3 ? static_cast<std::size_t>(argc - 2) : 0);
    bool is_right = !places.empty();
    for (std::size_t i = 0; i < places.size(); ++i)
        is_right = parse_place(argv[i + 2], places[i]) && is_right;
    if (!is_right) {
        std::fputs("usage: abut-walk-through STORE X,Y,Z X,Y,Z ...\n", stderr);
        return 2;
    }
    abut::Walk walk(abut::open_store(argv[1]), {.memory = std::uint64_t{128} << 20});
    walk.move_to(places[0]);
    walk.wait();
    const walker::Settings settings;
    walker::Walker walker(walk, places[0], settings);
    auto next = std::chrono::steady_clock::now();
    int frames = 0;
    for (std::size_t leg = 1; leg < places.size(); ++leg) {
        const double seconds = 1.5 * walker.way_to(places[leg]) / settings.speed;
        const int last = frames + 1 + static_cast<int>(seconds / settings.frame);
        while (frames < last && walker.way_to(places[leg]) > settings.skin) {
            const walker::Frame frame = walker.step_towards(places[leg]);
            if (frames++ % 60 == 0)
                print(frames / 60, frame, walk);
            next += std::chrono::microseconds(static_cast<int>(1e6 * settings.frame));
            std::this_thread::sleep_until(next);
        }
    }
    const abut::WalkStatistics found = walk.statistics();
    std::printf("%llu parts asked for, %llu of them not in memory yet; at most %llu MiB\n",
                static_cast<unsigned long long>(found.lookups),
                static_cast<unsigned long long>(found.misses),
                static_cast<unsigned long long>(found.peak_bytes >> 20));
    return 0;
}

} // namespace

int main(int argc, char** argv) {
    return run_program("abut-walk-through", run, argc, argv);
}
