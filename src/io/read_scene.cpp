#include <abut/error.h>
#include <abut/scene.h>

#include "core/progress.h"
#include "io/child_process.h"
#include "io/decode_scene.h"
#include "io/fault.h"
#include "io/input_file.h"
#include "io/reader_program.h"
#include "io/scene_stream.h"
#include "math/transform.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <exception>
#include <limits>
#include <numeric>
#include <tbb/global_control.h>
#include <thread>

namespace abut {

namespace {

std::string megabytes(std::uint64_t bytes) {
    return std::to_string(bytes >> 20) + " MiB";
}

/// Throws if the reader ended in any way but with a whole result.
void check_end(const ChildReport& report, const std::string& file, const ReadOptions& options) {
    const auto failed = [&](const std::string& what) {
        throw Error(ErrorCode::reader_failed, file, what);
    };
    const std::string limit =
        options.memory_limit > 0 ? " (limit " + megabytes(options.memory_limit) + ")" : "";
    switch (report.end) {
    case ChildEnd::exited:
        if (report.status == scene_stream::kOutOfMemory)
            failed("its reader ran out of memory" + limit);
        if (report.status != 0)
            failed("its reader failed with exit status " + std::to_string(report.status));
        return;
    case ChildEnd::killed:
        failed(std::string("its reader crashed: ") + strsignal(report.status));
        return;
    case ChildEnd::time_limit: {
        std::string seconds = std::to_string(options.time_limit);
        seconds.erase(seconds.find_last_not_of('0') + 1);
        if (seconds.back() == '.')
            seconds.pop_back();
        failed("its reader was stopped after " + seconds + " s");
        return;
    }
    case ChildEnd::memory_limit:
        failed("its reader ran out of memory" + limit);
        return;
    case ChildEnd::stopped:
        throw Error(ErrorCode::interrupted, "interrupted");
    }
}

Scene read_one(const std::string& file, const ReadOptions& options,
               const std::function<bool()>& should_stop) {
    const std::vector<std::string> command = reader_command(file, options.memory_limit);
    ResultMemory result;
    ChildReport report;
    try {
        report =
            run_child(command, {options.time_limit, options.memory_limit}, should_stop, result);
    } catch (const Error& error) {
        throw Error(error.code(), file, error.what());
    }
    check_end(report, file, options);
    return decode_scene(result.bytes(), file, options.unit == 0 ? 1 : options.unit);
}

/// Reads the files, the largest first, by several threads that each wait for one reader.
class ParallelReader {
public:
    ParallelReader(const std::vector<std::string>& files, const ReadOptions& options)
        : files_(files), options_(options), sizes_(files.size()), order_(files.size()),
          scenes_(files.size()), faults_(files.size()), first_fault_(files.size()) {
        for (std::size_t i = files.size(); i-- > 0;) {
            try {
                sizes_[i] = readable_size(files[i]);
            } catch (const Fault& fault) {
                faults_[i] = std::make_exception_ptr(Error(fault.code(), files[i], fault.what()));
                first_fault_ = i;
            }
        }
        std::iota(order_.begin(), order_.end(), std::size_t{0});
        std::stable_sort(order_.begin(), order_.end(),
                         [&](std::size_t a, std::size_t b) { return sizes_[a] > sizes_[b]; });
    }

    std::vector<Scene> read() {
        ProgressMeter meter(options_.progress, "import",
                            std::accumulate(sizes_.begin(), sizes_.end(), std::size_t{0}));
        const std::size_t allowed =
            tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
        const std::size_t others = std::max<std::size_t>(std::min(allowed, files_.size()), 1) - 1;
        {
            std::vector<std::jthread> threads;
            for (std::size_t i = 0; i < others; ++i)
                threads.emplace_back([&] { work(meter); });
            work(meter);
        }
        check_stop(options_.progress);
        if (first_fault_ < files_.size())
            std::rethrow_exception(faults_[first_fault_]);
        return std::move(scenes_);
    }

private:
    void work(ProgressMeter& meter) {
        while (true) {
            const std::size_t turn = next_.fetch_add(1);
            if (turn >= order_.size())
                return;
            const std::size_t i = order_[turn];
            // Neither a file at fault nor what comes after it is wanted any more.
            const auto should_stop = [&] {
                return first_fault_.load() <= i ||
                       (options_.progress.stop != nullptr && options_.progress.stop->load());
            };
            if (should_stop())
                continue;
            try {
                scenes_[i] = read_one(files_[i], options_, should_stop);
                meter.advance(sizes_[i]);
            } catch (...) {
                faults_[i] = std::current_exception();
                std::size_t first = first_fault_.load();
                while (i < first && !first_fault_.compare_exchange_weak(first, i)) {
                }
            }
        }
    }

    const std::vector<std::string>& files_;
    const ReadOptions& options_;
    std::vector<std::size_t> sizes_;
    std::vector<std::size_t> order_;
    std::vector<Scene> scenes_;
    std::vector<std::exception_ptr> faults_;
    std::atomic<std::size_t> next_{0};
    std::atomic<std::size_t> first_fault_;
};

} // namespace

Scene read_scene(const std::string& path, const ReadOptions& options) {
    return std::move(read_scenes({path}, options).front());
}

std::vector<Scene> read_scenes(const std::vector<std::string>& paths, const ReadOptions& options) {
    if (!std::isfinite(options.unit) || options.unit < 0)
        throw Error(ErrorCode::bad_argument, "unit must be a positive number of metres");
    if (!std::isfinite(options.time_limit) || options.time_limit < 0)
        throw Error(ErrorCode::bad_argument, "time limit must not be negative");
    if (paths.empty())
        return {};
    return ParallelReader(paths, options).read();
}

Mesh read_mesh(const std::string& path, const ReadOptions& options) {
    const Scene scene = read_scene(path, options);
    std::size_t vertices = 0;
    std::size_t triangles = 0;
    for (const Part& part : scene.parts) {
        vertices += scene.meshes[part.mesh].positions.size();
        triangles += scene.meshes[part.mesh].triangles.size();
    }
    if (vertices > std::numeric_limits<std::uint32_t>::max())
        throw Error(ErrorCode::bad_mesh, path, "has too many vertices for one mesh");

    Mesh mesh;
    mesh.positions.reserve(vertices);
    mesh.triangles.reserve(triangles);
    for (const Part& part : scene.parts) {
        const auto base = static_cast<std::uint32_t>(mesh.positions.size());
        for (const Vec3& position : scene.meshes[part.mesh].positions)
            mesh.positions.push_back(apply(part.world_from_mesh, position));
        for (const auto& [a, b, c] : scene.meshes[part.mesh].triangles)
            mesh.triangles.push_back({base + a, base + b, base + c});
    }
    return mesh;
}

} // namespace abut
