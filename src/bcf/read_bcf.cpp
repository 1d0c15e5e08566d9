#include <abut/bcf.h>
#include <abut/error.h>

#include "bcf/archive.h"
#include "bcf/bcf_parts.h"
#include "core/uuid.h"
#include "io/file/fault.h"
#include "io/file/input_file.h"

#include <algorithm>
#include <map>
#include <set>

namespace abut {

namespace {

constexpr std::string_view kMarkup = "/markup.bcf";

/// Puts a BCF file together from the entries of its archive.
class BcfReader {
public:
    BcfReader(std::vector<BcfEntry> entries, const std::string& file, const BcfLimits& limits)
        : file_(file), limits_(limits) {
        for (BcfEntry& entry : entries)
            entries_.emplace(std::move(entry.name), std::move(entry.bytes));
    }

    BcfFile read() {
        const auto is_markup = [](const auto& entry) { return entry.first.ends_with(kMarkup); };
        if (!has("bcf.version") && std::ranges::none_of(entries_, is_markup))
            throw Error(ErrorCode::malformed, file_, "is a zip archive, but not a BCF file");
        read_version();
        read_project();
        read_documents();
        read_extensions();
        std::vector<std::string> folders;
        for (const auto& [name, bytes] : entries_)
            if (name.ends_with(kMarkup))
                folders.push_back(name.substr(0, name.size() - kMarkup.size()));
        for (const std::string& folder : folders)
            read_topic(folder);
        for (auto& [name, bytes] : entries_)
            if (!used_.contains(name))
                result_.entries.push_back({name, std::move(bytes)});
        return std::move(result_);
    }

private:
    [[nodiscard]] bool has(const std::string& name) const { return entries_.contains(name); }

    /// An entry that is XML; it counts as read.
    XmlReader open(const std::string& name, std::initializer_list<const char*> roots) {
        used_.insert(name);
        return {entries_.at(name), file_, name, roots, limits_};
    }
    void warn(const std::string& entry, const std::string& text) {
        result_.warnings.push_back(entry + ": " + text);
    }

    void read_version() {
        if (!has("bcf.version")) {
            result_.version = BcfVersion::v2_0;
            warn("bcf.version", "is missing; the file is read as BCF 2.0");
            return;
        }
        const XmlReader xml = open("bcf.version", {"Version"});
        const std::string version = xml.take_attribute(xml.root(), "VersionId").value_or("");
        for (const BcfVersion known : {BcfVersion::v2_0, BcfVersion::v2_1, BcfVersion::v3_0})
            if (version == to_string(known)) {
                result_.version = known;
                return;
            }
        throw Error(ErrorCode::unsupported, file_,
                    "bcf.version: version '" + version.substr(0, 20) +
                        "' is none of 2.0, 2.1 and 3.0");
    }

    void read_project() {
        if (!has("project.bcfp"))
            return;
        const XmlReader xml = open("project.bcfp", {"ProjectInfo", "ProjectExtension"});
        if (const pugi::xml_node project = xml.root().child("Project")) {
            result_.project_id = xml.take_attribute(project, "ProjectId").value_or("");
            result_.project_name = xml.take_text(project, "Name");
        }
        result_.extension_schema = xml.take_text(xml.root(), "ExtensionSchema");
    }

    void read_documents() {
        if (!has("documents.xml"))
            return;
        const XmlReader xml = open("documents.xml", {"DocumentInfo"});
        xml.take_list(xml.root(), "Documents", "Document", [&](pugi::xml_node node) {
            result_.documents.push_back({xml.take_attribute(node, "Guid").value_or(""),
                                         xml.take_text(node, "Filename"),
                                         xml.take_text(node, "Description")});
        });
    }

    void read_extensions() {
        if (has("extensions.xml"))
            result_.extensions = extensions_of_xml(open("extensions.xml", {"Extensions"}));
        const auto schema = entry_of("", result_.extension_schema);
        if (!schema || schema->empty() || !has(*schema))
            return;
        const XmlReader xml(entries_.at(*schema), file_, *schema,
                            {"xs:schema", "xsd:schema", "schema"}, limits_);
        result_.extensions = extensions_of_schema(xml); // the entry itself stays as it is
    }

