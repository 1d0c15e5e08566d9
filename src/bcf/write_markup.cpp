#include "bcf/bcf_parts.h"
#include "bcf/xml_text.h"
#include "core/uuid.h"

#include <string>

namespace abut {

namespace {

/// Stands in for a required text that is missing.
std::string stated(const std::string& text, const char* otherwise) {
    return is_blank(text) ? otherwise : text;
}

constexpr const char* kUndefined = "Undefined";
constexpr const char* kNoDate = "1970-01-01T00:00:00Z";
constexpr const char* kNobody = "unknown";

/// Writes the markup of one topic.
class MarkupWriter {
public:
    MarkupWriter(const BcfTopic& topic, BcfVersion version, const FindDocument& find)
        : topic_(topic), version_(version), is_3_(version == BcfVersion::v3_0), find_(find) {}

    std::string text() {
        xml_.unknown_attributes(topic_.unknown_markup);
        write_header();
        write_topic();
        if (!is_3_) {
            write_comments();
            write_viewpoints();
        }
        xml_.unknown_elements(topic_.unknown_markup);
        return xml_.finish();
    }

private:
    void write_header() {
        if (topic_.files.empty())
            return;
        xml_.open("Header");
        if (is_3_)
            xml_.open("Files");
        for (const BcfHeaderFile& file : topic_.files) {
            xml_.open("File");
            if (!file.ifc_project.empty())
                xml_.attribute("IfcProject", file.ifc_project);
            if (!file.ifc_spatial_structure_element.empty())
                xml_.attribute("IfcSpatialStructureElement", file.ifc_spatial_structure_element);
            xml_.attribute(is_3_ ? "IsExternal" : "isExternal", file.is_external);
            xml_.unknown_attributes(file.unknown);
            xml_.optional_leaf("Filename", file.filename);
            xml_.optional_leaf("Date", file.date);
            xml_.optional_leaf("Reference", file.reference);
            xml_.unknown_elements(file.unknown);
            xml_.close();
        }
        if (is_3_)
            xml_.close();
        xml_.close();
    }

    void write_topic() {
        xml_.open("Topic");
        xml_.attribute("Guid", written_guid(topic_.guid, version_));
        if (is_3_ && !is_blank(topic_.server_assigned_id))
            xml_.attribute("ServerAssignedId", topic_.server_assigned_id);
        if (is_3_ || !topic_.type.empty())
            xml_.attribute("TopicType", is_3_ ? stated(topic_.type, kUndefined) : topic_.type);
        if (is_3_ || !topic_.status.empty())
            xml_.attribute("TopicStatus",
                           is_3_ ? stated(topic_.status, kUndefined) : topic_.status);
        xml_.unknown_attributes(topic_.unknown);
        write_list("ReferenceLinks", "ReferenceLink", topic_.reference_links);
        xml_.leaf("Title", is_3_ ? stated(topic_.title, kUndefined) : topic_.title);
        xml_.optional_leaf("Priority", topic_.priority);
        xml_.optional_leaf("Index", topic_.index);
        write_list("Labels", is_3_ ? "Label" : "Labels", topic_.labels);
        xml_.leaf("CreationDate", stated(topic_.creation_date, kNoDate));
        xml_.leaf("CreationAuthor", stated(topic_.creation_author, kNobody));
        xml_.optional_leaf("ModifiedDate", topic_.modified_date);
        xml_.optional_leaf("ModifiedAuthor", topic_.modified_author);
        xml_.optional_leaf("DueDate", topic_.due_date);
        xml_.optional_leaf("AssignedTo", topic_.assigned_to);
        xml_.optional_leaf("Stage", topic_.stage);
        xml_.optional_leaf("Description", topic_.description);
        write_snippet();
        write_documents();
        write_related();
        if (is_3_) {
            write_comments();
            write_viewpoints();
        }
        xml_.unknown_elements(topic_.unknown);
        xml_.close();
    }

    /// 3.0 has an element around the list.
    void write_list(const char* list, const char* name, const std::vector<std::string>& texts) {
        if (texts.empty())
            return;
        if (is_3_)
            xml_.open(list);
        for (const std::string& text : texts)
            if (!is_3_ || !is_blank(text))
                xml_.leaf(name, text);
        if (is_3_)
            xml_.close();
    }

