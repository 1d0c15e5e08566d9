#include "io/scene/model_frame.h"

#include <abut/error.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <string_view>
#include <utility>

namespace abut {

namespace {

/// A row of a quarter turn: coordinate `from` of the old world, with a sign.
struct Row {
    std::size_t from;
    bool negated;
};
using Turn = std::array<Row, 3>;

/// The turn from a world with this up axis to one with y up [COLLADA 1.4.1, up_axis].
Turn to_y_up(UpAxis up) {
    switch (up) {
    case UpAxis::x:
        return {{{1, true}, {0, false}, {2, false}}};
    case UpAxis::z:
        return {{{0, false}, {2, false}, {1, true}}};
    case UpAxis::y:
        break;
    }
    return {{{0, false}, {1, false}, {2, false}}};
}

Turn inverse(const Turn& turn) {
    Turn result{};
    for (std::size_t row = 0; row < 3; ++row)
        result.at(turn.at(row).from) = {row, turn.at(row).negated};
    return result;
}

/// Applies b, then a.
Turn compose(const Turn& a, const Turn& b) {
    Turn result{};
    for (std::size_t row = 0; row < 3; ++row) {
        const Row& middle = b.at(a.at(row).from);
        result.at(row) = {middle.from, middle.negated != a.at(row).negated};
    }
    return result;
}

constexpr std::array<std::pair<std::string_view, double>, 9> kUnits{{{"um", 1e-6},
                                                                     {"mm", 0.001},
                                                                     {"cm", 0.01},
                                                                     {"dm", 0.1},
                                                                     {"m", 1},
                                                                     {"km", 1000},
                                                                     {"in", 0.0254},
                                                                     {"ft", 0.3048},
                                                                     {"yd", 0.9144}}};

/// Metres per unit; 0 if the word is not a unit.
double unit_of(std::string_view word) {
    for (const auto& [name, unit] : kUnits)
        if (word == name)
            return unit;
    double value = 0;
    const char* const end = word.data() + word.size();
    const auto [rest, fault] = std::from_chars(word.data(), end, value);
    return fault == std::errc() && rest == end && std::isfinite(value) && value > 0 ? value : 0;
}

std::optional<UpAxis> up_of(std::string_view word) {
    for (const UpAxis up : {UpAxis::x, UpAxis::y, UpAxis::z})
        if (word == std::string(to_string(up)) + "-up")
            return up;
    return std::nullopt;
}

/// Stores a word in `path` if it is a unit or an axis; false if it is neither.
///
/// Errors      Error{bad_argument}, naming the file, if it has one already.
bool take_unit_or_axis(const std::string& word, const std::string& file, ModelPath& path) {
    const double unit = unit_of(word);
    const auto up = up_of(word);
    if (unit == 0 && !up)
        return false;
    if (unit > 0 ? path.unit > 0 : path.up.has_value())
        throw Error(ErrorCode::bad_argument, file,
                    "'" + word + "' gives its unit or its axis a second time");
    if (unit > 0)
        path.unit = unit;
    else
        path.up = up;
    return true;
}

bool is_there(const std::string& path) {
    std::error_code ignored;
    return std::filesystem::exists(path, ignored);
}

} // namespace

const char* to_string(UpAxis up) {
    return up == UpAxis::x ? "x" : up == UpAxis::y ? "y" : "z";
}

const char* to_string(NoteKind kind) {
    switch (kind) {
    case NoteKind::space:
        return "space";
    case NoteKind::cut_away:
        return "cut_away";
    case NoteKind::not_built:
        return "not_built";
    case NoteKind::open:
        break;
    }
    return "open";
}

ModelPath parse_model_path(const std::string& text) {
    if (is_there(text))
        return {text};
    // The file is the longest prefix that exists, or what remains without units and axes.
    std::size_t file_end = text.rfind(':');
    while (file_end != std::string::npos && file_end > 0 && !is_there(text.substr(0, file_end)))
        file_end = text.rfind(':', file_end - 1);
    const bool is_file = file_end != std::string::npos && file_end > 0;
    ModelPath result{text};
    for (std::size_t colon = text.rfind(':'); colon != std::string::npos && colon > 0;
         colon = text.rfind(':', colon - 1)) {
        const std::string word = text.substr(colon + 1, result.path.size() - colon - 1);
        if (!take_unit_or_axis(word, is_file ? text.substr(0, file_end) : text, result)) {
            if (!is_file)
                break;
            throw Error(
                ErrorCode::bad_argument, text.substr(0, file_end),
                "'" + word +
                    "' is neither a unit (um, mm, cm, dm, m, km, in, ft, yd, metres as a number) "
                    "nor an axis (x-up, y-up, z-up)");
        }
        result.path.resize(colon);
        if (is_file && colon == file_end)
            break;
    }
    return result;
}

ModelFrame model_frame(const FormatFrame& format, const ModelPath& path,
                       const ReadOptions& options) {
    const double otherwise = options.unit > 0 ? options.unit : 1;
    return {path.unit > 0     ? path.unit
            : format.unit > 0 ? format.unit
                              : otherwise,
            path.up ? *path.up : format.up.value_or(options.up)};
}

double scale_of(const FormatFrame& format, double applied, const ModelFrame& frame) {
    if (format.unit == 0)
        return frame.unit;
    return frame.unit == format.unit ? applied : applied * (frame.unit / format.unit);
}

Transform turned(const Transform& world_from_mesh, UpAxis from, UpAxis to) {
    if (from == to)
        return world_from_mesh;
    const Turn turn = compose(inverse(to_y_up(to)), to_y_up(from));
    Transform result;
    for (std::size_t column = 0; column < 12; column += 3)
        for (std::size_t row = 0; row < 3; ++row) {
            const double value = world_from_mesh.m.at(column + turn.at(row).from);
            result.m.at(column + row) = turn.at(row).negated ? 0.0 - value : 0.0 + value;
        }
    return result;
}

void scale(Transform& world_from_mesh, double factor) {
    if (factor != 1)
        for (double& value : world_from_mesh.m)
            value *= factor;
}

void turn_up(Scene& scene, UpAxis up) {
    for (Part& part : scene.parts)
        part.world_from_mesh = turned(part.world_from_mesh, scene.up, up);
    scene.up = up;
}

void into_one_frame(std::vector<Scene>& scenes) {
    for (Scene& scene : scenes)
        turn_up(scene, scenes.front().up);
}

} // namespace abut
