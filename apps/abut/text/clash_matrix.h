#pragma once

#include <abut/clash.h>

#include <string>

namespace abut::command {

/// Draws a matrix of counts for the terminal: a row and a column for each group. A cell has the
/// number of its clashes; "off" if its pairs are not examined, "-" if there is no such cell.
std::string drawn(const ClashReport::Matrix& matrix);

/// Returns one line for each reason why pairs are not in the report, and one for known neighbours
/// that are. Empty if there are none.
std::string left_out_text(const ClashReport& report);

} // namespace abut::command
