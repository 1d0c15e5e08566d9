#include "render/picture/geometry_stream.h"

#include "core/parallel.h"
#include "core/stop.h"
#include "math/transform.h"
#include "render/extra_parts.h"
#include "view/camera/fit_camera.h"
#include "view/levels/level_tree.h"

#include <algorithm>
#include <tuple>

namespace abut {

namespace {

constexpr std::size_t kMeshesOfBatch = 2048;

/// Returns false if a box lies wholly beyond one of the planes of the picture.
bool may_be_seen(const DrawnCamera& camera, const Box3& box) {
    std::array<int, 5> beyond{};
    for (int i = 0; i < 8; ++i) {
        const Vec3 from_eye = corner_of(box, i) - camera.eye;
        const double depth = dot(camera.forward, from_eye);
        const double x = dot(camera.right, from_eye), y = dot(camera.up, from_eye);
        beyond[0] += x > camera.slope_x * depth ? 1 : 0;
        beyond[1] += x < -camera.slope_x * depth ? 1 : 0;
        beyond[2] += y > camera.slope_y * depth ? 1 : 0;
        beyond[3] += y < -camera.slope_y * depth ? 1 : 0;
        beyond[4] += depth < 0 ? 1 : 0;
    }
    return std::ranges::find(beyond, 8) == beyond.end();
}

double distance_to_box(const Vec3& p, const Box3& box) {
    const Vec3 nearest = max(box.lower, min(p, box.upper));
    return length(p - nearest);
}

} // namespace

GeometryStream::GeometryStream(const PictureModel& model, const Vec3& origin)
    : model_(model), origin_(origin) {}

std::vector<GeometryStream::Group> GeometryStream::groups(const DrawnCamera& camera,
                                                          const std::vector<bool>& chosen) const {
    std::vector<Group> result;
    std::unordered_map<std::int64_t, std::size_t> group_of;
    for (std::uint32_t i = 0; i < model_.parts.size(); ++i) {
        const PicturePart& part = model_.parts[i];
        if (!chosen[i] || is_empty(part.view.box) || !may_be_seen(camera, part.view.box))
            continue;
        const double distance = distance_to_box(camera.eye, part.view.box);
        const auto [at, is_new] = group_of.emplace(part.mesh, result.size());
        if (is_new)
            result.push_back({part.mesh, distance, {}});
        Group& group = result[at->second];
        group.distance = std::min(group.distance, distance);
        group.parts.push_back(i);
    }
    std::ranges::sort(result, [](const Group& a, const Group& b) {
        return std::tie(a.distance, a.mesh) < std::tie(b.distance, b.mesh);
    });
    return result;
}

GeometryStream::Drawn GeometryStream::make(const Group& group) const {
    const std::shared_ptr<const Mesh> mesh = model_.mesh(group.mesh);
    Drawn drawn;
    if (group.parts.size() == 1) {
        const std::uint32_t part = group.parts.front();
        drawn.chunks =
            make_chunks(*mesh, translated(model_.parts[part].world_from_mesh, -origin_), part);
        return drawn;
    }
    drawn.chunks = make_chunks(*mesh, Transform(), 0);
    for (const std::uint32_t part : group.parts)
        drawn.instances.push_back(
            {rows_of(translated(model_.parts[part].world_from_mesh, -origin_)), part});
    return drawn;
}

void GeometryStream::draw_batch(std::span<const Group> batch,
                                const std::function<void(const ViewFrame&)>& draw) {
    std::vector<Drawn> drawn(batch.size());
    parallel_for(batch.size(), 8, [&](std::size_t i) { drawn[i] = make(batch[i]); });
    std::vector<ChunkUpload> uploads;
    std::vector<ChunkDraw> draws;
    std::vector<ChunkInstance> instances;
    for (Drawn& each : drawn) {
        const auto first = static_cast<std::uint32_t>(instances.size());
        instances.insert(instances.end(), each.instances.begin(), each.instances.end());
        for (ViewChunk& chunk : each.chunks) {
            const auto number = static_cast<std::uint32_t>(uploads.size());
            draws.push_back({number, first, static_cast<std::uint32_t>(each.instances.size())});
            uploads.push_back({number, std::make_shared<ViewChunk>(std::move(chunk))});
        }
    }
    ViewFrame frame;
    frame.uploads = uploads;
    frame.drops = drops_;
    frame.draws = draws;
    frame.instances = instances;
    draw(frame);
    drops_.clear();
    for (const ChunkUpload& each : uploads)
        drops_.push_back(each.chunk);
}

void GeometryStream::visit(const DrawnCamera& camera, const std::vector<bool>& chosen,
                           const std::function<void(const ViewFrame&)>& draw,
                           const Progress& progress) {
    const std::vector<Group> all = groups(camera, chosen);
    for (std::size_t i = 0; i < all.size(); i += kMeshesOfBatch) {
        poll_stop();
        if (progress.report)
            progress.report("draw", static_cast<double>(i) / static_cast<double>(all.size()));
        draw_batch(std::span(all).subspan(i, std::min(kMeshesOfBatch, all.size() - i)), draw);
    }
}

} // namespace abut
