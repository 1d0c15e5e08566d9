#include "io/polygon/obj_scan.h"

#include "io/file/fault.h"

#include <string>
#include <vector>

namespace abut {

namespace {

bool is_comment(std::string_view line) {
    const std::size_t first = line.find_first_not_of(" \t");
    return first != std::string_view::npos && line[first] == '#';
}

/// Takes a line and those that a final backslash joins to it. A comment may end in a backslash by
/// accident, for example in a folder's name.
bool next_logical(LineScan& lines, std::string_view& line, std::string& joined) {
    if (!lines.next(line))
        return false;
    if (line.empty() || line.back() != '\\' || is_comment(line))
        return true;
    joined.clear();
    do {
        joined.append(line.substr(0, line.size() - 1)).push_back(' ');
        line = {};
    } while (lines.next(line) && !line.empty() && line.back() == '\\');
    joined.append(line);
    line = joined;
    return true;
}

/// Reads the corners of faces as indices from 0.
class CornerReader {
public:
    /// In          rest: the text after `f` on its line; vertices: their number so far.
    std::span<const std::uint64_t> read(std::string_view rest, std::uint64_t vertices,
                                        const LineScan& lines) {
        corners_.clear();
        for (std::string_view corner = take_word(rest); !corner.empty() && corner[0] != '#';
             corner = take_word(rest)) {
            const auto number = to_number<std::int64_t>(corner.substr(0, corner.find('/')));
            if (!number)
                malformed(lines.place() + ": a face has the invalid corner " + std::string(corner));
            corners_.push_back(index_of(*number, vertices, lines));
        }
        if (corners_.size() < 3)
            malformed(lines.place() + ": a face needs three corners");
        return corners_;
    }

    /// In          vertices: their number in the whole file.
    /// Errors      Fault bad_mesh if a corner exceeds it.
    void check(std::uint64_t vertices) const {
        if (largest_ > vertices)
            throw Fault(ErrorCode::bad_mesh,
                        "line " + std::to_string(largest_line_) + ": a face refers to vertex " +
                            std::to_string(largest_) + " of " + std::to_string(vertices));
    }

private:
    /// A number counts from 1, or backwards from -1, which is the last vertex so far.
    std::uint64_t index_of(std::int64_t number, std::uint64_t vertices, const LineScan& lines) {
        const auto forward = static_cast<std::uint64_t>(number);
        const std::uint64_t back = 0 - forward;
        if (number == 0 || (number < 0 && back > vertices))
            throw Fault(ErrorCode::bad_mesh, lines.place() + ": a face refers to vertex " +
                                                 std::to_string(number) + ", which does not exist");
        if (number < 0)
            return vertices - back;
        if (forward > largest_) {
            largest_ = forward;
            largest_line_ = lines.number();
        }
        return forward - 1;
    }

    std::vector<std::uint64_t> corners_;
    std::uint64_t largest_ = 0;
    std::uint64_t largest_line_ = 0;
};

} // namespace

void scan_obj(ByteStream& content, const std::function<void(const Vec3&)>& vertex,
              const std::function<void(std::span<const std::uint64_t> corners)>& face,
              const std::function<void(std::string_view statement, std::string_view name)>& name) {
    LineScan lines(content);
    CornerReader corners;
    std::string_view line;
    std::string joined;
    std::uint64_t vertices = 0;
    while (next_logical(lines, line, joined)) {
        std::string_view rest = line;
        const std::string_view word = take_word(rest);
        if (word == "v") {
            vertex(take_position(rest, lines));
            ++vertices;
        } else if (word == "f") {
            face(corners.read(rest, vertices, lines));
        } else if (name && (word == "o" || word == "g" || word == "mtllib" || word == "usemtl")) {
            name(word, trimmed(rest));
        }
    }
    corners.check(vertices);
}

void ObjParts::name(std::string_view statement, std::string_view name) {
    if (statement == "o") {
        object_ = name;
        group_.clear();
        part_of_group_.clear();
    } else if (statement == "g") {
        group_ = name == "default" ? std::string_view() : name;
    }
    current_.reset();
}

std::size_t ObjParts::of_face() {
    if (!current_) {
        const auto [entry, is_new] = part_of_group_.try_emplace(group_, ids_.size());
        if (is_new)
            ids_.push_back(!group_.empty() ? group_ : !object_.empty() ? object_ : "defaultobject");
        current_ = entry->second;
    }
    return *current_;
}

} // namespace abut
