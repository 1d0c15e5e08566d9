#pragma once

#include "tree/obb_tree.h"

#include <cstring>
#include <gtest/gtest.h>

namespace abut::test {

template <typename Value>
bool same_bytes(const Value& a, const Value& b) {
    return std::memcmp(&a, &b, sizeof a) == 0;
}

/// Expects that two trees are equal bit for bit.
inline void expect_same_tree(const Tree& a, const Tree& b) {
    ASSERT_EQ(a.order, b.order);
    ASSERT_EQ(a.nodes.size(), b.nodes.size());
    for (std::size_t i = 0; i < a.nodes.size(); ++i) {
        const Node &x = a.nodes[i], &y = b.nodes[i];
        ASSERT_TRUE(same_bytes(x.child, y.child)) << "node " << i;
        ASSERT_TRUE(same_bytes(x.lower, y.lower) && same_bytes(x.upper, y.upper)) << "node " << i;
        ASSERT_TRUE(same_bytes(x.frame.turn, y.frame.turn)) << "node " << i;
        ASSERT_TRUE(same_bytes(x.frame.origin, y.frame.origin)) << "node " << i;
        ASSERT_EQ(x.frame.turned, y.frame.turned);
        ASSERT_TRUE(same_bytes(x.bounds, y.bounds) && same_bytes(x.reach, y.reach));
    }
    ASSERT_TRUE(same_bytes(a.bounds, b.bounds));
    ASSERT_EQ(a.leaves.size(), b.leaves.size());
    for (std::size_t i = 0; i < a.leaves.size(); ++i)
        ASSERT_TRUE(same_bytes(a.leaves[i], b.leaves[i])) << "leaf " << i;
}

} // namespace abut::test
