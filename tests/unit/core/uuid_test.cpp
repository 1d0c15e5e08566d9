#include "core/uuid.h"

#include <gtest/gtest.h>

namespace abut::test {
namespace {

TEST(Uuid, OfNamesIsThatOfTheStandard) {
    // The name space of domain names [RFC 4122, appendix C]; the values are those of Python's uuid5.
    const char* const dns = "6ba7b810-9dad-11d1-80b4-00c04fd430c8";
    EXPECT_EQ(uuid_of_name(dns, "www.example.com"), "2ed6657d-e927-568b-95e1-2665a8aea6a2");
    EXPECT_EQ(uuid_of_name(dns, "python.org"), "886313e1-3b8a-5372-9b90-0c9aee199e5d");
    // Longer than a block of SHA-1.
    EXPECT_EQ(uuid_of_name(dns, std::string(200, 'a')), "fe30bfa6-ef90-59b3-b108-118411d0f0ab");
    EXPECT_TRUE(is_uuid(uuid_of_name(dns, "x")));
    EXPECT_FALSE(is_uuid("886313e1-3b8a-5372-9b90-0c9aee199e5"));
    EXPECT_FALSE(is_uuid("886313e1-3b8a-5372-9b90+0c9aee199e5d"));
}

} // namespace
} // namespace abut::test
