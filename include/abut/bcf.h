#pragma once

#include <abut/scene.h>
#include <abut/types.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

/// BCF files (BIM Collaboration Format): topics with comments and viewpoints, which programs for
/// buildings exchange. docs/bcf.md explains them. Other files of the archive are kept, and so are
/// elements and attributes beyond the format where a struct has a member `unknown`.
namespace abut {

enum class BcfVersion : std::uint8_t {
    v2_0, ///< only read; also files without a version
    v2_1,
    v3_0,
};
/// "2.0", "2.1", "3.0".
const char* to_string(BcfVersion version);

/// XML that is in a file, but not in the format.
struct BcfUnknown {
    std::vector<std::pair<std::string, std::string>> attributes; ///< names and values
    std::string elements;                                        ///< as XML text
    friend bool operator==(const BcfUnknown&, const BcfUnknown&) = default;
};

/// A part of a building.
struct BcfComponent {
    std::string ifc_guid;           ///< GlobalId, 22 characters; may be empty
    std::string originating_system; ///< the program whose id follows
    std::string authoring_tool_id;
    friend bool operator==(const BcfComponent&, const BcfComponent&) = default;
};

struct BcfColouring {
    std::string colour; ///< hexadecimal: RRGGBB, or AARRGGBB
    std::vector<BcfComponent> components;
    friend bool operator==(const BcfColouring&, const BcfColouring&) = default;
};

struct BcfCamera {
    Vec3 view_point, direction, up;
    double size = 60; ///< perspective: vertical angle in degrees; orthogonal: metres from the
                      ///< bottom of the view to its top
    std::optional<double> aspect_ratio{}; ///< width / height; only in 3.0
    friend bool operator==(const BcfCamera&, const BcfCamera&) = default;
};

/// A plane that cuts away the side to which `direction` points.
struct BcfClippingPlane {
    Vec3 location, direction;
    friend bool operator==(const BcfClippingPlane&, const BcfClippingPlane&) = default;
};

/// A picture that stands in the model.
struct BcfBitmap {
    std::string format;    ///< "png" or "jpg"
    std::string reference; ///< name of its file in the topic's folder
    Vec3 location, normal, up;
    double height = 1;
    friend bool operator==(const BcfBitmap&, const BcfBitmap&) = default;
};

/// The view of a topic that a viewer shows. Coordinates are in metres, z up.
struct BcfViewpoint {
    std::string guid;
    std::string file;          ///< name in the topic's folder; empty: only a snapshot
    std::string snapshot_file; ///< name in the topic's folder; empty: no snapshot
    std::string snapshot;      ///< the bytes of a PNG or JPEG file
    std::optional<int> index{};
    std::string content_guid;    ///< stated in the viewpoint's own file; may differ from `guid`
    bool has_components = false; ///< whether the members up to `exceptions` are stated
    std::vector<BcfComponent> selection;
    std::vector<BcfColouring> colouring;
    std::optional<bool> default_visibility{}; ///< whether parts other than `exceptions` are shown
    std::optional<bool> spaces_visible{}, space_boundaries_visible{}, openings_visible{};
    std::vector<BcfComponent> exceptions;
    std::optional<BcfCamera> perspective{}, orthogonal{};
    std::vector<std::array<Vec3, 2>> lines;
    std::vector<BcfClippingPlane> clipping_planes;
    std::vector<BcfBitmap> bitmaps;
    BcfUnknown unknown, unknown_content; ///< in the topic; in the viewpoint's own file
    friend bool operator==(const BcfViewpoint&, const BcfViewpoint&) = default;
};

/// A model file that a topic is about.
struct BcfHeaderFile {
    std::string ifc_project, ifc_spatial_structure_element; ///< GlobalIds; may be empty
    bool is_external = true; ///< false: `reference` is a path within the BCF file
    std::string filename, date, reference;
    BcfUnknown unknown;
    friend bool operator==(const BcfHeaderFile&, const BcfHeaderFile&) = default;
};

/// Data in a format of its own, in a file of the topic's folder or at an address.
struct BcfSnippet {
    std::string type;
    bool is_external = false;
    std::string reference, reference_schema;
    friend bool operator==(const BcfSnippet&, const BcfSnippet&) = default;
};

struct BcfDocumentReference {
    std::string guid;
    bool is_external = false; ///< true: `reference` is an address
    std::string reference;    ///< a path in the topic's folder; in 3.0 the GUID of a document
    std::string description;
    friend bool operator==(const BcfDocumentReference&, const BcfDocumentReference&) = default;
};

/// A document of BCF 3.0, which lies at `documents/GUID`.
struct BcfDocument {
    std::string guid, filename, description;
    friend bool operator==(const BcfDocument&, const BcfDocument&) = default;
};

struct BcfComment {
    std::string guid, date, author, text;
    std::string viewpoint; ///< GUID of a viewpoint; may be empty
    std::string modified_date, modified_author;
    BcfUnknown unknown;
    friend bool operator==(const BcfComment&, const BcfComment&) = default;
};

/// One issue. Dates are texts as XML Schema writes them: 2026-03-01T08:00:00Z. Empty texts are not
/// stated in the file.
struct BcfTopic {
    std::string folder; ///< in the file; usually the GUID
    std::string guid, type, status, server_assigned_id;
    std::vector<BcfHeaderFile> files;
    std::vector<std::string> reference_links;
    std::string title, priority;
    std::optional<int> index{};
    std::vector<std::string> labels;
    std::string creation_date, creation_author, modified_date, modified_author, due_date,
        assigned_to, stage, description;
    std::optional<BcfSnippet> snippet{};
    std::vector<BcfDocumentReference> documents;
    std::vector<std::string> related_topics; ///< GUIDs
    std::vector<BcfComment> comments;
    std::vector<BcfViewpoint> viewpoints;
    BcfUnknown unknown, unknown_markup; ///< in the topic; around it
    friend bool operator==(const BcfTopic&, const BcfTopic&) = default;
};

/// The words that topics may use.
struct BcfExtensions {
    std::vector<std::string> types, statuses, priorities, labels, users, snippet_types, stages;
    friend bool operator==(const BcfExtensions&, const BcfExtensions&) = default;
};

/// A file within the BCF file that no other member holds: snippets, documents, bitmaps.
struct BcfEntry {
    std::string name; ///< path within the BCF file
    std::string bytes;
    friend bool operator==(const BcfEntry&, const BcfEntry&) = default;
};

struct BcfFile {
    BcfVersion version = BcfVersion::v2_1; ///< of the file that was read
    std::string project_id, project_name;
    std::string extension_schema; ///< 2.1: name of the entry with the extensions
    BcfExtensions extensions;
    std::vector<BcfDocument> documents;
    std::vector<BcfTopic> topics; ///< sorted by folder
    std::vector<BcfEntry> entries;
    /// Places that other programs may read differently: one line each.
    std::vector<std::string> warnings;
    friend bool operator==(const BcfFile&, const BcfFile&) = default;
};

/// Limits of untrusted files. A file that exceeds one is an Error.
struct BcfLimits {
    std::uint64_t entries = 100'000;
    std::uint64_t bytes = 1'073'741'824;  ///< of all entries, unpacked
    std::uint64_t xml_bytes = 67'108'864; ///< of one XML entry, unpacked
};

/// Reads a BCF file. Archives and XML are checked: names that lead out of the archive, two entries
/// of one name, damaged or encrypted entries, document type declarations, text that is not UTF-8,
/// and elements nested more than 64 deep are errors.
///
/// Errors      Error, naming the file and the entry: file_not_found, unreadable, malformed,
///             unsupported (a version other than 2.0, 2.1 and 3.0).
BcfFile read_bcf(const std::string& path, const BcfLimits& limits = {});
/// As above, for the bytes of a file. `name` stands in errors.
BcfFile parse_bcf(const std::string& bytes, const std::string& name, const BcfLimits& limits = {});

/// Returns the bytes of a BCF file. The same content gives the same bytes.
///
/// Fields that the version cannot state take another form: docs/bcf.md lists them. Characters that
/// XML does not allow become U+FFFD.
///
/// Errors      Error{bad_argument} for version 2.0, a topic whose GUID is not one, a number that is
///             not finite, or two entries of one name.
std::string bcf_bytes(const BcfFile& file, BcfVersion version);
/// Writes a BCF file, atomically.
///
/// Errors      as bcf_bytes; Error{cannot_write}, naming the file.
void write_bcf(const BcfFile& file, const std::string& path, BcfVersion version = BcfVersion::v2_1);

} // namespace abut
