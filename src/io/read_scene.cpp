#include <abut/error.h>
#include <abut/scene.h>

#include "core/progress.h"
#include "core/temporary_file.h"
#include "io/file/fault.h"
#include "io/file/file_kind.h"
#include "io/file/input_file.h"
#include "io/file/read_watch.h"
#include "io/polygon/polygon_file.h"
#include "io/process/child_process.h"
#include "io/process/decode_scene.h"
#include "io/process/reader_end.h"
#include "io/process/reader_program.h"
#include "io/scene/collect_scene.h"
#include "io/scene/model_frame.h"
#include "io/scene/part_checks.h"
#include "io/scene/scene_source.h"
#include "math/transform.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <exception>
#include <limits>
#include <memory>
#include <new>
#include <numeric>
#include <tbb/global_control.h>
#include <thread>

namespace abut {

namespace {

constexpr std::uint64_t kUnlimited = std::uint64_t{1} << 62;

Scene read_isolated(const ModelPath& path, const ReadOptions& options,
                    const std::function<bool()>& should_stop) {
    const std::string& file = path.path;
    const std::vector<std::string> command = reader_command(file, options);
    const ChildLimits limits{options.time_limit, options.memory_limit};
    ResultMemory result;
    ChildReport report;
    try {
        report = run_child(command, limits, should_stop, result.descriptor());
    } catch (const Error& error) {
        throw Error(error.code(), file, error.what());
    }
    check_end(report, file, limits);
    return decode_scene(result.bytes(), path, options);
}

/// Adds to a polygon reader's scene what read_scene promises: its file, frame and checks.
Scene completed(Scene scene, const ModelPath& path, const ReadOptions& options) {
    const ModelFrame frame = model_frame(FormatFrame{}, path, options);
    scene.file = path.path;
    scene.unit = frame.unit;
    scene.up = frame.up;
    scene.precision.single_meshes = true; // see PolygonScene::vertex
    make_ids_unique(scene.parts);
    MeshFaults faults;
    for (std::size_t i = 0; i < scene.meshes.size(); ++i)
        find_bad_coordinate(scene.meshes[i], i, faults);
    for (Part& part : scene.parts)
        scale(part.world_from_mesh, frame.unit);
    check_scene(scene, faults);
    return scene;
}

Scene read_one(const ModelPath& path, const ReadOptions& options,
               const std::function<bool()>& should_stop) {
    const std::string& file = path.path;
    const auto watch = std::make_shared<const ReadWatch>(file, options, should_stop);
    try {
        check_file_kind(file, lower_extension(file));
        if (auto scene = read_polygon_file(file, options.allow_outside_files, watch))
            return completed(std::move(*scene), path, options);
        const auto source = open_own_source(
            path, {.read = options, .folder = kInMemory, .memory = kUnlimited, .watch = watch});
        if (source != nullptr)
            return collect_scene(*source, file, *watch);
    } catch (const Fault& fault) {
        throw Error(fault.code(), file, fault.what());
    } catch (const std::bad_alloc&) {
        throw_memory_limit(file, options.memory_limit);
    }
    return read_isolated(path, options, should_stop);
}

/// Reads files, the largest first, with several threads that each wait for one reader.
class ParallelReader {
public:
    ParallelReader(const std::vector<ModelPath>& files, const ReadOptions& options)
        : files_(files), options_(options), sizes_(files.size()), order_(files.size()),
          scenes_(files.size()), faults_(files.size()), first_fault_(files.size()) {
        for (std::size_t i = files.size(); i-- > 0;) {
            try {
                sizes_[i] = readable_size(files[i].path);
            } catch (const Fault& fault) {
                faults_[i] =
                    std::make_exception_ptr(Error(fault.code(), files[i].path, fault.what()));
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
            // After a fault, the files that come later in the list are not needed.
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

    const std::vector<ModelPath>& files_;
    const ReadOptions& options_;
    std::vector<std::size_t> sizes_;
    std::vector<std::size_t> order_;
    std::vector<Scene> scenes_;
    std::vector<std::exception_ptr> faults_;
    std::atomic<std::size_t> next_{0};
    std::atomic<std::size_t> first_fault_;
};

} // namespace

Scene read_scene(const ModelPath& path, const ReadOptions& options) {
    return std::move(read_scenes(std::vector{path}, options).front());
}

Scene read_scene(const std::string& path, const ReadOptions& options) {
    return read_scene(ModelPath{path}, options);
}

std::vector<Scene> read_scenes(const std::vector<std::string>& paths, const ReadOptions& options) {
    std::vector<ModelPath> files;
    files.reserve(paths.size());
    for (const std::string& path : paths)
        files.push_back({path});
    return read_scenes(files, options);
}

std::vector<Scene> read_scenes(const std::vector<ModelPath>& paths, const ReadOptions& options) {
    const auto is_unit = [](double unit) { return std::isfinite(unit) && unit >= 0; };
    if (!is_unit(options.unit) || !std::all_of(paths.begin(), paths.end(), [&](const auto& path) {
            return is_unit(path.unit);
        }))
        throw Error(ErrorCode::bad_argument, "unit must be a positive number of metres");
    if (!std::isfinite(options.time_limit) || options.time_limit < 0)
        throw Error(ErrorCode::bad_argument, "time limit must not be negative");
    if (paths.empty())
        return {};
    return ParallelReader(paths, options).read();
}

Mesh read_mesh(const std::string& path, const ReadOptions& options) {
    return to_mesh(read_scene(path, options));
}

Mesh to_mesh(const Scene& scene) {
    std::size_t vertices = 0;
    std::size_t triangles = 0;
    for (const Part& part : scene.parts) {
        vertices += scene.meshes[part.mesh].positions.size();
        triangles += scene.meshes[part.mesh].triangles.size();
    }
    if (vertices > std::numeric_limits<std::uint32_t>::max())
        throw Error(ErrorCode::bad_mesh, scene.file, "has too many vertices for one mesh");

    Mesh mesh;
    mesh.positions.reserve(vertices);
    mesh.triangles.reserve(triangles);
    for (const Part& part : scene.parts) {
        const auto base = static_cast<std::uint32_t>(mesh.positions.size());
        for (const Vec3& position : scene.meshes[part.mesh].positions) {
            mesh.positions.push_back(apply(part.world_from_mesh, position));
            // The transform may have made the coordinate too large although it was valid in the
            // file.
            if (const char* const fault = coordinate_fault(mesh.positions.back()))
                throw Error(ErrorCode::bad_mesh, scene.file,
                            "part " + part.id + ": vertex " +
                                std::to_string(mesh.positions.size() - 1 - base) + fault);
        }
        for (const auto& [a, b, c] : scene.meshes[part.mesh].triangles)
            mesh.triangles.push_back({base + a, base + b, base + c});
    }
    return mesh;
}

} // namespace abut
