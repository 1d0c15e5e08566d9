#pragma once

#include "tests/command/models.h"
#include "tests/command/run_command.h"

#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace abut::test {

/// A test of the command with a file that holds the unit box.
class BoxTest : public ::testing::Test {
protected:
    TemporaryFolder folder_;
    std::string box_ = folder_.write("box.obj", box_obj());
};

/// The box against itself.
class TwoBoxesTest : public BoxTest {
protected:
    Outcome ask(const std::string& verb, std::vector<std::string> options) {
        options.insert(options.begin(), {verb, box_, box_});
        return run_abut(options);
    }
};

} // namespace abut::test
