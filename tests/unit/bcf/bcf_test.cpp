// BCF files: round trips, hostile archives and XML, limits, GUIDs.
#include <abut/bcf.h>
#include <abut/error.h>

#include "bcf/archive.h"
#include "tests/support/clash/random_bcf.h"
#include "tests/support/folder.h"
#include "tests/support/rounds.h"

#include <algorithm>
#include <cstring>
#include <gtest/gtest.h>

namespace abut::test {
namespace {

constexpr const char* kGuid = "0b9f1c1e-8f4e-4f0a-9f5e-0123456789ab";

std::string archive_of(const std::vector<BcfEntry>& entries) {
    return pack_archive(entries);
}
BcfEntry version_entry(const std::string& version = "2.1") {
    return {"bcf.version", "<Version VersionId=\"" + version + "\"/>"};
}
BcfEntry markup_entry(const std::string& inside, const std::string& attributes = "") {
    return {std::string(kGuid) + "/markup.bcf", "<Markup><Topic Guid=\"" + std::string(kGuid) +
                                                    "\"" + attributes + ">" + inside +
                                                    "</Topic></Markup>"};
}
BcfFile parse(const std::vector<BcfEntry>& entries, const BcfLimits& limits = {}) {
    return parse_bcf(archive_of(entries), "site.bcf", limits);
}
/// The message of the error, or nothing if there is none.
std::string refusal(const std::vector<BcfEntry>& entries, const BcfLimits& limits = {}) {
    try {
        parse(entries, limits);
    } catch (const Error& error) {
        EXPECT_EQ(error.file(), "site.bcf");
        return error.what();
    }
    return "";
}
bool holds(const std::string& text, const std::string& piece) {
    return text.find(piece) != std::string::npos;
}

/// As bytes, so that two files of one content are equal whatever they were read from.
BcfFile normalized(BcfFile file) {
    file.warnings.clear();
    std::ranges::sort(file.topics, {}, &BcfTopic::folder);
    for (BcfTopic& topic : file.topics)
        for (BcfViewpoint& view : topic.viewpoints)
            for (std::optional<BcfCamera>* camera : {&view.perspective, &view.orthogonal})
                if (*camera && (*camera)->aspect_ratio == 1)
                    (*camera)->aspect_ratio.reset();
    return file;
}

TEST(Bcf, ReadsWhatItWrote) {
    Random random(2010);
    std::size_t comments = 0, viewpoints = 0;
    for (int round = 0; round < many(40); ++round) {
        const BcfFile file = RandomBcf(random).file(random.integer(1, 4));
        for (const BcfVersion version : {BcfVersion::v2_1, BcfVersion::v3_0}) {
            const std::string bytes = bcf_bytes(file, version);
            BcfFile again = parse_bcf(bytes, "again", {});
            EXPECT_EQ(again.version, version);
            EXPECT_TRUE(again.warnings.empty());
            EXPECT_EQ(bcf_bytes(again, version), bytes);
            again.version = file.version;
            again.extension_schema.clear();
            again.entries.clear();
            EXPECT_EQ(normalized(again), normalized(file));
        }
        for (const BcfTopic& topic : file.topics) {
            comments += topic.comments.size();
            viewpoints += topic.viewpoints.size();
        }
    }
    EXPECT_GT(comments, 40U);
    EXPECT_GT(viewpoints, 40U);
}

TEST(Bcf, KeepsWhatItDoesNotKnow) {
    const std::vector<BcfEntry> entries{
        version_entry(),
        markup_entry("<Title>t</Title><vendor:cost xmlns:vendor=\"urn:v\" unit=\"EUR\">12 "
                     "&lt;</vendor:cost><CreationDate>2026-01-01T00:00:00Z</CreationDate>",
                     " vendor=\"7\""),
        {std::string(kGuid) + "/notes.pdf", "%PDF"},
        {"vendor/data.bin", std::string("\0\1\2", 3)}};
    const BcfFile file = parse(entries);
    EXPECT_EQ(file.entries.size(), 2U);
    ASSERT_EQ(file.topics.size(), 1U);
    EXPECT_TRUE(holds(file.topics[0].unknown.elements, "12 &lt;</vendor:cost>"));
    for (const BcfVersion version : {BcfVersion::v2_1, BcfVersion::v3_0}) {
        const BcfFile again = parse_bcf(bcf_bytes(file, version), "again");
        EXPECT_EQ(again.topics[0].unknown, file.topics[0].unknown);
        EXPECT_EQ(again.entries, file.entries);
    }
}

TEST(Bcf, TurnsDocumentsOf21IntoThoseOf30) {
    const BcfFile file =
        parse({version_entry(),
               markup_entry("<Title>t</Title><DocumentReference><ReferencedDocument>../plan.pdf"
                            "</ReferencedDocument></DocumentReference>"),
               {"plan.pdf", "%PDF"}});
    const BcfFile again = parse_bcf(bcf_bytes(file, BcfVersion::v3_0), "again");
    ASSERT_EQ(again.documents.size(), 1U);
    EXPECT_EQ(again.documents[0].filename, "plan.pdf");
    EXPECT_EQ(again.topics[0].documents.at(0).reference, again.documents[0].guid);
    EXPECT_TRUE(std::ranges::any_of(again.entries, [&](const BcfEntry& entry) {
        return entry.name == "documents/" + again.documents[0].guid && entry.bytes == "%PDF";
    }));
    // And back: the reference is a path again.
    const BcfFile back = parse_bcf(bcf_bytes(again, BcfVersion::v2_1), "back");
    EXPECT_EQ(back.topics[0].documents.at(0).reference, "../documents/" + again.documents[0].guid);
}

TEST(Bcf, KeepsWordsOfComments20) {
    const BcfFile file = parse(
        {version_entry("2.0"),
         {std::string(kGuid) + "/markup.bcf",
          "<Markup><Topic Guid=\"" + std::string(kGuid) +
              "\"><Title>t</Title></Topic>"
              "<Comment Guid=\"11111111-8f4e-4f0a-9f5e-0123456789ab\"><VerbalStatus>Open"
              "</VerbalStatus><Status>Error</Status><Date>2015-01-01T00:00:00Z</Date><Author>a"
              "</Author><Comment>c</Comment><Topic Guid=\"" +
              std::string(kGuid) +
              "\"/></Comment>"
              "</Markup>"}});
    EXPECT_EQ(file.topics.at(0).comments.at(0).text, "c\n[status: Error, verbal status: Open]");
    EXPECT_TRUE(file.topics[0].comments[0].unknown.elements.empty());
    EXPECT_THROW(bcf_bytes(file, BcfVersion::v2_0), Error);
}

TEST(Bcf, RefusesHostileArchives) {
    for (const char* name : {"../evil", "a/../../evil", "/etc/passwd", "C:/evil", "a\\..\\..\\evil",
                             "a/./b", "a//b"}) {
        // The library that packs refuses these names, so a name of equal length is replaced.
        std::string bytes = archive_of({version_entry(), {std::string(strlen(name), 'x'), "1"}});
        for (std::size_t at;
             (at = bytes.find(std::string(strlen(name), 'x'))) != std::string::npos;)
            bytes.replace(at, strlen(name), name);
        EXPECT_THROW(parse_bcf(bytes, "site.bcf"), Error) << name;
    }
    std::string twice = archive_of({version_entry(), {"aaa", "1"}, {"bbb", "2"}});
    for (std::size_t at; (at = twice.find("bbb")) != std::string::npos;)
        twice.replace(at, 3, "aaa");
    EXPECT_THROW(parse_bcf(twice, "site.bcf"), Error);
    EXPECT_THROW(pack_archive({{"../a", ""}}), Error);
    EXPECT_THROW(pack_archive({{"a", "1"}, {"a", "2"}}), Error);
    EXPECT_THROW(parse_bcf("", "site.bcf"), Error);
    EXPECT_THROW(parse_bcf("PK\3\4 but no archive", "site.bcf"), Error);
}

TEST(Bcf, RefusesWhatUnpacksToTooMuch) {
    const std::vector<BcfEntry> bomb{version_entry(), {"zeros", std::string(10'000'000, '\0')}};
    EXPECT_LT(archive_of(bomb).size(), 20'000U);
    BcfLimits limits;
    limits.bytes = 1'000'000;
    EXPECT_TRUE(holds(refusal(bomb, limits), "zeros: unpacks to more bytes"));
    limits = {};
    limits.entries = 1;
    EXPECT_TRUE(holds(refusal(bomb, limits), "too many entries"));
    limits = {};
    limits.xml_bytes = 10;
    EXPECT_TRUE(holds(refusal({version_entry()}, limits), "bcf.version: is larger"));
}

TEST(Bcf, RefusesHostileXml) {
    std::string deep;
    for (int i = 0; i < 100'000; ++i)
        deep += "<a>";
    for (int i = 0; i < 100'000; ++i)
        deep += "</a>";
    EXPECT_TRUE(holds(refusal({version_entry(), markup_entry(deep)}), "nested too deep"));
    const std::string entity =
        "<!DOCTYPE Markup [<!ENTITY a SYSTEM \"file:///etc/passwd\">]><Markup><Topic Guid=\"" +
        std::string(kGuid) + "\"><Title>&a;</Title></Topic></Markup>";
    EXPECT_TRUE(holds(refusal({version_entry(), {std::string(kGuid) + "/markup.bcf", entity}}),
                      "document type declaration"));
    EXPECT_TRUE(
        holds(refusal({version_entry(), markup_entry("<Title>\xff\xfe</Title>")}), "not UTF-8"));
    EXPECT_TRUE(holds(refusal({version_entry(), markup_entry("<Title>t</Topic>")}), "markup.bcf"));
    EXPECT_TRUE(holds(refusal({version_entry(), markup_entry("<Index>one</Index>")}),
                      "Index is not an integer"));
    EXPECT_TRUE(holds(refusal({version_entry("9.9")}), "none of 2.0, 2.1 and 3.0"));
    EXPECT_TRUE(holds(refusal({version_entry(), {"a/markup.bcf", "<Markup/>"}}), "no topic"));
    EXPECT_TRUE(
        holds(refusal({version_entry(), {"a/markup.bcf", "<Markup><Topic Guid=\"x\"/></Markup>"}}),
              "no GUID"));
    const std::string view = "<VisualizationInfo><PerspectiveCamera><CameraViewPoint><X>nan</X>"
                             "</CameraViewPoint></PerspectiveCamera></VisualizationInfo>";
    BcfEntry markup = markup_entry("");
    markup.bytes.insert(markup.bytes.size() - 9,
                        "<Viewpoints Guid=\"" + std::string(kGuid) +
                            "\"><Viewpoint>v.bcfv</Viewpoint></Viewpoints>");
    EXPECT_TRUE(holds(refusal({version_entry(), markup, {std::string(kGuid) + "/v.bcfv", view}}),
                      "v.bcfv: X is not a number"));
}

TEST(Bcf, SurvivesDamage) {
    Random random(2011);
    int refused = 0, read = 0;
    for (int round = 0; round < many(150); ++round) {
        std::string bytes = bcf_bytes(RandomBcf(random).file(1), BcfVersion::v2_1);
        if (random.chance(0.3)) {
            bytes.resize(
                static_cast<std::size_t>(random.integer(0, static_cast<int>(bytes.size()) - 1)));
        } else {
            for (int i = random.integer(1, 8); i > 0; --i)
                bytes[static_cast<std::size_t>(
                    random.integer(0, static_cast<int>(bytes.size()) - 1))] =
                    static_cast<char>(random.integer(0, 255));
        }
        try {
            parse_bcf(bytes, "damaged");
            ++read;
        } catch (const Error& error) {
            EXPECT_TRUE(holds(error.what(), "damaged"));
            ++refused;
        }
    }
    std::cout << refused << " refused, " << read << " read\n";
    EXPECT_GT(refused, 50);
}

TEST(Bcf, RefusesToWriteWhatItCouldNotRead) {
    BcfFile file;
    file.topics.push_back({});
    EXPECT_THROW(bcf_bytes(file, BcfVersion::v2_1), Error);
    file.topics[0].guid = kGuid;
    EXPECT_NO_THROW(bcf_bytes(file, BcfVersion::v2_1));
    file.topics.push_back(file.topics[0]);
    EXPECT_THROW(bcf_bytes(file, BcfVersion::v2_1), Error);
    file.topics.pop_back();
    file.topics[0].folder = "../..";
    EXPECT_THROW(bcf_bytes(file, BcfVersion::v2_1), Error);
    const Folder folder;
    EXPECT_THROW(read_bcf(folder / "none.bcf"), Error);
}

} // namespace
} // namespace abut::test
