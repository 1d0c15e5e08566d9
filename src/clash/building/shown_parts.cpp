#include "clash/building/shown_parts.h"

#include <abut/broad_phase.h>

#include "math/vector.h"

#include <algorithm>

namespace abut {

namespace {

/// A part whose box is this near to a clash is shown as one of its surroundings, in metres.
constexpr double kNear = 1.0;

/// Marks the parts whose boxes are near a point.
void mark_near(const BuildingSource& source, std::span<const Vec3> points,
               std::vector<PartDetail>& detail) {
    std::vector<Box3> boxes;
    boxes.reserve(source.parts().size() + points.size());
    for (const BuildingPart& part : source.parts())
        boxes.push_back(part.box);
    for (const Vec3& point : points)
        boxes.push_back({point, point});
    const auto parts = static_cast<std::uint32_t>(source.parts().size());
    const auto filter = [parts](std::uint32_t i, std::uint32_t k) {
        return i < parts && k >= parts;
    };
    for (const IndexPair& pair : overlapping_boxes(boxes, kNear, filter))
        if (detail[pair.a()] == PartDetail::rest)
            detail[pair.a()] = PartDetail::near;
}

double size_of(const Box3& box) {
    return length_sq(box.upper - box.lower);
}

} // namespace

std::vector<ShownPart> choose_parts(const BuildingSource& source,
                                    std::span<const std::uint32_t> clashing,
                                    std::span<const Vec3> points, std::size_t most) {
    std::vector<PartDetail> detail(source.parts().size(), PartDetail::rest);
    for (const std::uint32_t part : clashing)
        detail[part] = PartDetail::clash;
    mark_near(source, points, detail);
    std::vector<ShownPart> shown;
    for (std::uint32_t part = 0; part < detail.size(); ++part) {
        const BuildingPart& row = source.parts()[part];
        if (!is_empty(row.box) && source.meshes()[row.mesh].triangles > 0)
            shown.push_back({part, detail[part]});
    }
    const auto before = [&](const ShownPart& a, const ShownPart& b) {
        if (a.detail != b.detail)
            return a.detail < b.detail;
        const double size_a = size_of(source.parts()[a.part].box),
                     size_b = size_of(source.parts()[b.part].box);
        return size_a != size_b ? size_a > size_b : a.part < b.part;
    };
    if (shown.size() > most) {
        const auto clash_count = static_cast<std::size_t>(
            std::ranges::count(shown, PartDetail::clash, &ShownPart::detail));
        std::ranges::sort(shown, before);
        shown.resize(std::max(most, clash_count));
    }
    std::ranges::sort(shown, [](const ShownPart& a, const ShownPart& b) {
        return a.detail != b.detail ? a.detail < b.detail : a.part < b.part;
    });
    return shown;
}

} // namespace abut
