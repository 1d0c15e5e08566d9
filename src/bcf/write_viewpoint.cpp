#include "bcf/bcf_parts.h"
#include "bcf/xml_text.h"
#include "core/uuid.h"

namespace abut {

namespace {

void write_list_of_components(XmlText& xml, const std::vector<BcfComponent>& components) {
    for (const BcfComponent& component : components) {
        xml.open("Component");
        if (!component.ifc_guid.empty())
            xml.attribute("IfcGuid", component.ifc_guid);
        xml.optional_leaf("OriginatingSystem", component.originating_system);
        xml.optional_leaf("AuthoringToolId", component.authoring_tool_id);
        xml.close();
    }
}

void write_hints(XmlText& xml, const BcfViewpoint& viewpoint) {
    if (!viewpoint.spaces_visible && !viewpoint.space_boundaries_visible &&
        !viewpoint.openings_visible)
        return;
    xml.open("ViewSetupHints");
    xml.attribute("SpacesVisible", viewpoint.spaces_visible);
    xml.attribute("SpaceBoundariesVisible", viewpoint.space_boundaries_visible);
    xml.attribute("OpeningsVisible", viewpoint.openings_visible);
    xml.close();
}

void write_colouring(XmlText& xml, const BcfViewpoint& viewpoint, bool is_3) {
    bool is_open = false;
    for (const BcfColouring& colouring : viewpoint.colouring) {
        if (colouring.components.empty())
            continue;
        if (!is_open)
            xml.open("Coloring");
        is_open = true;
        xml.open("Color");
        xml.attribute("Color", std::string_view(colouring.colour));
        if (is_3)
            xml.open("Components");
        write_list_of_components(xml, colouring.components);
        if (is_3)
            xml.close();
        xml.close();
    }
    if (is_open)
        xml.close();
}

void write_components(XmlText& xml, const BcfViewpoint& viewpoint, bool is_3) {
    if (!viewpoint.has_components)
        return;
    xml.open("Components");
    if (!is_3)
        write_hints(xml, viewpoint);
    if (!viewpoint.selection.empty()) {
        xml.open("Selection");
        write_list_of_components(xml, viewpoint.selection);
        xml.close();
    }
    xml.open("Visibility");
    xml.attribute("DefaultVisibility", viewpoint.default_visibility);
    if (is_3)
        write_hints(xml, viewpoint);
    if (!viewpoint.exceptions.empty()) {
        xml.open("Exceptions");
        write_list_of_components(xml, viewpoint.exceptions);
        xml.close();
    }
    xml.close();
    write_colouring(xml, viewpoint, is_3);
    xml.close();
}

void write_camera(XmlText& xml, const std::optional<BcfCamera>& camera, const char* name,
                  const char* size, bool is_3) {
    if (!camera)
        return;
    xml.open(name);
    xml.leaf("CameraViewPoint", camera->view_point);
    xml.leaf("CameraDirection", camera->direction);
    xml.leaf("CameraUpVector", camera->up);
    xml.leaf(size, camera->size);
    if (is_3)
        xml.leaf("AspectRatio", camera->aspect_ratio.value_or(1));
    xml.close();
}

void write_lines_and_planes(XmlText& xml, const BcfViewpoint& viewpoint) {
    if (!viewpoint.lines.empty()) {
        xml.open("Lines");
        for (const std::array<Vec3, 2>& line : viewpoint.lines) {
            xml.open("Line");
            xml.leaf("StartPoint", line[0]);
            xml.leaf("EndPoint", line[1]);
            xml.close();
        }
        xml.close();
    }
    if (!viewpoint.clipping_planes.empty()) {
        xml.open("ClippingPlanes");
        for (const BcfClippingPlane& plane : viewpoint.clipping_planes) {
            xml.open("ClippingPlane");
            xml.leaf("Location", plane.location);
            xml.leaf("Direction", plane.direction);
            xml.close();
        }
        xml.close();
    }
}

void write_bitmaps(XmlText& xml, const BcfViewpoint& viewpoint, bool is_3) {
    if (is_3 && !viewpoint.bitmaps.empty())
        xml.open("Bitmaps");
    for (const BcfBitmap& bitmap : viewpoint.bitmaps) {
        xml.open("Bitmap");
        std::string format = bitmap.format;
        if (!is_3)
            for (char& c : format)
                c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
        xml.leaf(is_3 ? "Format" : "Bitmap", std::string_view(format));
        xml.leaf("Reference", std::string_view(bitmap.reference));
        xml.leaf("Location", bitmap.location);
        xml.leaf("Normal", bitmap.normal);
        xml.leaf("Up", bitmap.up);
        xml.leaf("Height", bitmap.height);
        xml.close();
    }
    if (is_3 && !viewpoint.bitmaps.empty())
        xml.close();
}

} // namespace

std::string viewpoint_text(const BcfViewpoint& viewpoint, BcfVersion version) {
    const bool is_3 = version == BcfVersion::v3_0;
    XmlText xml("VisualizationInfo");
    const std::string& own = viewpoint.content_guid;
    xml.attribute("Guid",
                  std::string_view(written_guid(is_uuid(own) ? own : viewpoint.guid, version)));
    xml.unknown_attributes(viewpoint.unknown_content);
    write_components(xml, viewpoint, is_3);
    // 3.0 allows one camera only.
    if (!is_3 || !viewpoint.perspective)
        write_camera(xml, viewpoint.orthogonal, "OrthogonalCamera", "ViewToWorldScale", is_3);
    write_camera(xml, viewpoint.perspective, "PerspectiveCamera", "FieldOfView", is_3);
    write_lines_and_planes(xml, viewpoint);
    write_bitmaps(xml, viewpoint, is_3);
    xml.unknown_elements(viewpoint.unknown_content);
    return xml.finish();
}

} // namespace abut
