/// What call_cost.py measures, from C++: nanoseconds of processor time per query, one JSON object.
///
/// In: a mesh file of two triangles or more, and a text file of poses, 16 numbers a line, row by row.
#include <abut/batch.h>
#include <abut/model.h>
#include <abut/rigid.h>
#include <abut/scene.h>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <vector>

namespace {

std::vector<abut::Placement> read_poses(const char* path) {
    std::vector<abut::Placement> poses;
    std::ifstream file(path);
    for (double first = 0; file >> first;) {
        abut::Transform pose;
        for (int k = 0; k < 16; ++k) {
            double value = first;
            if (k > 0)
                file >> value;
            if (k < 12)
                pose.m[static_cast<std::size_t>(k % 4 * 3 + k / 4)] = value;
        }
        poses.push_back({{}, pose});
    }
    return poses;
}

/// Processor time of all threads of the process, in nanoseconds: what other programs use of the
/// machine is not in it.
double processor_ns() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return 1e9 * static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec);
}

/// The median of several rounds, in nanoseconds.
template <class Work>
double median_ns(int rounds, Work work) {
    std::vector<double> times;
    for (int i = 0; i < rounds; ++i) {
        const double start = processor_ns();
        work();
        times.push_back(processor_ns() - start);
    }
    std::ranges::nth_element(times, times.begin() + rounds / 2);
    return times[static_cast<std::size_t>(rounds / 2)];
}

} // namespace

int main(int argc, char** argv) {
    if (argc != 3)
        return 2;
    const abut::Model model(abut::read_mesh(argv[1]));
    const auto placements = read_poses(argv[2]);
    const abut::Transform still{}, away = placements.at(0).world_from_b;
    constexpr int calls = 20000;
    double sum = 0; // keeps the queries from being left out
    const double distance = median_ns(25, [&] {
        for (int i = 0; i < calls; ++i)
            sum += abut::distance(model, still, model, away).distance;
    });
    const double collide = median_ns(25, [&] {
        for (int i = 0; i < calls; ++i)
            sum += abut::collide(model, still, model, away).meet();
    });
    const double batch =
        median_ns(25, [&] { sum += abut::distance(model, model, placements)[0].distance; });
    std::printf("{\"distance\": %.1f, \"collide\": %.1f, \"batch\": %.0f, \"sum\": %g}\n",
                distance / calls, collide / calls, batch, sum);
}
