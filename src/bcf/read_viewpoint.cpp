#include "bcf/bcf_parts.h"

#include <algorithm>
#include <cstddef>
#include <map>

namespace abut {

namespace {

BcfComponent component_of(const XmlReader& xml, pugi::xml_node node) {
    return {xml.take_attribute(node, "IfcGuid").value_or(""),
            xml.take_text(node, "OriginatingSystem"), xml.take_text(node, "AuthoringToolId")};
}

void read_hints(const XmlReader& xml, pugi::xml_node parent, BcfViewpoint& viewpoint) {
    const pugi::xml_node hints = parent.child("ViewSetupHints");
    if (!hints)
        return;
    viewpoint.spaces_visible = xml.take_truth(hints, "SpacesVisible");
    viewpoint.space_boundaries_visible = xml.take_truth(hints, "SpaceBoundariesVisible");
    viewpoint.openings_visible = xml.take_truth(hints, "OpeningsVisible");
    parent.remove_child(hints);
}

/// Adds a component to the list of its colour. place: by colour, the number of its list.
void add_colour(BcfViewpoint& viewpoint, std::map<std::string, std::size_t>& place,
                const std::string& colour, const BcfComponent& component) {
    const auto [at, is_new] = place.try_emplace(colour, viewpoint.colouring.size());
    if (is_new)
        viewpoint.colouring.push_back({colour, {}});
    viewpoint.colouring[at->second].components.push_back(component);
}

/// In 2.0 each component states by itself whether it is selected, visible and coloured.
void read_components_of_2_0(const XmlReader& xml, pugi::xml_node all, BcfViewpoint& viewpoint) {
    std::vector<BcfComponent> hidden, shown;
    std::map<std::string, std::size_t> place;
    xml.take_each(all, "Component", [&](pugi::xml_node node) {
        const std::optional<bool> is_selected = xml.take_truth(node, "Selected");
        const std::optional<bool> is_visible = xml.take_truth(node, "Visible");
        const std::string colour = xml.take_attribute(node, "Color").value_or("");
        const BcfComponent component = component_of(xml, node);
        if (is_selected.value_or(!is_visible && colour.empty()))
            viewpoint.selection.push_back(component);
        if (is_visible)
            (*is_visible ? shown : hidden).push_back(component);
        if (!colour.empty())
            add_colour(viewpoint, place, colour, component);
    });
    // Components that are listed as visible matter only where others are hidden.
    const bool lists_visible = hidden.empty() && shown.size() > viewpoint.selection.size();
    viewpoint.default_visibility = !lists_visible;
    viewpoint.exceptions = lists_visible ? shown : hidden;
}

void read_colouring(const XmlReader& xml, pugi::xml_node all, BcfViewpoint& viewpoint) {
    xml.take_list(all, "Coloring", "Color", [&](pugi::xml_node node) {
        BcfColouring colouring{xml.take_attribute(node, "Color").value_or(""), {}};
        const auto add = [&](pugi::xml_node each) {
            colouring.components.push_back(component_of(xml, each));
        };
        xml.take_each(node, "Component", add);
        xml.take_list(node, "Components", "Component", add);
        viewpoint.colouring.push_back(std::move(colouring));
    });
}

void read_components(const XmlReader& xml, BcfViewpoint& viewpoint) {
    pugi::xml_node root = xml.root();
    const pugi::xml_node all = root.child("Components");
    if (!all)
        return;
    viewpoint.has_components = true;
    if (all.child("Component"))
        read_components_of_2_0(xml, all, viewpoint);
    read_hints(xml, all, viewpoint);
    xml.take_list(all, "Selection", "Component", [&](pugi::xml_node node) {
        viewpoint.selection.push_back(component_of(xml, node));
    });
    if (pugi::xml_node visibility = all.child("Visibility")) {
        viewpoint.default_visibility = xml.take_truth(visibility, "DefaultVisibility");
        read_hints(xml, visibility, viewpoint);
        xml.take_list(visibility, "Exceptions", "Component", [&](pugi::xml_node node) {
            viewpoint.exceptions.push_back(component_of(xml, node));
        });
    }
    read_colouring(xml, all, viewpoint);
    root.remove_child(all);
}

std::optional<BcfCamera> take_camera(const XmlReader& xml, const char* name, const char* size) {
    pugi::xml_node root = xml.root();
    const pugi::xml_node node = root.child(name);
    if (!node)
        return std::nullopt;
    BcfCamera camera;
    camera.view_point = xml.vector_of(node.child("CameraViewPoint"));
    camera.direction = xml.vector_of(node.child("CameraDirection"));
    camera.up = xml.vector_of(node.child("CameraUpVector"));
    camera.size = xml.number_of(node.child(size));
    if (const pugi::xml_node aspect = node.child("AspectRatio"))
        camera.aspect_ratio = xml.number_of(aspect);
    root.remove_child(node);
    return camera;
}

void read_bitmap(const XmlReader& xml, pugi::xml_node node, BcfViewpoint& viewpoint) {
    const pugi::xml_node format =
        node.child("Format") ? node.child("Format") : node.child("Bitmap");
    BcfBitmap bitmap{xml.text_of(format),
                     xml.text_of(node.child("Reference")),
                     xml.vector_of(node.child("Location")),
                     xml.vector_of(node.child("Normal")),
                     xml.vector_of(node.child("Up")),
                     xml.number_of(node.child("Height"))};
    std::ranges::transform(bitmap.format, bitmap.format.begin(), [](char c) {
        return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    });
    viewpoint.bitmaps.push_back(std::move(bitmap));
}

/// 2.1 repeats an element `Bitmap`, 2.0 an element `Bitmaps`; 3.0 has a list `Bitmaps`.
void read_bitmaps(const XmlReader& xml, BcfViewpoint& viewpoint) {
    const auto read = [&](pugi::xml_node node) { read_bitmap(xml, node, viewpoint); };
    xml.take_each(xml.root(), "Bitmap", read);
    xml.take_each(xml.root(), "Bitmaps", [&](pugi::xml_node node) {
        if (node.child("Reference"))
            read(node);
        else
            xml.take_each(node, "Bitmap", read);
    });
}

} // namespace

void read_viewpoint(const XmlReader& xml, BcfViewpoint& viewpoint) {
    viewpoint.content_guid = xml.take_attribute(xml.root(), "Guid").value_or("");
    read_components(xml, viewpoint);
    viewpoint.orthogonal = take_camera(xml, "OrthogonalCamera", "ViewToWorldScale");
    viewpoint.perspective = take_camera(xml, "PerspectiveCamera", "FieldOfView");
    xml.take_list(xml.root(), "Lines", "Line", [&](pugi::xml_node node) {
        viewpoint.lines.push_back(
            {xml.vector_of(node.child("StartPoint")), xml.vector_of(node.child("EndPoint"))});
    });
    xml.take_list(xml.root(), "ClippingPlanes", "ClippingPlane", [&](pugi::xml_node node) {
        viewpoint.clipping_planes.push_back(
            {xml.vector_of(node.child("Location")), xml.vector_of(node.child("Direction"))});
    });
    read_bitmaps(xml, viewpoint);
    viewpoint.unknown_content = xml.take_unknown(xml.root());
}

} // namespace abut
