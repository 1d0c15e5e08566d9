#pragma once

#include <abut/bcf.h>

#include <initializer_list>
#include <optional>
#include <pugixml.hpp>
#include <string>
#include <vector>

namespace abut {

/// One XML entry of a BCF file. Its functions take elements and attributes out of the document, so
/// that what remains is unknown.
///
/// Errors      of all members: Error{malformed}, naming the file and the entry.
class XmlReader {
public:
    /// In          root: name of the outermost element.
    XmlReader(const std::string& bytes, std::string file, std::string entry,
              std::initializer_list<const char*> roots, const BcfLimits& limits);
    XmlReader(const XmlReader&) = delete;
    XmlReader& operator=(const XmlReader&) = delete;

    [[nodiscard]] pugi::xml_node root() const { return root_; }
    [[noreturn]] void fail(const std::string& what) const;

    /// The text of an element, which must be valid UTF-8.
    [[nodiscard]] std::string text_of(pugi::xml_node node) const;
    [[nodiscard]] double number_of(pugi::xml_node node) const;
    [[nodiscard]] Vec3 vector_of(pugi::xml_node node) const;
    [[nodiscard]] bool truth_of(const std::string& text, const char* name) const;

    /// Takes the first child of a name; its text, or empty if there is none.
    std::string take_text(pugi::xml_node parent, const char* name) const;
    std::vector<std::string> take_texts(pugi::xml_node parent, const char* name) const;
    std::optional<int> take_integer(pugi::xml_node parent, const char* name) const;
    /// Takes an attribute, whose name may have one of two spellings.
    std::optional<std::string> take_attribute(pugi::xml_node node, const char* name,
                                              const char* other = nullptr) const;
    std::optional<bool> take_truth(pugi::xml_node node, const char* name,
                                   const char* other = nullptr) const;
    /// Calls use(child) for each child of a name, then removes it.
    template <typename Use>
    void take_each(pugi::xml_node parent, const char* name, const Use& use) const {
        for (pugi::xml_node child = parent.child(name); child;) {
            const pugi::xml_node next = child.next_sibling(name);
            use(child);
            parent.remove_child(child);
            child = next;
        }
    }
    /// As take_each for the elements in a list element, which is removed, too.
    template <typename Use>
    void take_list(pugi::xml_node parent, const char* list, const char* name,
                   const Use& use) const {
        if (pugi::xml_node all = parent.child(list)) {
            take_each(all, name, use);
            parent.remove_child(all);
        }
    }
    /// Takes whatever is left of an element.
    [[nodiscard]] BcfUnknown take_unknown(pugi::xml_node node) const;

private:
    void check_nodes() const;

    pugi::xml_document document_;
    pugi::xml_node root_;
    std::string file_, entry_;
};

} // namespace abut
