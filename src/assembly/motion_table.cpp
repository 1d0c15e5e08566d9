#include "assembly/motion_table.h"

#include <abut/error.h>

#include "io/file/text_scan.h"
#include "io/file/text_stream.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <sstream>
#include <string_view>
#include <vector>

namespace abut {

namespace {

constexpr std::array<std::string_view, 7> kPoseColumns{".x",  ".y",  ".z", ".qw",
                                                       ".qx", ".qy", ".qz"};
constexpr std::uint32_t kTime = ~std::uint32_t{0};

std::vector<std::string> cells_of(std::string_view line) {
    std::vector<std::string> cells(1);
    bool quoted = false;
    for (const char c : line) {
        if (c == '"')
            quoted = !quoted;
        else if (c == ',' && !quoted)
            cells.emplace_back();
        else
            cells.back() += c;
    }
    for (std::string& cell : cells)
        cell = std::string(trimmed(cell));
    return cells;
}

class MotionTable {
public:
    MotionTable(const std::string& path, const AssemblyUnits& units, Assembly& assembly)
        : path_(path), units_(units), assembly_(assembly) {}

    void read() {
        std::ifstream in = open_text(path_);
        for (std::string line; std::getline(in, line);) {
            ++line_;
            if (line_ == 1 && line.starts_with("\xEF\xBB\xBF"))
                line.erase(0, 3);
            const std::string_view text = trimmed(line);
            if (text.empty() || text.front() == '#')
                continue;
            if (columns_.empty())
                read_header(cells_of(text));
            else
                read_row(cells_of(text));
        }
        if (in.bad())
            throw Error(ErrorCode::unreadable, path_, "cannot be read");
        if (times_.empty())
            throw Error(ErrorCode::malformed, path_, "has no rows of values");
        for (const Column& column : columns_)
            if (column.part != kTime)
                assembly_.parts[column.part].joint.keys.times = times_;
    }

private:
    struct Column {
        std::uint32_t part = kTime;
        int element = -1;         ///< of a pose; -1: the value of a joint
        bool begins_pose = false; ///< it is the first column of its pose
    };

    [[noreturn]] void fail(const std::string& what) const {
        throw Error(ErrorCode::malformed, path_, "line " + std::to_string(line_) + ": " + what);
    }

    void read_header(const std::vector<std::string>& names) {
        for (const std::string& name : names) {
            const Column column = column_of(name);
            if (std::ranges::any_of(columns_, [&](const Column& other) {
                    return other.part == column.part && other.element == column.element;
                }))
                fail("the column '" + name + "' comes twice");
            columns_.push_back(column);
            columns_.back().begins_pose =
                column.element >= 0 &&
                std::ranges::count(columns_, column.part, &Column::part) == 1;
        }
        if (std::ranges::find(columns_, kTime, &Column::part) == columns_.end())
            fail("has no column 'time'");
        for (const Column& column : columns_) {
            if (column.part == kTime || column.element < 0)
                continue;
            const auto count = std::ranges::count(columns_, column.part, &Column::part);
            if (count != std::ssize(kPoseColumns))
                fail("a pose of '" + assembly_.parts[column.part].name +
                     "' needs the columns .x, .y, .z, .qw, .qx, .qy and .qz");
        }
    }

    [[nodiscard]] Column column_of(const std::string& name) const {
        if (name == "time")
            return {};
        for (std::uint32_t part = 0; part < assembly_.parts.size(); ++part) {
            const AssemblyPart& of = assembly_.parts[part];
            if (!name.starts_with(of.name))
                continue;
            const std::string rest = name.substr(of.name.size());
            const bool is_free = of.joint.type == AssemblyJointType::free;
            const auto element = std::ranges::find(kPoseColumns, rest);
            const bool fits = is_free ? element != kPoseColumns.end() : rest.empty();
            if (!fits)
                continue;
            if (of.joint.type == AssemblyJointType::fixed)
                fail("the column '" + name + "' is that of a part whose joint is fixed");
            if (!of.joint.keys.times.empty())
                fail("the part '" + of.name + "' has keys already");
            return {part, is_free ? static_cast<int>(element - kPoseColumns.begin()) : -1, false};
        }
        fail("the column '" + name +
             "' is neither 'time' nor a joint: parts with one value have "
             "the column NAME, free ones NAME.x to NAME.qz");
    }

    void read_row(const std::vector<std::string>& cells) {
        if (cells.size() != columns_.size())
            fail("has " + std::to_string(cells.size()) + " values where the first line names " +
                 std::to_string(columns_.size()));
        for (std::size_t i = 0; i < cells.size(); ++i) {
            const std::optional<double> number = to_number<double>(cells[i]);
            if (!number || !std::isfinite(*number))
                fail("'" + cells[i] + "' is not a finite number");
            add(columns_[i], *number);
        }
        if (times_.size() > 1 && !(times_[times_.size() - 2] < times_.back()))
            fail("its time does not come after that of the line before");
    }

    void add(const Column& column, double number) {
        if (column.part == kTime) {
            times_.push_back(number);
            return;
        }
        AssemblyJoint& joint = assembly_.parts[column.part].joint;
        if (column.element < 0) {
            const bool turns = joint.type == AssemblyJointType::revolute;
            joint.keys.values.push_back(number * (turns ? units_.angle : units_.length));
            return;
        }
        // The first column of a pose in the file begins a new one.
        if (column.begins_pose)
            joint.keys.poses.emplace_back();
        Pose& pose = joint.keys.poses.back();
        const std::array<double*, 3> place{&pose.translation.x, &pose.translation.y,
                                           &pose.translation.z};
        const auto element = static_cast<std::size_t>(column.element);
        if (element < place.size())
            *place.at(element) = number * units_.length;
        else
            pose.rotation.at(element - place.size()) = number;
    }

    const std::string& path_;
    const AssemblyUnits& units_;
    Assembly& assembly_;
    std::size_t line_ = 0;
    std::vector<Column> columns_;
    std::vector<double> times_;
};

} // namespace

void read_motion_table(const std::string& path, const AssemblyUnits& units, Assembly& assembly) {
    MotionTable(path, units, assembly).read();
}

} // namespace abut
