#pragma once

#include "tests/command/models.h"
#include "tests/command/run_command.h"

#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace abut::test {

/// Fixture with a file that holds the unit box.
class BoxTest : public ::testing::Test {
protected:
    TemporaryFolder folder_;
    std::string box_ = folder_.write("box.obj", box_obj());
};

/// Queries of the box with itself.
class TwoBoxesTest : public BoxTest {
protected:
    Outcome ask(const std::string& verb, std::vector<std::string> options) {
        options.insert(options.begin(), {verb, box_, box_});
        return run_abut(options);
    }
};

} // namespace abut::test
