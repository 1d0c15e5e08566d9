#include <abut/error.h>
#include <abut/robot_description.h>

#include "articulated/xml_file.h"
#include "core/arguments.h"
#include "core/atomic_file.h"

#include <algorithm>
#include <map>
#include <sstream>
#include <utility>

namespace abut {

namespace {

AllowReason reason_named(const std::string& text) {
    for (const AllowReason reason : kAllowReasons)
        if (text == to_string(reason))
            return reason;
    return AllowReason::user;
}

void require_robot(const XmlFile& file) {
    const pugi::xml_node root = file.root();
    if (root.name() != std::string("robot"))
        file.fail(root, "the root element is <" + std::string(root.name()) + ">, not <robot>");
}

/// Copies a document except its allowed pairs. Nothing is removed from a copy, because pugixml removes
/// nodes recursively, which a deep file would turn into a stack overflow.
void copy_without_pairs(pugi::xml_node from, pugi::xml_document& to) {
    for (const pugi::xml_node node : from.children()) {
        if (node.type() != pugi::node_element) {
            to.append_copy(node);
            continue;
        }
        pugi::xml_node root = to.append_child(node.name());
        for (const pugi::xml_attribute attribute : node.attributes())
            root.append_copy(attribute);
        for (const pugi::xml_node child : node.children())
            if (child.name() != std::string("disable_collisions"))
                root.append_copy(child);
    }
}

class SrdfReader {
public:
    SrdfReader(const std::string& path, const RobotDescription& robot) : file_(path) {
        for (std::uint32_t i = 0; i < robot.links.size(); ++i)
            link_of_[robot.links[i].name] = i;
        for (const RobotJoint& joint : robot.joints)
            values_of_[joint.name] = variables_of(joint.type);
    }

    RobotSemantics read() {
        require_robot(file_);
        const pugi::xml_node root = file_.root();
        for (const pugi::xml_node node : root.children("disable_collisions"))
            read_pair(node);
        for (const pugi::xml_node node : root.children("group_state"))
            read_state(node);
        auto& pairs = semantics_.allowed;
        const auto key = [](const AllowedPair& pair) { return std::pair(pair.a, pair.b); };
        std::ranges::stable_sort(pairs, {}, key);
        const auto end = std::unique(
            pairs.begin(), pairs.end(),
            [&](const AllowedPair& p, const AllowedPair& q) { return key(p) == key(q); });
        pairs.erase(end, pairs.end());
        return std::move(semantics_);
    }

private:
    void warn(const std::string& text) { semantics_.warnings.push_back(text); }

    void read_pair(pugi::xml_node node) {
        const std::string names[2]{file_.text(node, "link1"), file_.text(node, "link2")};
        std::uint32_t links[2]{};
        for (int i = 0; i < 2; ++i) {
            const auto found = link_of_.find(names[i]);
            if (found == link_of_.end())
                return warn("the robot has no link '" + names[i] +
                            "', which an allowed pair names");
            links[i] = found->second;
        }
        if (links[0] == links[1])
            file_.fail(node, "the link '" + names[0] + "' is paired with itself");
        semantics_.allowed.push_back({std::min(links[0], links[1]), std::max(links[0], links[1]),
                                      reason_named(node.attribute("reason").as_string())});
    }

    void read_state(pugi::xml_node node) {
        NamedState state{file_.text(node, "name"), node.attribute("group").as_string(), {}};
        for (const pugi::xml_node joint : node.children("joint")) {
            const std::string name = file_.text(joint, "name");
            const auto found = values_of_.find(name);
            if (found == values_of_.end()) {
                warn("the robot has no joint '" + name + "', which state '" + state.name +
                     "' names");
                continue;
            }
            if (found->second == 0) {
                warn("the joint '" + name + "' is fixed and takes no value, but state '" +
                     state.name + "' gives one");
                continue;
            }
            state.joints.emplace_back(name, file_.numbers(joint, "value", found->second));
        }
        semantics_.states.push_back(std::move(state));
    }

    XmlFile file_;
    RobotSemantics semantics_;
    std::map<std::string, std::uint32_t> link_of_;
    std::map<std::string, std::size_t> values_of_;
};

} // namespace

const char* to_string(AllowReason reason) {
    constexpr std::array kNames{"Adjacent", "Default", "Always", "Never", "User"};
    return kNames.at(static_cast<std::size_t>(reason));
}

RobotSemantics read_srdf(const std::string& path, const RobotDescription& robot) {
    return SrdfReader(path, robot).read();
}

void write_srdf(const RobotDescription& robot, const std::vector<AllowedPair>& allowed,
                const std::string& path, const std::string& base) {
    pugi::xml_document document;
    if (!base.empty()) {
        const XmlFile file(base);
        require_robot(file);
        copy_without_pairs(file.root().parent(), document);
    } else {
        document.append_child("robot").append_attribute("name") = robot.name.c_str();
    }
    pugi::xml_node root = document.document_element();
    for (const AllowedPair& pair : allowed) {
        require(pair.a < robot.links.size() && pair.b < robot.links.size(),
                "an allowed pair names a link that is out of range");
        pugi::xml_node node = root.append_child("disable_collisions");
        node.append_attribute("link1") = robot.links[pair.a].name.c_str();
        node.append_attribute("link2") = robot.links[pair.b].name.c_str();
        node.append_attribute("reason") = to_string(pair.reason);
    }
    std::ostringstream text;
    document.save(text, "  ", pugi::format_default, pugi::encoding_utf8);
    write_file_atomically(path, text.str());
}

} // namespace abut
