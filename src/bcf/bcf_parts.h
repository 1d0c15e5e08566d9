#pragma once

#include <abut/bcf.h>

#include "bcf/xml_reader.h"

#include <functional>
#include <string>
#include <string_view>

namespace abut {

/// Returns the GUID of something that a file left without one: the same for the same name.
std::string missing_guid(const std::string& name);

/// Reads a topic's markup. Of viewpoints only what stands there is set.
///
/// Errors      as XmlReader.
void read_markup(const XmlReader& xml, BcfTopic& topic);
/// Reads a viewpoint's own file.
///
/// Errors      as XmlReader.
void read_viewpoint(const XmlReader& xml, BcfViewpoint& viewpoint);

/// How a document reference is written in BCF 3.0.
struct DocumentTarget {
    bool is_document = false; ///< of the BCF file
    std::string guid_or_url;
};
using FindDocument = std::function<DocumentTarget(const BcfTopic&, const BcfDocumentReference&)>;

/// Returns the text of markup.bcf. `find` is asked for 3.0 only.
std::string markup_text(const BcfTopic& topic, BcfVersion version, const FindDocument& find);
/// Returns the text of a viewpoint's own file.
std::string viewpoint_text(const BcfViewpoint& viewpoint, BcfVersion version);

/// Returns a GUID as a version writes it: in 3.0 in lower case.
std::string written_guid(std::string guid, BcfVersion version);

/// Reads and writes the words that topics may use: extensions.xsd of 2.1, extensions.xml of 3.0.
BcfExtensions extensions_of_schema(const XmlReader& xml);
BcfExtensions extensions_of_xml(const XmlReader& xml);
std::string extension_schema_text(const BcfExtensions& extensions);
std::string extensions_text(const BcfExtensions& extensions);

} // namespace abut
