#include "tree/near_first_queue.h"

#include <gtest/gtest.h>
#include <limits>
#include <vector>

namespace abut {
namespace {

TEST(NearFirstQueue, GivesTheSmallestKeyToWithinABucket) {
    NearFirstQueue<float> queue(100);
    std::vector<float> keys;
    for (int i = 0; i < 1000; ++i) {
        keys.push_back(static_cast<float>(i * 7919 % 1000) * 0.1F);
        queue.push(keys.back(), keys.back());
    }
    float largest = 0;
    std::size_t count = 0;
    for (; !queue.empty(); ++count) {
        const float key = queue.pop();
        EXPECT_GE(key * 1.25F, largest);
        largest = std::max(largest, key);
    }
    EXPECT_EQ(count, keys.size());
    EXPECT_FLOAT_EQ(largest, 99.9F);
}

TEST(NearFirstQueue, EqualKeysComeLastInFirstOut) {
    NearFirstQueue<int> queue(1);
    queue.push(0, 1);
    queue.push(0, 2);
    EXPECT_EQ(queue.pop(), 2);
    queue.push(0, 3);
    EXPECT_EQ(queue.pop(), 3);
    EXPECT_EQ(queue.pop(), 1);
    EXPECT_TRUE(queue.empty());
}

TEST(NearFirstQueue, AKeyThatIsNotANumberIsNeverAboveABound) {
    NearFirstQueue<int> queue(1);
    queue.push(std::numeric_limits<float>::quiet_NaN(), 1);
    queue.push(-std::numeric_limits<float>::quiet_NaN(), 2);
    EXPECT_FALSE(queue.all_above(0));
    queue.pop(), queue.pop();
    queue.push(std::numeric_limits<float>::infinity(), 3);
    EXPECT_TRUE(queue.all_above(0.5F));
}

} // namespace
} // namespace abut
