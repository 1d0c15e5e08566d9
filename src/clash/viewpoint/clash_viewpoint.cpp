#include <abut/clash_viewpoint.h>
#include <abut/model.h>

#include "clash/classify_pair.h"
#include "clash/rules/pair_precision.h"
#include "clash/viewpoint/choose_view.h"
#include "clash/viewpoint/view_geometry.h"
#include "core/arguments.h"
#include "core/parallel.h"
#include "core/stop.h"
#include "store/database/store_file.h"
#include "view/camera/camera_frame.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <utility>

namespace abut {

namespace {

/// The section box reaches this much farther than the picture's frame, in half sides of the frame.
constexpr double kSurroundings = 0.6;
/// How many bystanders and triangles decide about a view.
constexpr std::size_t kMostBystanders = 256, kMostTriangles = 20'000;
/// The height of the trial lens in pixels; only its ratio to the width matters.
constexpr std::uint32_t kLensHeight = 1000;

void require_viewpoint_options(const ViewpointOptions& options) {
    require(options.fov > 0 && options.fov < std::numbers::pi,
            "field of view must be between 0 and pi");
    require(options.aspect >= 0.1 && options.aspect <= 10, "aspect must be between 0.1 and 10");
}

/// The subject of one viewpoint.
class Subject {
public:
    Subject(const ClashReport& report, const ViewGeometry& geometry,
            const std::vector<std::uint32_t>& clashes)
        : geometry_(geometry) {
        find_sides(report, clashes);
        for (const std::uint32_t index : clashes) {
            const Clash& clash = report.clashes[index];
            PairPlace pair{{clash.point_a, clash.point_b}, {}};
            for (std::size_t i = 0; i < 2; ++i)
                pair.boxes.at(i) = box_of({clash.model.at(i), clash.part.at(i)});
            const double reach = reach_of(pair);
            const Vec3 middle = 0.5 * pair.points[0] + 0.5 * pair.points[1];
            take(frame_, grown({middle, middle}, reach));
            take(section_, grown({middle, middle}, (1 + kSurroundings) * reach));
            reach_ = std::max(reach_, reach);
        }
    }

    [[nodiscard]] ClashViewpoint view(const ViewpointOptions& options) const {
        ClashViewpoint result;
        result.side_a = sides_[0];
        result.side_b = sides_[1];
        result.section_box = section_;
        ViewSubject subject = subject_of(result.section_box);
        Camera lens;
        lens.field_of_view = options.fov;
        lens.height = kLensHeight;
        lens.width = static_cast<std::uint32_t>(std::lround(options.aspect * kLensHeight));
        ChosenView chosen = choose_view(subject, geometry_.up, lens);
        if (std::min(chosen.shown[0], chosen.shown[1]) < kLeastShown) {
            ChosenView opened = open(subject, chosen, result.section_box, lens);
            if (std::min(opened.shown[0], opened.shown[1]) >
                std::min(chosen.shown[0], chosen.shown[1]))
                chosen = opened;
            else
                result.section_box = section_;
        }
        const CameraFrame frame(chosen.camera);
        result.eye = frame.eye;
        result.direction = frame.forward;
        result.up = frame.up;
        result.fov = options.fov;
        result.aspect = options.aspect;
        result.shown_a = chosen.shown[0];
        result.shown_b = chosen.shown[1];
        if (options.near)
            name_near(result);
        return result;
    }

private:
    void find_sides(const ClashReport& report, const std::vector<std::uint32_t>& clashes) {
        std::map<ReportPart, std::size_t> uses;
        for (const std::uint32_t index : clashes)
            for (std::size_t i = 0; i < 2; ++i)
                ++uses[part_of(report.clashes[index], i)];
        std::size_t most = 1;
        ReportPart shared;
        for (const auto& [part, count] : uses)
            if (count > most)
                most = count, shared = part;
        std::set<ReportPart> a, b;
        for (const std::uint32_t index : clashes) {
            const Clash& clash = report.clashes[index];
            const std::size_t first = most > 1 && part_of(clash, 1) == shared ? 1 : 0;
            a.insert(part_of(clash, first));
            b.insert(part_of(clash, 1 - first));
        }
        for (const ReportPart& part : a) // a part that is on both sides stays on the first
            b.erase(part);
        sides_ = {std::vector(a.begin(), a.end()), std::vector(b.begin(), b.end())};
    }

