#include <abut/clash.h>
#include <abut/error.h>

#include "clash/rules/preset_texts.h"
#include "clash/rules/settings_file.h"
#include "clash/rules/settings_reader.h"

#include <algorithm>

namespace abut {

namespace {

using Json = nlohmann::json;

/// Reads one matrix.
class MatrixReader {
public:
    MatrixReader(const std::string& file, const Json& root) : reader_(file), root_(root) {}

    ClashMatrix read() {
        reader_.require_keys(root_, "the file", {"$schema", "groups", "cells"});
        for (const Json& value : reader_.read_list(root_, "groups", "group"))
            read_group(value, "groups[" + std::to_string(matrix_.groups.size()) + "]");
        has_cell_.resize(matrix_.groups.size() * matrix_.groups.size());
        std::size_t number = 0;
        for (const Json& value : reader_.read_list(root_, "cells", "cell"))
            read_cell(value, "cells[" + std::to_string(number++) + "]");
        return std::move(matrix_);
    }

private:
    /// Enough for any building, and few enough for a table of all pairs of groups.
    static constexpr std::size_t kMostGroups = 100;

    void read_group(const Json& value, const std::string& where) {
        reader_.require_keys(value, where, {"name", "select"});
        if (matrix_.groups.size() == kMostGroups)
            reader_.fail("groups", "must be at most " + std::to_string(kMostGroups));
        ClashMatrix::Group group;
        group.name = reader_.read_text(value, "name", where);
        // This check makes sure that the name "A / B" of a cell is that of no other two groups.
        if (group.name.empty() || group.name == "*" ||
            (' ' + group.name + ' ').find(" / ") != std::string::npos)
            reader_.fail(where + ".name",
                         "must not be empty or *, and have no / that stands alone");
        if (find(group.name))
            reader_.fail(where + ".name", "is the name of an earlier group, too");
        if (!value.contains("select") || !value["select"].is_string())
            reader_.fail(where + ".select", "must be a condition in a text");
        group.select = reader_.read_query(value["select"], where + ".select");
        matrix_.groups.push_back(std::move(group));
    }

    [[nodiscard]] std::optional<std::uint32_t> find(const std::string& name) const {
        const auto at = std::ranges::find(matrix_.groups, name, &ClashMatrix::Group::name);
        if (at == matrix_.groups.end())
            return std::nullopt;
        return static_cast<std::uint32_t>(at - matrix_.groups.begin());
    }

    /// Returns the groups that one side of a cell names.
    [[nodiscard]] std::vector<std::uint32_t> read_side(const Json& cell, const char* key,
                                                       const std::string& where) const {
        const std::string here = where + "." + key;
        if (!cell.contains(key))
            reader_.fail(here, "must be the name of a group, a list of such names, or *");
        std::vector<std::uint32_t> result;
        for (const std::string& name : reader_.read_texts(cell[key], here, "name")) {
            if (name == "*") {
                for (std::uint32_t g = 0; g < matrix_.groups.size(); ++g)
                    result.push_back(g);
                continue;
            }
            const auto group = find(name);
            if (!group)
                reader_.fail(here, "names no group: \"" + name + "\"");
            result.push_back(*group);
        }
        return result;
    }

    void read_cell(const Json& value, const std::string& where) {
        reader_.require_keys(
            value, where,
            {"a", "b", "on", "clearance", "touch", "tolerate", "kinds", "severity", "ignore"});
        ClashMatrix::Cell cell;
        cell.examined = reader_.read_flag(value, "on", true, where);
        reader_.read_terms(value, cell.terms, where);
        for (const std::uint32_t a : read_side(value, "a", where))
            for (const std::uint32_t b : read_side(value, "b", where))
                add(cell, std::min(a, b), std::max(a, b));
    }

    /// Adds a cell for two groups, unless an earlier one is about them.
    void add(ClashMatrix::Cell cell, std::uint32_t a, std::uint32_t b) {
        const std::size_t place = a * matrix_.groups.size() + b;
        if (has_cell_[place])
            return;
        has_cell_[place] = true;
        cell.a = a, cell.b = b;
        cell.terms.name = matrix_.groups[a].name + " / " + matrix_.groups[b].name;
        matrix_.cells.push_back(std::move(cell));
    }

    SettingsReader reader_;
    const Json& root_;
    ClashMatrix matrix_;
    std::vector<bool> has_cell_; ///< by both groups
};

} // namespace

ClashMatrix read_matrix(const std::string& path) {
    const Json root = read_settings(path);
    return MatrixReader(path, root).read();
}

std::string_view matrix_preset_text(std::string_view name) {
    const auto at = std::ranges::find(kMatrixPresets, name);
    if (at == kMatrixPresets.end())
        throw Error(ErrorCode::bad_argument,
                    "there is no preset \"" + std::string(name) +
                        "\": there are mep-structure, clearances and architecture");
    return kPresetTexts.at(static_cast<std::size_t>(at - kMatrixPresets.begin()));
}

ClashMatrix matrix_preset(std::string_view name) {
    const std::string file(name);
    const Json root = parse_toml(matrix_preset_text(name), file);
    return MatrixReader(file, root).read();
}

} // namespace abut