    void read_topic(const std::string& folder) {
        BcfTopic topic;
        topic.folder = folder;
        const std::string name = folder + std::string(kMarkup);
        read_markup(open(name, {"Markup"}), topic);
        if (result_.version == BcfVersion::v2_0 && topic.viewpoints.empty() &&
            has(folder + "/viewpoint.bcfv")) { // as 1.0 has it
            BcfViewpoint only;
            only.file = "viewpoint.bcfv";
            if (has(folder + "/snapshot.png"))
                only.snapshot_file = "snapshot.png";
            topic.viewpoints.push_back(std::move(only));
        }
        give_guids(topic, name);
        for (BcfViewpoint& viewpoint : topic.viewpoints)
            read_files_of(viewpoint, folder, name);
        result_.topics.push_back(std::move(topic));
    }

    /// Comments and viewpoints without a GUID, or with one that another has, get one. Comments
    /// refer to the viewpoints' new GUIDs.
    void give_guids(BcfTopic& topic, const std::string& entry) {
        std::map<std::string, std::size_t> viewpoints; // by GUID, as the file has it
        for (std::size_t i = 0; i < topic.viewpoints.size(); ++i)
            viewpoints.emplace(topic.viewpoints[i].guid, i);
        const auto check = [&](auto& list, const char* what) {
            std::set<std::string> known;
            for (std::size_t i = 0; i < list.size(); ++i) {
                if (is_uuid(list[i].guid) && known.insert(list[i].guid).second)
                    continue;
                list[i].guid = missing_guid(topic.guid + " " + what + " " + std::to_string(i));
                known.insert(list[i].guid);
                warn(entry, std::string("a ") + what + " had no GUID of its own");
            }
        };
        check(topic.comments, "comment");
        check(topic.viewpoints, "viewpoint");
        for (BcfComment& comment : topic.comments) {
            if (comment.viewpoint.empty() || is_uuid(comment.viewpoint))
                continue;
            const auto found = viewpoints.find(comment.viewpoint);
            if (found == viewpoints.end())
                warn(entry, "a comment refers to a viewpoint that is not there");
            comment.viewpoint =
                found == viewpoints.end() ? std::string() : topic.viewpoints[found->second].guid;
        }
    }

    /// Counts an entry that a viewpoint refers to. Many viewpoints may refer to one large entry,
    /// and each of them gets its content.
    void charge(const std::string& entry) {
        const std::uint64_t bytes = entries_.at(entry).size();
        if (bytes > left_)
            throw Error(ErrorCode::malformed, file_,
                        entry + ": the viewpoints refer to more bytes than are allowed");
        left_ -= bytes;
    }

    void read_files_of(BcfViewpoint& viewpoint, const std::string& folder,
                       const std::string& entry) {
        const auto find = [&](std::string& reference) -> std::optional<std::string> {
            if (reference.empty())
                return std::nullopt;
            std::optional<std::string> name = entry_of(folder, reference);
            if (name && has(*name)) {
                charge(*name);
                return name;
            }
            warn(entry, "there is no entry '" + reference.substr(0, 100) + "'");
            reference.clear();
            return std::nullopt;
        };
        if (const auto name = find(viewpoint.file))
            read_viewpoint(open(*name, {"VisualizationInfo"}), viewpoint);
        if (const auto name = find(viewpoint.snapshot_file)) {
            viewpoint.snapshot = entries_.at(*name);
            used_.insert(*name);
        }
    }

    std::string file_;
    const BcfLimits& limits_;
    std::uint64_t left_ = limits_.bytes; ///< that viewpoints may still refer to
    std::map<std::string, std::string> entries_;
    std::set<std::string> used_;
    BcfFile result_;
};

} // namespace

const char* to_string(BcfVersion version) {
    switch (version) {
    case BcfVersion::v2_0:
        return "2.0";
    case BcfVersion::v2_1:
        return "2.1";
    default:
        return "3.0";
    }
}

BcfFile parse_bcf(const std::string& bytes, const std::string& name, const BcfLimits& limits) {
    return BcfReader(unpack_archive(bytes, name, limits), name, limits).read();
}

BcfFile read_bcf(const std::string& path, const BcfLimits& limits) {
    std::string bytes;
    try {
        bytes = read_file(path);
    } catch (const Fault& fault) {
        throw Error(fault.code(), path, fault.what());
    }
    return parse_bcf(bytes, path, limits);
}

} // namespace abut