    static ReportPart part_of(const Clash& clash, std::size_t i) {
        return {clash.model.at(i), clash.part.at(i)};
    }
    [[nodiscard]] const Box3& box_of(const ReportPart& part) const {
        return geometry_.boxes[geometry_.number(part)];
    }
    static void take(Box3& box, const Box3& with) {
        extend(box, with.lower);
        extend(box, with.upper);
    }

    /// The bystanders nearest to the middle, by number.
    [[nodiscard]] std::vector<std::uint32_t> near_parts(const Box3& section,
                                                        std::size_t most) const {
        std::set<std::uint32_t> members;
        for (const std::vector<ReportPart>& side : sides_)
            for (const ReportPart& part : side)
                members.insert(geometry_.number(part));
        std::vector<std::pair<double, std::uint32_t>> near;
        const Vec3 middle = 0.5 * frame_.lower + 0.5 * frame_.upper;
        for (std::uint32_t i = 0; i < geometry_.boxes.size(); ++i) {
            const Box3& box = geometry_.boxes[i];
            if (is_empty(box) || !overlap(box, section) || members.contains(i))
                continue;
            near.emplace_back(length_sq(max(min(middle, box.upper), box.lower) - middle), i);
        }
        std::ranges::sort(near);
        near.resize(std::min(near.size(), most));
        std::vector<std::uint32_t> parts;
        parts.reserve(near.size());
        for (const auto& [distance, part] : near)
            parts.push_back(part);
        std::ranges::sort(parts);
        return parts;
    }

    [[nodiscard]] ViewSubject subject_of(const Box3& section) const {
        ViewSubject subject;
        subject.frame = frame_;
        subject.middle = 0.5 * frame_.lower + 0.5 * frame_.upper;
        const auto add = [&](std::uint32_t part, std::uint32_t owner) {
            geometry_.gather(part, section, subject.geometry.triangles);
            subject.geometry.owner.resize(subject.geometry.triangles.size(), owner);
        };
        for (std::uint8_t side = 0; side < 2; ++side)
            for (const ReportPart& part : sides_.at(side)) {
                add(geometry_.number(part), static_cast<std::uint32_t>(subject.side.size()));
                subject.side.push_back(side);
            }
        for (const std::uint32_t part : near_parts(section, kMostBystanders))
            add(part, kBystander);
        keep_largest(subject.geometry, kMostTriangles);
        cut_to_box(subject.geometry, section);
        return subject;
    }

    /// Moves a face of the section box so that it cuts open what hides a side.
    [[nodiscard]] ChosenView open(ViewSubject& subject, const ChosenView& chosen, Box3& section,
                                  const Camera& lens) const {
        std::array<Box3, 2> boxes;
        for (std::size_t side = 0; side < 2; ++side)
            for (const ReportPart& part : sides_.at(side))
                if (const Box3& box = box_of(part); !is_empty(box))
                    take(boxes.at(side), box);
        const auto size = [](const Box3& box) { return length(box.upper - box.lower); };
        const Box3& hidden = size(boxes[0]) < size(boxes[1]) ? boxes[0] : boxes[1];
        const Opening opening = opening_before(normalized_or_zero(chosen.camera.forward), hidden,
                                               subject.middle, reach_);
        const Vec3& n = opening.normal;
        section.upper = {n.x > 0 ? std::min(section.upper.x, opening.offset) : section.upper.x,
                         n.y > 0 ? std::min(section.upper.y, opening.offset) : section.upper.y,
                         n.z > 0 ? std::min(section.upper.z, opening.offset) : section.upper.z};
        section.lower = {n.x < 0 ? std::max(section.lower.x, -opening.offset) : section.lower.x,
                         n.y < 0 ? std::max(section.lower.y, -opening.offset) : section.lower.y,
                         n.z < 0 ? std::max(section.lower.z, -opening.offset) : section.lower.z};
        cut_to_plane(subject.geometry, opening.normal, opening.offset);
        subject.section = opening.normal;
        return choose_view(subject, geometry_.up, lens);
    }

    void name_near(ClashViewpoint& result) const {
        for (const std::uint32_t part : near_parts(result.section_box, kMostBystanders))
            result.near.push_back(geometry_.name(part));
        std::ranges::sort(result.near);
    }

