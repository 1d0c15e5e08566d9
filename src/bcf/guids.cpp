#include "bcf/bcf_parts.h"
#include "core/uuid.h"

#include <utility>

namespace abut {

namespace {

/// The name space of the GUIDs that files lack.
constexpr const char* kGuidSpace = "b4d8f9a2-7c31-5e60-8a4b-1f2e3d4c5b6a";

} // namespace

std::string missing_guid(const std::string& name) {
    return uuid_of_name(kGuidSpace, name);
}

std::string written_guid(std::string guid, BcfVersion version) {
    return version == BcfVersion::v3_0 ? lower_uuid(std::move(guid)) : guid;
}

} // namespace abut
