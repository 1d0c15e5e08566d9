#include "bcf/bcf_parts.h"
#include "bcf/xml_text.h"

#include <array>
#include <cstring>

namespace abut {

namespace {

/// One list of words: its names in extensions.xml and in extensions.xsd.
struct WordList {
    std::vector<std::string> BcfExtensions::*words;
    const char* list;
    const char* word;
    const char* schema_type;
};
constexpr std::array<WordList, 7> kWordLists{{
    {&BcfExtensions::types, "TopicTypes", "TopicType", "TopicType"},
    {&BcfExtensions::statuses, "TopicStatuses", "TopicStatus", "TopicStatus"},
    {&BcfExtensions::priorities, "Priorities", "Priority", "Priority"},
    {&BcfExtensions::labels, "TopicLabels", "TopicLabel", "TopicLabel"},
    {&BcfExtensions::users, "Users", "User", "UserIdType"},
    {&BcfExtensions::snippet_types, "SnippetTypes", "SnippetType", "SnippetType"},
    {&BcfExtensions::stages, "Stages", "Stage", "Stage"},
}};

/// A name without the prefix of its name space.
const char* local_name(const char* name) {
    const char* const colon = std::strchr(name, ':');
    return colon == nullptr ? name : colon + 1;
}

} // namespace

BcfExtensions extensions_of_schema(const XmlReader& xml) {
    BcfExtensions extensions;
    for (const pugi::xml_node redefine : xml.root().children())
        for (const pugi::xml_node type : redefine.children())
            for (const WordList& list : kWordLists)
                if (std::strcmp(type.attribute("name").value(), list.schema_type) == 0)
                    for (const pugi::xml_node restriction : type.children())
                        for (const pugi::xml_node value : restriction.children())
                            if (std::strcmp(local_name(value.name()), "enumeration") == 0)
                                (extensions.*list.words)
                                    .emplace_back(value.attribute("value").value());
    return extensions;
}

BcfExtensions extensions_of_xml(const XmlReader& xml) {
    BcfExtensions extensions;
    for (const WordList& list : kWordLists)
        for (const pugi::xml_node word : xml.root().child(list.list).children(list.word))
            (extensions.*list.words).push_back(xml.text_of(word));
    return extensions;
}

std::string extension_schema_text(const BcfExtensions& extensions) {
    XmlText xml("xs:schema");
    xml.attribute("xmlns:xs", std::string_view("http://www.w3.org/2001/XMLSchema"));
    xml.open("xs:redefine");
    xml.attribute("schemaLocation", std::string_view("markup.xsd"));
    for (const WordList& list : kWordLists) {
        if ((extensions.*list.words).empty())
            continue;
        xml.open("xs:simpleType");
        xml.attribute("name", std::string_view(list.schema_type));
        xml.open("xs:restriction");
        xml.attribute("base", std::string_view(list.schema_type));
        for (const std::string& word : extensions.*list.words) {
            xml.open("xs:enumeration");
            xml.attribute("value", std::string_view(word));
            xml.close();
        }
        xml.close();
        xml.close();
    }
    return xml.finish();
}

std::string extensions_text(const BcfExtensions& extensions) {
    XmlText xml("Extensions");
    for (const WordList& list : kWordLists) {
        if ((extensions.*list.words).empty())
            continue;
        xml.open(list.list);
        for (const std::string& word : extensions.*list.words)
            xml.optional_leaf(list.word, std::string_view(word));
        xml.close();
    }
    return xml.finish();
}

} // namespace abut