    const ViewGeometry& geometry_;
    std::array<std::vector<ReportPart>, 2> sides_;
    Box3 frame_, section_;
    double reach_ = 0;
};

std::vector<ClashViewpoint> viewpoints_of(const ClashReport& report, const ViewGeometry& geometry,
                                          const std::vector<std::vector<std::uint32_t>>& clashes,
                                          const ViewpointOptions& options) {
    std::vector<ClashViewpoint> views(clashes.size());
    parallel_for(clashes.size(), 1, [&](std::size_t i) {
        if (!clashes[i].empty())
            views[i] = Subject(report, geometry, clashes[i]).view(options);
    });
    if (options.progress.report)
        options.progress.report("viewpoints", 1);
    return views;
}

void require_clashes(const ClashReport& report,
                     const std::vector<std::vector<std::uint32_t>>& clashes) {
    for (const std::vector<std::uint32_t>& list : clashes)
        for (const std::uint32_t index : list)
            require(index < report.clashes.size(), "the report has no clash of this index");
}

/// A clash of two parts as a job finds it, with the witness points.
Clash clash_again(const Store& store, const NamedGeometry& named) {
    std::array<std::optional<Model>, 2> models;
    for (std::size_t i = 0; i < 2; ++i)
        models.at(i) = Model(store.file().read_mesh(named.parts[i].row.mesh));
    Box3 both = named.parts[0].row.box;
    extend(both, named.parts[1].row.box.lower);
    extend(both, named.parts[1].row.box.upper);
    const double farthest = length(both.upper - both.lower); // no two points are farther apart
    PairPrecision precision;                                 // that of a job without options
    for (const auto& [place, row] : named.parts) {
        const ModelPrecision of_model = store.file().precision(row.model);
        const Vec3 reach = reach_of(store.file().mesh(row.mesh).box);
        precision.add(place.model, of_model.stated,
                      single_rounding(of_model, reach, row.world_from_mesh));
    }
    const auto part = [&](std::size_t i) {
        const PartRow& row = named.parts[i].row;
        return ClashPart{&*models.at(i), nullptr, row.world_from_mesh, row.box,
                         0.5 * precision.rounding(0, 1)};
    };
    std::optional<Clash> clash =
        classify_by_id(part(0), named.parts[0].row.id, part(1), named.parts[1].row.id, farthest,
                       precision.tolerance(0, 1));
    require(clash.has_value(), "a part of the clash has no surface");
    for (std::size_t i = 0; i < 2; ++i) {
        clash->model.at(i) = named.parts[i].place.model;
        clash->part.at(i) = named.parts[i].place.part;
    }
    return *clash;
}

} // namespace

std::vector<ClashViewpoint> clash_viewpoints(const ClashReport& report,
                                             const std::vector<Scene>& models,
                                             const std::vector<std::vector<std::uint32_t>>& clashes,
                                             const ViewpointOptions& options) {
    require_viewpoint_options(options);
    require_clashes(report, clashes);
    const StopScope stop(options.progress);
    return viewpoints_of(report, *view_geometry(models), clashes, options);
}

std::vector<ClashViewpoint> clash_viewpoints(const StoreClashReport& found, const Store& store,
                                             const std::vector<std::vector<std::uint32_t>>& clashes,
                                             const ViewpointOptions& options) {
    require_viewpoint_options(options);
    require_clashes(found.report, clashes);
    const StopScope stop(options.progress);
    return viewpoints_of(found.report, *view_geometry(store, found.models), clashes, options);
}

ClashViewpoint clash_viewpoint(const ClashReport& report, const std::vector<Scene>& models,
                               std::uint32_t clash, const ViewpointOptions& options) {
    return clash_viewpoints(report, models, {{clash}}, options).front();
}

ClashViewpoint clash_viewpoint(const StoreClashReport& found, const Store& store,
                               std::uint32_t clash, const ViewpointOptions& options) {
    return clash_viewpoints(found, store, {{clash}}, options).front();
}

ClashViewpoint clash_viewpoint(const Store& store, const ListedClash& clash,
                               const ViewpointOptions& options) {
    require_viewpoint_options(options);
    const StopScope stop(options.progress);
    const std::array<NamedPart, 2> words{NamedPart{clash.file[0], clash.part[0]},
                                         NamedPart{clash.file[1], clash.part[1]}};
    const NamedGeometry named = view_geometry(store, words);
    ClashReport report;
    report.clashes.push_back(clash_again(store, named));
    return viewpoints_of(report, *named.geometry, {{0}}, options).front();
}

} // namespace abut
