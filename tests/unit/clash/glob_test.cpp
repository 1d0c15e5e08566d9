#include "clash/query/glob.h"

#include <gtest/gtest.h>

namespace abut::test {
namespace {

TEST(GlobMatch, ByHand) {
    EXPECT_TRUE(glob_match("", ""));
    EXPECT_FALSE(glob_match("", "a"));
    EXPECT_TRUE(glob_match("*", ""));
    EXPECT_TRUE(glob_match("**", "abc"));
    EXPECT_TRUE(glob_match("a?c", "abc"));
    EXPECT_FALSE(glob_match("a?c", "ac"));
    EXPECT_TRUE(glob_match("T?r", "T\xC3\xBCr")); // one character of two bytes
    EXPECT_TRUE(glob_match("*?r", "T\xC3\xBCr"));
    EXPECT_FALSE(glob_match("T??r", "T\xC3\xBCr"));
    EXPECT_FALSE(glob_match("*T??r", "T\xC3\xBCr"));
    EXPECT_TRUE(glob_match("*.glb", "dir/a.glb"));
    EXPECT_FALSE(glob_match("*.glb", "a.glbx"));
    EXPECT_TRUE(glob_match("*ab*ab", "xababab"));
    EXPECT_FALSE(glob_match("*ab*abc", "xababab"));
    EXPECT_FALSE(glob_match("abc", "ab"));
    EXPECT_FALSE(glob_match("ab", "abc"));
    EXPECT_FALSE(glob_match("[a]", "a")); // character sets are not supported
    EXPECT_FALSE(glob_match("A", "a"));
    EXPECT_FALSE(glob_match(std::string(200, '*') + "b", std::string(5000, 'a'))); // ends soon
}

} // namespace
} // namespace abut::test
