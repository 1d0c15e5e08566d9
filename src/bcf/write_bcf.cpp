#include <abut/bcf.h>
#include <abut/error.h>

#include "bcf/archive.h"
#include "bcf/bcf_parts.h"
#include "bcf/xml_text.h"
#include "core/atomic_file.h"
#include "core/uuid.h"

#include <algorithm>
#include <map>

namespace abut {

namespace {

/// Takes a BCF file apart into the entries of its archive.
class BcfWriter {
public:
    BcfWriter(const BcfFile& file, BcfVersion version)
        : file_(file), version_(version), is_3_(version == BcfVersion::v3_0),
          documents_(file.documents) {}

    std::string bytes() {
        for (const BcfEntry& entry : file_.entries)
            add(entry.name, entry.bytes);
        write_version();
        for (const BcfTopic& topic : file_.topics)
            write_topic(topic);
        write_documents();
        write_extensions();
        write_project();
        std::vector<BcfEntry> entries;
        for (auto& [name, bytes] : entries_)
            entries.push_back({name, std::move(bytes)});
        return pack_archive(std::move(entries));
    }

private:
    /// Two viewpoints may share a file, but two files may not share a name.
    void add(const std::string& name, const std::string& bytes) {
        const auto [at, is_new] = entries_.try_emplace(name, bytes);
        if (!is_new && at->second != bytes && !bytes.empty())
            throw Error(ErrorCode::bad_argument, "two entries have the name '" + name + "'");
    }
    void replace(const std::string& name, std::string bytes) { entries_[name] = std::move(bytes); }

    void write_version() {
        XmlText xml("Version");
        xml.attribute("VersionId", std::string_view(to_string(version_)));
        if (!is_3_)
            xml.leaf("DetailedVersion", std::string_view(to_string(version_)));
        replace("bcf.version", xml.finish());
    }

    void write_project() {
        if (is_3_ && file_.project_id.empty() && file_.project_name.empty())
            return;
        if (!is_3_ && file_.project_id.empty() && file_.project_name.empty() && schema_.empty())
            return;
        XmlText xml(is_3_ ? "ProjectInfo" : "ProjectExtension");
        if (!file_.project_id.empty() || !file_.project_name.empty()) {
            xml.open("Project");
            xml.attribute("ProjectId", std::string_view(file_.project_id.empty()
                                                            ? missing_guid(file_.project_name)
                                                            : file_.project_id));
            xml.optional_leaf("Name", std::string_view(file_.project_name));
            xml.close();
        }
        if (!is_3_)
            xml.leaf("ExtensionSchema", std::string_view(schema_));
        replace("project.bcfp", xml.finish());
    }

    void write_extensions() {
        if (is_3_) {
            replace("extensions.xml", extensions_text(file_.extensions));
            return;
        }
        schema_ = file_.extension_schema;
        if (file_.extensions == BcfExtensions{})
            return;
        const auto name = entry_of("", schema_);
        if (name && entries_.contains(*name) && !name->empty()) {
            const XmlReader known(entries_.at(*name), "", *name,
                                  {"xs:schema", "xsd:schema", "schema"}, {});
            if (extensions_of_schema(known) == file_.extensions)
                return;
        }
        schema_ = "extensions.xsd";
        replace(schema_, extension_schema_text(file_.extensions));
    }

    void write_documents() {
        if (documents_.empty() && !is_3_)
            return;
        XmlText xml("DocumentInfo");
        if (!documents_.empty())
            xml.open("Documents");
        for (const BcfDocument& document : documents_) {
            xml.open("Document");
            xml.attribute("Guid", std::string_view(written_guid(document.guid, version_)));
            xml.leaf("Filename", std::string_view(is_blank(document.filename) ? document.guid
                                                                              : document.filename));
            xml.optional_leaf("Description", std::string_view(document.description));
            xml.close();
        }
        replace("documents.xml", xml.finish());
    }

    [[nodiscard]] bool is_document(const std::string& guid) const {
        return std::ranges::any_of(documents_, [&](const BcfDocument& document) {
            return written_guid(document.guid, BcfVersion::v3_0) ==
                   written_guid(guid, BcfVersion::v3_0);
        });
    }

    /// A path of 2.1 becomes a document of 3.0.
    DocumentTarget document_of(const BcfTopic& topic, const BcfDocumentReference& reference) {
        if (reference.is_external)
            return {false, reference.reference};
        if (is_uuid(reference.reference) && is_document(reference.reference))
            return {true, reference.reference};
        const auto path = entry_of(folder_of(topic), reference.reference);
        if (!path || !entries_.contains(*path))
            return {is_uuid(reference.reference), reference.reference};
        const std::string name = path->substr(path->rfind('/') + 1); // npos + 1 is 0
        if (path->starts_with("documents/") && is_document(name))
            return {true, name};
        const std::string guid = missing_guid("document " + *path);
        if (!is_document(guid)) {
            documents_.push_back({guid, name, reference.description});
            add("documents/" + guid, entries_.at(*path));
        }
        return {true, guid};
    }

    static std::string folder_of(const BcfTopic& topic) {
        return topic.folder.empty() ? topic.guid : topic.folder;
    }
    static std::string placed(const std::string& folder, const std::string& reference) {
        const auto name = entry_of(folder, reference);
        if (!name || name->empty())
            throw Error(ErrorCode::bad_argument, "'" + reference + "' leads out of the BCF file");
        return *name;
    }

    void write_topic(const BcfTopic& topic) {
        if (!is_uuid(topic.guid))
            throw Error(ErrorCode::bad_argument, "'" + topic.guid + "' is no GUID of a topic");
        const std::string folder = folder_of(topic);
        const FindDocument find = [&](const BcfTopic& of, const BcfDocumentReference& reference) {
            return document_of(of, reference);
        };
        const std::string name = placed(folder, "markup.bcf");
        if (entries_.contains(name))
            throw Error(ErrorCode::bad_argument, "two topics have the folder '" + folder + "'");
        add(name, markup_text(topic, version_, find));
        for (const BcfViewpoint& viewpoint : topic.viewpoints) {
            if (!is_uuid(viewpoint.guid))
                throw Error(ErrorCode::bad_argument,
                            "'" + viewpoint.guid + "' is no GUID of a viewpoint");
            if (!is_blank(viewpoint.file))
                add(placed(folder, viewpoint.file), viewpoint_text(viewpoint, version_));
            if (!is_blank(viewpoint.snapshot_file))
                add(placed(folder, viewpoint.snapshot_file), viewpoint.snapshot);
        }
        for (const BcfComment& comment : topic.comments)
            if (!is_uuid(comment.guid))
                throw Error(ErrorCode::bad_argument,
                            "'" + comment.guid + "' is no GUID of a comment");
    }

    const BcfFile& file_;
    BcfVersion version_;
    bool is_3_;
    std::string schema_; ///< name of the entry with the extensions of 2.1
    std::vector<BcfDocument> documents_;
    std::map<std::string, std::string> entries_;
};

} // namespace

std::string bcf_bytes(const BcfFile& file, BcfVersion version) {
    if (version == BcfVersion::v2_0)
        throw Error(ErrorCode::bad_argument, "BCF 2.0 is only read: write 2.1 or 3.0");
    return BcfWriter(file, version).bytes();
}

void write_bcf(const BcfFile& file, const std::string& path, BcfVersion version) {
    write_file_atomically(path, bcf_bytes(file, version));
}

} // namespace abut
