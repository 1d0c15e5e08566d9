#include "bcf/bcf_parts.h"
#include "core/uuid.h"

namespace abut {

namespace {

void read_header(const XmlReader& xml, pugi::xml_node markup, BcfTopic& topic) {
    const pugi::xml_node header = markup.child("Header");
    if (!header)
        return;
    const auto read = [&](pugi::xml_node node) {
        BcfHeaderFile file;
        file.ifc_project = xml.take_attribute(node, "IfcProject").value_or("");
        file.ifc_spatial_structure_element =
            xml.take_attribute(node, "IfcSpatialStructureElement").value_or("");
        file.is_external = xml.take_truth(node, "IsExternal", "isExternal").value_or(true);
        file.filename = xml.take_text(node, "Filename");
        file.date = xml.take_text(node, "Date");
        file.reference = xml.take_text(node, "Reference");
        file.unknown = xml.take_unknown(node);
        topic.files.push_back(std::move(file));
    };
    xml.take_each(header, "File", read);
    xml.take_list(header, "Files", "File", read);
    markup.remove_child(header);
}

std::string take_guid_element(const XmlReader& xml, pugi::xml_node parent, const char* name) {
    pugi::xml_node node = parent.child(name);
    std::string guid = xml.take_attribute(node, "Guid").value_or("");
    parent.remove_child(node);
    return guid;
}

/// Comments of 2.0 have statuses of their own, which stay in the comment's text.
std::string words_of_2_0(const XmlReader& xml, pugi::xml_node node) {
    std::string words;
    const auto add = [&](const char* name, const std::string& value) {
        if (!value.empty())
            words.append(words.empty() ? "" : ", ").append(name).append(": ").append(value);
    };
    add("status", xml.take_text(node, "Status"));
    add("verbal status", xml.take_text(node, "VerbalStatus"));
    add("reply to", take_guid_element(xml, node, "ReplyToComment"));
    node.remove_child("Topic"); // the topic that the comment is in
    return words;
}

void read_comment(const XmlReader& xml, pugi::xml_node node, BcfTopic& topic) {
    BcfComment comment;
    comment.guid = xml.take_attribute(node, "Guid").value_or("");
    comment.date = xml.take_text(node, "Date");
    comment.author = xml.take_text(node, "Author");
    comment.text = xml.take_text(node, "Comment");
    comment.viewpoint = take_guid_element(xml, node, "Viewpoint");
    comment.modified_date = xml.take_text(node, "ModifiedDate");
    comment.modified_author = xml.take_text(node, "ModifiedAuthor");
    if (const std::string words = words_of_2_0(xml, node); !words.empty())
        comment.text.append(comment.text.empty() ? "" : "\n").append("[" + words + "]");
    comment.unknown = xml.take_unknown(node);
    topic.comments.push_back(std::move(comment));
}

void read_viewpoint_reference(const XmlReader& xml, pugi::xml_node node, BcfTopic& topic) {
    BcfViewpoint viewpoint;
    viewpoint.guid = xml.take_attribute(node, "Guid").value_or("");
    viewpoint.file = xml.take_text(node, "Viewpoint");
    viewpoint.snapshot_file = xml.take_text(node, "Snapshot");
    viewpoint.index = xml.take_integer(node, "Index");
    viewpoint.unknown = xml.take_unknown(node);
    topic.viewpoints.push_back(std::move(viewpoint));
}

void read_document_reference(const XmlReader& xml, pugi::xml_node node, BcfTopic& topic) {
    BcfDocumentReference document;
    document.guid = xml.take_attribute(node, "Guid").value_or("");
    document.is_external = xml.take_truth(node, "isExternal", "IsExternal").value_or(false);
    document.reference = xml.take_text(node, "ReferencedDocument");
    if (const std::string guid = xml.take_text(node, "DocumentGuid"); !guid.empty())
        document.reference = guid;
    if (const std::string url = xml.take_text(node, "Url"); !url.empty()) {
        document.reference = url;
        document.is_external = true;
    }
    document.description = xml.take_text(node, "Description");
    topic.documents.push_back(std::move(document));
}

void read_links(const XmlReader& xml, pugi::xml_node node, BcfTopic& topic) {
    const auto text_to = [&](std::vector<std::string>& list) {
        return [&](pugi::xml_node each) { list.push_back(xml.text_of(each)); };
    };
    xml.take_each(node, "ReferenceLink", text_to(topic.reference_links));
    xml.take_list(node, "ReferenceLinks", "ReferenceLink", text_to(topic.reference_links));
    xml.take_list(node, "Labels", "Label",
                  [&](pugi::xml_node each) { topic.labels.push_back(xml.text_of(each)); });
    const auto document = [&](pugi::xml_node each) { read_document_reference(xml, each, topic); };
    xml.take_each(node, "DocumentReference", document);
    xml.take_list(node, "DocumentReferences", "DocumentReference", document);
    const auto related = [&](pugi::xml_node each) {
        topic.related_topics.push_back(xml.take_attribute(each, "Guid").value_or(""));
    };
    xml.take_each(node, "RelatedTopic", related);
    xml.take_list(node, "RelatedTopics", "RelatedTopic", related);
}

/// In 2.1 each label is an element `Labels`; in 3.0 one element holds them all.
void read_labels(const XmlReader& xml, pugi::xml_node node, BcfTopic& topic) {
    for (pugi::xml_node labels = node.child("Labels"); labels;) {
        const pugi::xml_node next = labels.next_sibling("Labels");
        if (!labels.child("Label")) {
            if (labels.first_child())
                topic.labels.push_back(xml.text_of(labels));
            node.remove_child(labels);
        }
        labels = next;
    }
}

void read_snippet(const XmlReader& xml, pugi::xml_node topic_node, BcfTopic& topic) {
    const pugi::xml_node node = topic_node.child("BimSnippet");
    if (!node)
        return;
    BcfSnippet snippet;
    snippet.type = xml.take_attribute(node, "SnippetType").value_or("");
    snippet.is_external = xml.take_truth(node, "isExternal", "IsExternal").value_or(false);
    snippet.reference = xml.take_text(node, "Reference");
    snippet.reference_schema = xml.take_text(node, "ReferenceSchema");
    topic.snippet = std::move(snippet);
    topic_node.remove_child(node);
}

void read_topic(const XmlReader& xml, pugi::xml_node node, BcfTopic& topic) {
    topic.guid = xml.take_attribute(node, "Guid").value_or("");
    if (!is_uuid(topic.guid))
        xml.fail("the topic has no GUID");
    topic.type = xml.take_attribute(node, "TopicType").value_or("");
    topic.status = xml.take_attribute(node, "TopicStatus").value_or("");
    topic.server_assigned_id = xml.take_attribute(node, "ServerAssignedId").value_or("");
    topic.title = xml.take_text(node, "Title");
    topic.priority = xml.take_text(node, "Priority");
    topic.index = xml.take_integer(node, "Index");
    read_labels(xml, node, topic);
    read_links(xml, node, topic);
    topic.creation_date = xml.take_text(node, "CreationDate");
    topic.creation_author = xml.take_text(node, "CreationAuthor");
    topic.modified_date = xml.take_text(node, "ModifiedDate");
    topic.modified_author = xml.take_text(node, "ModifiedAuthor");
    topic.due_date = xml.take_text(node, "DueDate");
    topic.assigned_to = xml.take_text(node, "AssignedTo");
    topic.stage = xml.take_text(node, "Stage");
    topic.description = xml.take_text(node, "Description");
    read_snippet(xml, node, topic);
}

} // namespace

void read_markup(const XmlReader& xml, BcfTopic& topic) {
    const pugi::xml_node markup = xml.root();
    const pugi::xml_node node = markup.child("Topic");
    if (!node)
        xml.fail("there is no topic");
    read_header(xml, markup, topic);
    read_topic(xml, node, topic);
    const auto comment = [&](pugi::xml_node each) { read_comment(xml, each, topic); };
    const auto viewpoint = [&](pugi::xml_node each) { read_viewpoint_reference(xml, each, topic); };
    xml.take_list(node, "Comments", "Comment", comment);
    xml.take_list(node, "Viewpoints", "ViewPoint", viewpoint);
    topic.unknown = xml.take_unknown(node);
    pugi::xml_node(markup).remove_child(node);
    xml.take_each(markup, "Comment", comment);
    xml.take_each(markup, "Viewpoints", viewpoint);
    topic.unknown_markup = xml.take_unknown(markup);
}

} // namespace abut
