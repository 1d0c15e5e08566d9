#include "clash/bcf/topic_viewpoint.h"

#include "bcf/bcf_parts.h"
#include "math/vector.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

namespace abut {

namespace {

constexpr const char *kColourOfA = "DE3E30", *kColourOfB = "346ED6";

/// Returns whether a text is a GlobalId of IFC: 128 bits in 22 characters of 6 bits each.
bool is_global_id(const std::string& id) {
    return id.size() == 22 && id.front() >= '0' && id.front() <= '3' &&
           std::ranges::all_of(id, [](char c) {
               return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                      c == '_' || c == '$';
           });
}

std::vector<BcfComponent> components_of(const std::vector<ReportPart>& parts,
                                        const std::vector<Scene>& models) {
    std::vector<BcfComponent> components;
    for (const ReportPart& part : parts) {
        const Scene& scene = models.at(part.model);
        const BcfComponent component = component_of_part(scene.file, scene.parts.at(part.part).id);
        // Two files may hold the same element.
        if (std::ranges::find(components, component) == components.end())
            components.push_back(component);
    }
    return components;
}

/// The faces of the section box. A plane's direction points to what is cut away.
std::vector<BcfClippingPlane> planes_of(const Box3& box, UpAxis up) {
    const Vec3 middle = 0.5 * box.lower + 0.5 * box.upper;
    const Vec3 half = box.upper - middle;
    std::vector<BcfClippingPlane> planes;
    for (const Vec3& normal : {Vec3{1, 0, 0}, Vec3{-1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, -1, 0},
                               Vec3{0, 0, 1}, Vec3{0, 0, -1}}) {
        const Vec3 location{middle.x + normal.x * half.x, middle.y + normal.y * half.y,
                            middle.z + normal.z * half.z};
        planes.push_back({with_z_up(location, up), with_z_up(normal, up)});
    }
    return planes;
}

} // namespace

BcfComponent component_of_part(const std::string& file, const std::string& id) {
    if (is_global_id(id))
        return {id, "", ""};
    return {"", std::filesystem::path(file).filename().string(), id};
}

Vec3 with_z_up(const Vec3& v, UpAxis up) {
    switch (up) {
    case UpAxis::x:
        return {0 - v.y, 0 - v.z, v.x};
    case UpAxis::y:
        return {v.x, 0 - v.z, v.y};
    default:
        return v;
    }
}

BcfViewpoint topic_viewpoint(const ClashViewpoint& view, UpAxis up,
                             const std::vector<Scene>& models, const std::string& topic,
                             bool clip) {
    BcfViewpoint result;
    result.guid = result.content_guid = missing_guid("viewpoint " + topic);
    result.file = "viewpoint.bcfv";
    result.has_components = true;
    const std::vector<BcfComponent> a = components_of(view.side_a, models),
                                    b = components_of(view.side_b, models);
    result.colouring = {{kColourOfA, a}, {kColourOfB, b}};
    result.selection = a;
    for (const BcfComponent& component : b)
        if (std::ranges::find(a, component) == a.end())
            result.selection.push_back(component);
    result.default_visibility = false;
    result.spaces_visible = result.space_boundaries_visible = result.openings_visible = false;
    result.exceptions = result.selection;
    for (const NamedPart& part : view.near) {
        const BcfComponent component = component_of_part(part.file, part.id);
        if (std::ranges::find(result.exceptions, component) == result.exceptions.end())
            result.exceptions.push_back(component);
    }
    BcfCamera camera;
    camera.view_point = with_z_up(view.eye, up);
    camera.direction = with_z_up(view.direction, up);
    camera.up = with_z_up(view.up, up);
    camera.size = std::round(view.fov * 180 / std::numbers::pi * 1e9) / 1e9;
    camera.aspect_ratio = view.aspect;
    result.perspective = camera;
    if (clip)
        result.clipping_planes = planes_of(view.section_box, up);
    return result;
}

} // namespace abut
