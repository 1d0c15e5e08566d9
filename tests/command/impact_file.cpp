#include "tests/command/impact_file.h"

#include "tests/command/run_command.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <gtest/gtest.h>
#include <sstream>

namespace abut::test {

namespace {

constexpr std::array<const char*, 3> kStatuses{"exact", "converged", "bound_only"};

Status status_of(const std::string& word) {
    const auto* const found = std::find(kStatuses.begin(), kStatuses.end(), word);
    if (found == kStatuses.end())
        ADD_FAILURE() << "status " << word;
    return static_cast<Status>(found - kStatuses.begin());
}

std::vector<WrittenImpact> read_csv(const std::string& text) {
    std::istringstream lines(text);
    std::string line;
    std::getline(lines, line);
    EXPECT_EQ(line, "step,kind,a,b,time,u,v,w,nx,ny,nz,status");
    EXPECT_EQ(text.back(), '\n');
    std::vector<WrittenImpact> impacts;
    while (std::getline(lines, line)) {
        std::vector<std::string> cells;
        std::istringstream row(line);
        for (std::string cell; std::getline(row, cell, ',');)
            cells.push_back(cell);
        if (cells.size() != 12) {
            ADD_FAILURE() << "line of " << cells.size() << " cells: " << line;
            return impacts;
        }
        const auto real = [&](std::size_t i) { return std::stod(cells.at(i)); };
        const auto id = [&](std::size_t i) {
            return static_cast<std::uint32_t>(std::stoul(cells[i]));
        };
        WrittenImpact& w = impacts.emplace_back();
        w.step = id(0);
        w.impact.kind =
            cells[1] == "edge-edge" ? ElementaryKind::edge_edge : ElementaryKind::vertex_face;
        w.impact.status = status_of(cells[11]);
        EXPECT_TRUE(cells[1] == "edge-edge" || cells[1] == "vertex-face") << line;
        w.impact.a = id(2);
        w.impact.b = id(3);
        w.impact.time = real(4);
        w.impact.barycentric = {real(5), real(6), real(7)};
        w.impact.normal = {real(8), real(9), real(10)};
    }
    return impacts;
}

/// A value stored with the least significant byte first, on a machine that does the same.
template <typename Value>
Value value_at(const std::string& bytes, std::size_t offset) {
    Value value{};
    std::memcpy(&value, bytes.substr(offset, sizeof value).data(), sizeof value);
    return value;
}

std::vector<WrittenImpact> read_binary(const std::string& bytes) {
    constexpr std::size_t kHeader = 16, kRecord = 72;
    EXPECT_EQ(bytes.substr(0, 8), "ABUTCCD\n");
    EXPECT_EQ(value_at<std::uint32_t>(bytes, 8), 1U);
    EXPECT_EQ(value_at<std::uint32_t>(bytes, 12), kRecord);
    EXPECT_EQ((bytes.size() - kHeader) % kRecord, 0U);
    std::vector<WrittenImpact> impacts;
    for (std::size_t at = kHeader; at + kRecord <= bytes.size(); at += kRecord) {
        WrittenImpact& w = impacts.emplace_back();
        w.step = value_at<std::uint32_t>(bytes, at);
        EXPECT_LE(value_at<std::uint8_t>(bytes, at + 4), 1);
        EXPECT_LE(value_at<std::uint8_t>(bytes, at + 5), 2);
        EXPECT_EQ(value_at<std::uint16_t>(bytes, at + 6), 0);
        const bool edges = value_at<std::uint8_t>(bytes, at + 4) == 1;
        w.impact.kind = edges ? ElementaryKind::edge_edge : ElementaryKind::vertex_face;
        w.impact.status = static_cast<Status>(value_at<std::uint8_t>(bytes, at + 5));
        w.impact.a = value_at<std::uint32_t>(bytes, at + 8);
        w.impact.b = value_at<std::uint32_t>(bytes, at + 12);
        w.impact.time = value_at<double>(bytes, at + 16);
        w.impact.barycentric = value_at<std::array<double, 3>>(bytes, at + 24);
        w.impact.normal = value_at<Vec3>(bytes, at + 48);
    }
    return impacts;
}

} // namespace

std::vector<WrittenImpact> read_impacts(const std::string& file) {
    const std::string content = read_file(file);
    if (content.empty()) {
        ADD_FAILURE() << file << " is empty or missing";
        return {};
    }
    return file.ends_with(".bin") ? read_binary(content) : read_csv(content);
}

} // namespace abut::test