    void write_snippet() {
        if (!topic_.snippet)
            return;
        const BcfSnippet& snippet = *topic_.snippet;
        xml_.open("BimSnippet");
        xml_.attribute("SnippetType", is_3_ ? stated(snippet.type, kUndefined) : snippet.type);
        xml_.attribute(is_3_ ? "IsExternal" : "isExternal", snippet.is_external);
        xml_.leaf("Reference", is_3_ ? stated(snippet.reference, kUndefined) : snippet.reference);
        xml_.leaf("ReferenceSchema",
                  is_3_ ? stated(snippet.reference_schema, kUndefined) : snippet.reference_schema);
        xml_.close();
    }

    void write_documents() {
        if (is_3_ && !topic_.documents.empty())
            xml_.open("DocumentReferences");
        for (const BcfDocumentReference& document : topic_.documents) {
            xml_.open("DocumentReference");
            if (is_3_)
                write_document_of_3_0(document);
            else {
                if (is_uuid(document.guid))
                    xml_.attribute("Guid", document.guid);
                xml_.attribute("isExternal", document.is_external);
                const bool is_inside = !document.is_external && is_uuid(document.reference);
                xml_.leaf("ReferencedDocument",
                          (is_inside ? "../documents/" : "") + document.reference);
            }
            xml_.optional_leaf("Description", document.description);
            xml_.close();
        }
        if (is_3_ && !topic_.documents.empty())
            xml_.close();
    }
    void write_document_of_3_0(const BcfDocumentReference& document) {
        const std::string guid = is_uuid(document.guid)
                                     ? document.guid
                                     : missing_guid(topic_.guid + " " + document.reference);
        xml_.attribute("Guid", written_guid(guid, version_));
        const DocumentTarget target = find_(topic_, document);
        if (target.is_document)
            xml_.leaf("DocumentGuid", written_guid(target.guid_or_url, version_));
        else
            xml_.optional_leaf("Url", target.guid_or_url);
    }

    void write_related() {
        if (is_3_ && !topic_.related_topics.empty())
            xml_.open("RelatedTopics");
        for (const std::string& guid : topic_.related_topics)
            if (is_uuid(guid)) {
                xml_.open("RelatedTopic");
                xml_.attribute("Guid", written_guid(guid, version_));
                xml_.close();
            }
        if (is_3_ && !topic_.related_topics.empty())
            xml_.close();
    }

    void write_comments() {
        if (is_3_ && !topic_.comments.empty())
            xml_.open("Comments");
        for (const BcfComment& comment : topic_.comments) {
            xml_.open("Comment");
            xml_.attribute("Guid", written_guid(comment.guid, version_));
            xml_.unknown_attributes(comment.unknown);
            xml_.leaf("Date", stated(comment.date, kNoDate));
            xml_.leaf("Author", stated(comment.author, kNobody));
            if (!is_3_ || !is_blank(comment.text))
                xml_.leaf("Comment", comment.text);
            if (is_uuid(comment.viewpoint)) {
                xml_.open("Viewpoint");
                xml_.attribute("Guid", written_guid(comment.viewpoint, version_));
                xml_.close();
            }
            xml_.optional_leaf("ModifiedDate", comment.modified_date);
            xml_.optional_leaf("ModifiedAuthor", comment.modified_author);
            xml_.unknown_elements(comment.unknown);
            xml_.close();
        }
        if (is_3_ && !topic_.comments.empty())
            xml_.close();
    }

    void write_viewpoints() {
        if (is_3_ && !topic_.viewpoints.empty())
            xml_.open("Viewpoints");
        for (const BcfViewpoint& viewpoint : topic_.viewpoints) {
            xml_.open(is_3_ ? "ViewPoint" : "Viewpoints");
            xml_.attribute("Guid", written_guid(viewpoint.guid, version_));
            xml_.unknown_attributes(viewpoint.unknown);
            xml_.optional_leaf("Viewpoint", viewpoint.file);
            xml_.optional_leaf("Snapshot", viewpoint.snapshot_file);
            xml_.optional_leaf("Index", viewpoint.index);
            xml_.unknown_elements(viewpoint.unknown);
            xml_.close();
        }
        if (is_3_ && !topic_.viewpoints.empty())
            xml_.close();
    }

    const BcfTopic& topic_;
    BcfVersion version_;
    bool is_3_;
    const FindDocument& find_;
    XmlText xml_{"Markup"};
};

} // namespace

std::string markup_text(const BcfTopic& topic, BcfVersion version, const FindDocument& find) {
    return MarkupWriter(topic, version, find).text();
}

} // namespace abut
