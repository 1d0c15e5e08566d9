// The official test cases of BCF and files of a real building: nothing is lost, and what is written
// follows the official schemas.
#include <abut/bcf.h>

#include "bcf/archive.h"
#include "tests/support/clash/random_bcf.h"
#include "tests/support/folder.h"
#include "tests/support/paths.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <map>
#include <pugixml.hpp>
#include <set>

namespace abut::test {
namespace {

const std::string kData = std::string(ABUT_SHARED_DATA) + "/bcf/";

std::string bytes_of(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

std::vector<std::string> files_in(const std::string& folder) {
    std::vector<std::string> files;
    std::error_code missing;
    for (const auto& entry : std::filesystem::directory_iterator(kData + folder, missing))
        files.push_back(entry.path().string());
    std::ranges::sort(files);
    return files;
}

/// A text as a number with all its digits, if it is one; without blanks around it.
std::string value_of(std::string text) {
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    if (first == std::string::npos)
        return "";
    text = text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
    double number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    std::string lower = text;
    std::ranges::transform(lower, lower.begin(), [](unsigned char c) { return std::tolower(c); });
    return error == std::errc() && end == text.data() + text.size() ? std::to_string(number)
                                                                    : lower;
}

/// All values of a document: "Markup/Topic@Guid=…", "Markup/Topic/Title=…", how often each.
void add_values(pugi::xml_node node, const std::string& path, std::map<std::string, int>& values) {
    for (const pugi::xml_attribute attribute : node.attributes()) {
        const std::string name = attribute.name();
        if (!name.starts_with("xmlns") && !name.starts_with("xsi:") && *attribute.value() != '\0')
            ++values[fmt::format("{}@{}={}", path, name, value_of(attribute.value()))];
    }
    for (const pugi::xml_node child : node.children()) {
        if (child.type() == pugi::node_element)
            add_values(child, fmt::format("{}/{}", path, child.name()), values);
        else if (const std::string text = value_of(child.value()); !text.empty())
            ++values[fmt::format("{}={}", path, text)];
    }
}

std::map<std::string, int> values_of(const std::string& xml) {
    pugi::xml_document document;
    EXPECT_TRUE(document.load_buffer(xml.data(), xml.size()));
    std::map<std::string, int> values;
    add_values(document.root(), "", values);
    return values;
}

bool is_xml(const std::string& name) {
    return name.ends_with(".bcf") || name.ends_with(".bcfv") || name.ends_with(".bcfp") ||
           name.ends_with(".version") || name == "documents.xml" || name == "extensions.xml";
}

class BcfCases : public testing::TestWithParam<std::string> {
protected:
    void SetUp() override {
        if (files_in(GetParam()).empty())
            GTEST_SKIP() << "without " << kData << GetParam();
    }
};

TEST_P(BcfCases, LoseNothing) {
    std::size_t values = 0;
    for (const std::string& path : files_in(GetParam())) {
        SCOPED_TRACE(path);
        const BcfFile file = read_bcf(path);
        EXPECT_FALSE(file.topics.empty());
        const std::string written = bcf_bytes(file, file.version);
        std::map<std::string, std::string> after;
        for (const BcfEntry& entry : unpack_archive(written, "written", {}))
            after[entry.name] = entry.bytes;
        for (const BcfEntry& entry : unpack_archive(bytes_of(path), path, {})) {
            ASSERT_TRUE(after.contains(entry.name)) << entry.name;
            if (!is_xml(entry.name)) {
                EXPECT_EQ(after[entry.name], entry.bytes) << entry.name;
                continue;
            }
            const auto now = values_of(after[entry.name]);
            for (const auto& [value, count] : values_of(entry.bytes)) {
                const auto found = now.find(value);
                EXPECT_EQ(found == now.end() ? 0 : found->second, count)
                    << entry.name << ": " << value;
                ++values;
            }
        }
        EXPECT_EQ(bcf_bytes(parse_bcf(written, "written"), file.version), written);
    }
    EXPECT_GT(values, 200U);
}

TEST_P(BcfCases, KeepTheirTopicsInTheOtherVersion) {
    for (const std::string& path : files_in(GetParam())) {
        SCOPED_TRACE(path);
        const BcfFile file = read_bcf(path);
        for (const BcfVersion version : {BcfVersion::v2_1, BcfVersion::v3_0}) {
            const BcfFile again = parse_bcf(bcf_bytes(file, version), "again");
            ASSERT_EQ(again.topics.size(), file.topics.size());
            for (std::size_t i = 0; i < file.topics.size(); ++i) {
                const BcfTopic &a = file.topics[i], &b = again.topics[i];
                EXPECT_EQ(a.title, b.title);
                EXPECT_EQ(a.description, b.description);
                EXPECT_EQ(a.labels, b.labels);
                EXPECT_EQ(a.files, b.files);
                EXPECT_EQ(a.documents.size(), b.documents.size());
                ASSERT_EQ(a.comments.size(), b.comments.size());
                for (std::size_t k = 0; k < a.comments.size(); ++k)
                    EXPECT_EQ(a.comments[k].text, b.comments[k].text);
                ASSERT_EQ(a.viewpoints.size(), b.viewpoints.size());
                for (std::size_t k = 0; k < a.viewpoints.size(); ++k) {
                    const BcfViewpoint &v = a.viewpoints[k], &w = b.viewpoints[k];
                    EXPECT_EQ(v.selection, w.selection);
                    EXPECT_EQ(v.exceptions, w.exceptions);
                    EXPECT_EQ(v.colouring, w.colouring);
                    EXPECT_EQ(v.clipping_planes, w.clipping_planes);
                    EXPECT_EQ(v.snapshot, w.snapshot);
                }
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Data, BcfCases, testing::Values("cases-2.1", "cases-3.0"));

TEST(BcfData, FilesOfABuildingAreReadAndWritten) {
    const std::vector<std::string> files = files_in("schependomlaan");
    if (files.empty())
        GTEST_SKIP() << "without " << kData << "schependomlaan";
    std::size_t topics = 0, components = 0, snapshots = 0;
    for (const std::string& path : files) {
        SCOPED_TRACE(path);
        const BcfFile file = read_bcf(path);
        EXPECT_EQ(file.version, BcfVersion::v2_0);
        EXPECT_TRUE(file.entries.empty());
        for (const BcfVersion version : {BcfVersion::v2_1, BcfVersion::v3_0}) {
            const BcfFile again = parse_bcf(bcf_bytes(file, version), "again");
            ASSERT_EQ(again.topics.size(), file.topics.size());
            for (std::size_t i = 0; i < file.topics.size(); ++i) {
                EXPECT_EQ(again.topics[i].title, file.topics[i].title);
                EXPECT_EQ(again.topics[i].comments.size(), file.topics[i].comments.size());
                ASSERT_EQ(again.topics[i].viewpoints.size(), file.topics[i].viewpoints.size());
                for (std::size_t k = 0; k < file.topics[i].viewpoints.size(); ++k) {
                    const BcfViewpoint &v = file.topics[i].viewpoints[k],
                                       &w = again.topics[i].viewpoints[k];
                    EXPECT_EQ(v.selection, w.selection);
                    EXPECT_EQ(v.snapshot, w.snapshot);
                    EXPECT_EQ(v.perspective->view_point, w.perspective->view_point);
                    components += v.selection.size();
                    snapshots += v.snapshot.empty() ? 0 : 1;
                }
            }
        }
        topics += file.topics.size();
    }
    EXPECT_EQ(topics, 8U);
    EXPECT_GT(components, 1000U);
    EXPECT_EQ(snapshots, 16U);
}

// ------------------------------------------------------------------------------------ schemas ---

/// The complaints of xmllint about the XML of a BCF file.
std::string complaints(const std::string& bytes, const std::string& version) {
    const Folder folder;
    std::string all;
    for (const BcfEntry& entry : unpack_archive(bytes, "written", {})) {
        static const std::map<std::string, std::string> kSchemas{{".bcf", "markup"},
                                                                 {".bcfv", "visinfo"},
                                                                 {".bcfp", "project"},
                                                                 {".version", "version"}};
        std::string schema = entry.name == "documents.xml"    ? "documents"
                             : entry.name == "extensions.xml" ? "extensions"
                                                              : "";
        for (const auto& [ending, name] : kSchemas)
            if (entry.name.ends_with(ending))
                schema = name;
        if (schema.empty())
            continue;
        const std::string file = folder / "file.xml";
        std::ofstream(file, std::ios::binary) << entry.bytes;
        const std::string command = fmt::format(
            "xmllint --noout --schema {}schemas-{}/{}.xsd {} 2>&1", kData, version, schema, file);
        FILE* pipe = popen(command.c_str(), "r"); // NOLINT(cert-env33-c)
        std::string text;
        std::array<char, 4096> chunk{};
        while (fgets(chunk.data(), chunk.size(), pipe) != nullptr)
            text += chunk.data();
        if (pclose(pipe) != 0)
            all += entry.name + ": " + text;
    }
    return all;
}

bool can_validate() {
    return std::filesystem::exists(kData + "schemas-2.1/markup.xsd") &&
           std::system("xmllint --version > /dev/null 2>&1") == 0; // NOLINT
}

TEST(BcfData, WhatIsWrittenFollowsTheSchemas) {
    if (!can_validate())
        GTEST_SKIP() << "without xmllint or " << kData << "schemas-2.1";
    Random random(2012);
    for (int round = 0; round < 4; ++round) {
        const BcfFile file = RandomBcf(random).file(3);
        EXPECT_EQ(complaints(bcf_bytes(file, BcfVersion::v2_1), "2.1"), "");
        EXPECT_EQ(complaints(bcf_bytes(file, BcfVersion::v3_0), "3.0"), "");
    }
    // Real files of 2.0, in which much is missing.
    for (const std::string& path : files_in("schependomlaan")) {
        SCOPED_TRACE(path);
        const BcfFile file = read_bcf(path);
        EXPECT_EQ(complaints(bcf_bytes(file, BcfVersion::v2_1), "2.1"), "");
        EXPECT_EQ(complaints(bcf_bytes(file, BcfVersion::v3_0), "3.0"), "");
    }
}

} // namespace
} // namespace abut::test
