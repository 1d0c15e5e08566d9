#include <abut/bcf.h>

#include "models/scenes.h"
#include "module.h"
#include "support/records.h"

#include <concepts>

namespace abut::python {

namespace {

/// A struct that Python may make and change. Lists are copies: change one by assigning it.
template <class T>
class EditableBinder {
public:
    EditableBinder(py::module_& module, const char* name, const char* doc)
        : class_(module, name, doc) {
        class_.def(py::init<>());
        if constexpr (std::equality_comparable<T>)
            class_.def(
                "__eq__", [](const T& a, const T& b) { return a == b; }, py::is_operator());
    }
    template <class Member>
    EditableBinder& field(const char* name, Member T::*member, const char* doc) {
        class_.def_property(
            name, [member](const T& self) -> Member { return self.*member; },
            [member](T& self, const Member& value) { self.*member = value; }, doc);
        return *this;
    }
    EditableBinder& bytes(const char* name, std::string T::*member, const char* doc) {
        class_.def_property(
            name, [member](const T& self) { return py::bytes(self.*member); },
            [member](T& self, const py::bytes& value) { self.*member = std::string(value); }, doc);
        return *this;
    }

private:
    py::class_<T> class_;
};

void bind_bcf_components(py::module_& module) {
    EditableBinder<BcfUnknown>(module, "BcfUnknown", "XML that is in a file, but not in BCF.")
        .field("attributes", &BcfUnknown::attributes, "list of names and values")
        .field("elements", &BcfUnknown::elements, "XML text");
    EditableBinder<BcfComponent>(module, "BcfComponent", "A part of a building.")
        .field("ifc_guid", &BcfComponent::ifc_guid, "GlobalId, 22 characters; may be empty")
        .field("originating_system", &BcfComponent::originating_system,
               "the program whose id follows")
        .field("authoring_tool_id", &BcfComponent::authoring_tool_id, "");
    EditableBinder<BcfColouring>(module, "BcfColouring", "Parts of one colour.")
        .field("colour", &BcfColouring::colour, "RRGGBB or AARRGGBB")
        .field("components", &BcfColouring::components, "list of BcfComponent");
    EditableBinder<BcfCamera>(module, "BcfCamera", "A camera; metres, z up.")
        .field("view_point", &BcfCamera::view_point, "")
        .field("direction", &BcfCamera::direction, "")
        .field("up", &BcfCamera::up, "")
        .field("size", &BcfCamera::size,
               "perspective: vertical angle in degrees; orthogonal: metres")
        .field("aspect_ratio", &BcfCamera::aspect_ratio, "width / height; None: not stated");
    EditableBinder<BcfClippingPlane>(module, "BcfClippingPlane", "Cuts away one side.")
        .field("location", &BcfClippingPlane::location, "")
        .field("direction", &BcfClippingPlane::direction, "points to what is cut away");
    EditableBinder<BcfBitmap>(module, "BcfBitmap", "A picture that stands in the model.")
        .field("format", &BcfBitmap::format, "png or jpg")
        .field("reference", &BcfBitmap::reference, "name of its file")
        .field("location", &BcfBitmap::location, "")
        .field("normal", &BcfBitmap::normal, "")
        .field("up", &BcfBitmap::up, "")
        .field("height", &BcfBitmap::height, "metres");
}

void bind_bcf_viewpoint(py::module_& module) {
    EditableBinder<BcfViewpoint>(module, "BcfViewpoint", "What a viewer shows; metres, z up.")
        .field("guid", &BcfViewpoint::guid, "")
        .field("file", &BcfViewpoint::file, "name in the topic's folder; empty: only a snapshot")
        .field("snapshot_file", &BcfViewpoint::snapshot_file, "name; empty: no snapshot")
        .bytes("snapshot", &BcfViewpoint::snapshot, "of a PNG or JPEG file")
        .field("index", &BcfViewpoint::index, "")
        .field("content_guid", &BcfViewpoint::content_guid, "stated in the viewpoint's own file")
        .field("has_components", &BcfViewpoint::has_components, "whether components are stated")
        .field("selection", &BcfViewpoint::selection, "list of BcfComponent")
        .field("colouring", &BcfViewpoint::colouring, "list of BcfColouring")
        .field("default_visibility", &BcfViewpoint::default_visibility,
               "whether parts other than the exceptions are shown")
        .field("spaces_visible", &BcfViewpoint::spaces_visible, "")
        .field("space_boundaries_visible", &BcfViewpoint::space_boundaries_visible, "")
        .field("openings_visible", &BcfViewpoint::openings_visible, "")
        .field("exceptions", &BcfViewpoint::exceptions, "list of BcfComponent")
        .field("perspective", &BcfViewpoint::perspective, "BcfCamera or None")
        .field("orthogonal", &BcfViewpoint::orthogonal, "BcfCamera or None")
        .field("lines", &BcfViewpoint::lines, "list of pairs of points")
        .field("clipping_planes", &BcfViewpoint::clipping_planes, "list of BcfClippingPlane")
        .field("bitmaps", &BcfViewpoint::bitmaps, "list of BcfBitmap")
        .field("unknown", &BcfViewpoint::unknown, "BcfUnknown, of the topic's file")
        .field("unknown_content", &BcfViewpoint::unknown_content, "BcfUnknown, of its own file");
}

void bind_bcf_topic(py::module_& module) {
    EditableBinder<BcfHeaderFile>(module, "BcfHeaderFile", "A model that a topic is about.")
        .field("ifc_project", &BcfHeaderFile::ifc_project, "GlobalId; may be empty")
        .field("ifc_spatial_structure_element", &BcfHeaderFile::ifc_spatial_structure_element, "")
        .field("is_external", &BcfHeaderFile::is_external, "")
        .field("filename", &BcfHeaderFile::filename, "")
        .field("date", &BcfHeaderFile::date, "")
        .field("reference", &BcfHeaderFile::reference, "")
        .field("unknown", &BcfHeaderFile::unknown, "BcfUnknown");
    EditableBinder<BcfSnippet>(module, "BcfSnippet", "Data in a format of its own.")
        .field("type", &BcfSnippet::type, "")
        .field("is_external", &BcfSnippet::is_external, "")
        .field("reference", &BcfSnippet::reference, "")
        .field("reference_schema", &BcfSnippet::reference_schema, "");
    EditableBinder<BcfDocumentReference>(module, "BcfDocumentReference", "A link to a document.")
        .field("guid", &BcfDocumentReference::guid, "")
        .field("is_external", &BcfDocumentReference::is_external, "True: an address")
        .field("reference", &BcfDocumentReference::reference, "")
        .field("description", &BcfDocumentReference::description, "");
    EditableBinder<BcfComment>(module, "BcfComment", "A comment of a topic.")
        .field("guid", &BcfComment::guid, "")
        .field("date", &BcfComment::date, "")
        .field("author", &BcfComment::author, "")
        .field("text", &BcfComment::text, "")
        .field("viewpoint", &BcfComment::viewpoint, "GUID; may be empty")
        .field("modified_date", &BcfComment::modified_date, "")
        .field("modified_author", &BcfComment::modified_author, "")
        .field("unknown", &BcfComment::unknown, "BcfUnknown");
    EditableBinder<BcfTopic>(module, "BcfTopic", "One issue. Texts that are not stated are empty.")
        .field("folder", &BcfTopic::folder, "in the file")
        .field("guid", &BcfTopic::guid, "")
        .field("type", &BcfTopic::type, "")
        .field("status", &BcfTopic::status, "")
        .field("server_assigned_id", &BcfTopic::server_assigned_id, "")
        .field("files", &BcfTopic::files, "list of BcfHeaderFile")
        .field("reference_links", &BcfTopic::reference_links, "")
        .field("title", &BcfTopic::title, "")
        .field("priority", &BcfTopic::priority, "")
        .field("index", &BcfTopic::index, "")
        .field("labels", &BcfTopic::labels, "")
        .field("creation_date", &BcfTopic::creation_date, "as 2026-03-01T08:00:00Z")
        .field("creation_author", &BcfTopic::creation_author, "")
        .field("modified_date", &BcfTopic::modified_date, "")
        .field("modified_author", &BcfTopic::modified_author, "")
        .field("due_date", &BcfTopic::due_date, "")
        .field("assigned_to", &BcfTopic::assigned_to, "")
        .field("stage", &BcfTopic::stage, "")
        .field("description", &BcfTopic::description, "")
        .field("snippet", &BcfTopic::snippet, "BcfSnippet or None")
        .field("documents", &BcfTopic::documents, "list of BcfDocumentReference")
        .field("related_topics", &BcfTopic::related_topics, "GUIDs")
        .field("comments", &BcfTopic::comments, "list of BcfComment")
        .field("viewpoints", &BcfTopic::viewpoints, "list of BcfViewpoint")
        .field("unknown", &BcfTopic::unknown, "BcfUnknown, in the topic")
        .field("unknown_markup", &BcfTopic::unknown_markup, "BcfUnknown, around the topic");
}

void bind_bcf_file(py::module_& module) {
    EditableBinder<BcfDocument>(module, "BcfDocument", "A document of BCF 3.0.")
        .field("guid", &BcfDocument::guid, "")
        .field("filename", &BcfDocument::filename, "")
        .field("description", &BcfDocument::description, "");
    EditableBinder<BcfExtensions>(module, "BcfExtensions", "The words that topics may use.")
        .field("types", &BcfExtensions::types, "")
        .field("statuses", &BcfExtensions::statuses, "")
        .field("priorities", &BcfExtensions::priorities, "")
        .field("labels", &BcfExtensions::labels, "")
        .field("users", &BcfExtensions::users, "")
        .field("snippet_types", &BcfExtensions::snippet_types, "")
        .field("stages", &BcfExtensions::stages, "");
    EditableBinder<BcfEntry>(module, "BcfEntry", "A file within a BCF file.")
        .field("name", &BcfEntry::name, "path within the BCF file")
        .bytes("bytes", &BcfEntry::bytes, "");
    EditableBinder<BcfFile>(module, "BcfFile", "Returned by read_bcf.")
        .field("version", &BcfFile::version, "BcfVersion of the file that was read")
        .field("project_id", &BcfFile::project_id, "")
        .field("project_name", &BcfFile::project_name, "")
        .field("extension_schema", &BcfFile::extension_schema, "")
        .field("extensions", &BcfFile::extensions, "BcfExtensions")
        .field("documents", &BcfFile::documents, "list of BcfDocument")
        .field("topics", &BcfFile::topics, "list of BcfTopic, sorted by folder")
        .field("entries", &BcfFile::entries, "list of BcfEntry: what no other member holds")
        .field("warnings", &BcfFile::warnings, "");
    EditableBinder<BcfLimits>(module, "BcfLimits", "Limits of untrusted files.")
        .field("entries", &BcfLimits::entries, "")
        .field("bytes", &BcfLimits::bytes, "of all entries, unpacked")
        .field("xml_bytes", &BcfLimits::xml_bytes, "of one XML entry, unpacked");
}

} // namespace

void bind_bcf(py::module_& module) {
    bind_enum<BcfVersion>(module, "BcfVersion", {"v2_0", "v2_1", "v3_0"}, "A version of BCF.");
    bind_bcf_components(module);
    bind_bcf_viewpoint(module);
    bind_bcf_topic(module);
    bind_bcf_file(module);
    module.def(
        "read_bcf",
        [](const py::object& path, const BcfLimits& limits) {
            return read_bcf(to_path(path), limits);
        },
        py::arg("path"), py::arg("limits") = BcfLimits{},
        "Reads a BCF file of version 2.0, 2.1 or 3.0. Returns a BcfFile. Raises Error: "
        "file_not_found, unreadable, malformed, unsupported.");
    module.def(
        "parse_bcf",
        [](const py::bytes& bytes, const std::string& name, const BcfLimits& limits) {
            return parse_bcf(bytes, name, limits);
        },
        py::arg("bytes"), py::arg("name"), py::arg("limits") = BcfLimits{},
        "As read_bcf, for the bytes of a file; `name` stands in errors.");
    module.def(
        "bcf_bytes",
        [](const BcfFile& file, BcfVersion version) { return py::bytes(bcf_bytes(file, version)); },
        py::arg("file"), py::arg("version") = BcfVersion::v2_1,
        "The bytes of a BCF file. Raises Error (bad_argument).");
    module.def(
        "write_bcf",
        [](const BcfFile& file, const py::object& path, BcfVersion version) {
            write_bcf(file, to_path(path), version);
        },
        py::arg("file"), py::arg("path"), py::arg("version") = BcfVersion::v2_1,
        "Writes a BCF file of version 2.1 or 3.0. Raises Error: bad_argument, cannot_write.");
}

} // namespace abut::python
