/// Any bytes as a BCF file give a file that can be written and read again, or an Error.
#include <abut/bcf.h>
#include <abut/error.h>

#include "bcf/archive.h"

#include <cstdint>
#include <cstdlib>
#include <string>

namespace {

/// Small limits, so that the fuzzer spends its time on the content.
constexpr abut::BcfLimits kLimits{100, 1U << 20U, 1U << 18U};

void read_and_write(const std::string& bytes) {
    abut::BcfFile file;
    try {
        file = abut::parse_bcf(bytes, "fuzzed", kLimits);
    } catch (const abut::Error&) { // an Error is a valid answer
        return;
    }
    for (const abut::BcfVersion version : {abut::BcfVersion::v2_1, abut::BcfVersion::v3_0}) {
        std::string written;
        try {
            written = abut::bcf_bytes(file, version);
        } catch (const abut::Error& error) {
            if (error.code() != abut::ErrorCode::bad_argument)
                std::abort();
            continue;
        }
        const abut::BcfFile again = abut::parse_bcf(written, "written");
        if (again.topics.size() != file.topics.size() || abut::bcf_bytes(again, version) != written)
            std::abort();
    }
}

} // namespace

/// The first byte says what the others are: an archive, a topic's markup, or a viewpoint.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0)
        return 0;
    const std::string bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
    if (data[0] % 3 == 0) {
        read_and_write(bytes);
        return 0;
    }
    const std::string version = data[0] % 2 == 0 ? "2.1" : "3.0";
    const std::string markup =
        "<Markup><Topic Guid=\"0b9f1c1e-8f4e-4f0a-9f5e-0123456789ab\"><Viewpoints><ViewPoint "
        "Guid=\"0b9f1c1e-8f4e-4f0a-9f5e-0123456789ac\"><Viewpoint>v.bcfv</Viewpoint></ViewPoint>"
        "</Viewpoints></Topic></Markup>";
    const bool is_markup = data[0] % 3 == 1;
    read_and_write(abut::pack_archive({{"bcf.version", "<Version VersionId=\"" + version + "\"/>"},
                                       {"a/markup.bcf", is_markup ? bytes : markup},
                                       {"a/v.bcfv", is_markup ? "<VisualizationInfo/>" : bytes}}));
    return 0;
}
