#include "core/paged_array.h"
#include "io/assimp_number.h"
#include "io/fault.h"
#include "io/one_part_source.h"
#include "io/text_scan.h"
#include "io/triangulate.h"

#include <limits>
#include <optional>

namespace abut {

namespace {

constexpr std::uint64_t kLargestMesh = std::numeric_limits<std::uint32_t>::max() - 1;

struct FloatPosition {
    float x = 0, y = 0, z = 0;
};

/// The corners of a face as indices of `v` lines from 0.
///
/// In          vertices: how many `v` lines have come before.
void read_corners(std::string_view rest, std::uint64_t vertices,
                  std::vector<std::uint64_t>& corners) {
    corners.clear();
    for (std::string_view word = take_word(rest); !word.empty(); word = take_word(rest)) {
        const auto number = to_number<std::int64_t>(word.substr(0, word.find('/')));
        // A face before its vertices is left to the isolated reader, as is one that is wrong.
        const std::uint64_t index = !number       ? kLargestMesh
                                    : *number < 0 ? vertices + static_cast<std::uint64_t>(*number)
                                                  : static_cast<std::uint64_t>(*number) - 1;
        if (index >= vertices)
            throw NotStreamable();
        corners.push_back(index);
    }
    if (corners.size() < 3)
        throw NotStreamable();
}

FloatPosition read_position(std::string_view rest) {
    const auto x = number_as_assimp(take_word(rest));
    const auto y = number_as_assimp(take_word(rest));
    const auto z = number_as_assimp(take_word(rest));
    // A fourth number would divide; three more are a colour, which is nothing here.
    if (!x || !y || !z || !take_word(rest).empty())
        throw NotStreamable();
    return {*x, *y, *z};
}

/// Every corner of a face is a vertex of its own, in the order of the file: as Assimp has it, and
/// then vertices that no face uses are not there.
class ObjSource : public OnePartSource {
public:
    ObjSource(const std::string& path, const SourceOptions& options)
        : OnePartSource(path, options), memory_(options.memory) {
        scan();
    }

    void read(std::uint32_t, MeshSink& sink) const override {
        PagedArray<FloatPosition> positions(folder(), vertices_, memory_ / 2);
        std::vector<Vec3> piece;
        for_each_face(positions, [&](std::span<const Vec3> polygon) {
            piece.insert(piece.end(), polygon.begin(), polygon.end());
            if (piece.size() > kPiece) {
                sink.vertices(piece);
                piece.clear();
            }
        });
        sink.vertices(piece);
        if (only_triangles_) {
            send_separate_triangles(size(0).triangles, sink);
            return;
        }
        std::vector<std::array<std::uint32_t, 3>> triangles;
        std::vector<std::uint32_t> corners;
        std::uint32_t first = 0;
        for_each_face(positions, [&](std::span<const Vec3> polygon) {
            corners.clear();
            for (std::uint32_t i = 0; i < polygon.size(); ++i)
                corners.push_back(i);
            const std::size_t before = triangles.size();
            triangulate(std::span<const std::uint32_t>(corners), polygon.data(), triangles);
            for (std::size_t i = before; i < triangles.size(); ++i)
                for (std::uint32_t& corner : triangles[i])
                    corner += first;
            first += static_cast<std::uint32_t>(polygon.size());
            if (triangles.size() > kPiece) {
                sink.triangles(triangles);
                triangles.clear();
            }
        });
        sink.triangles(triangles);
    }

private:
    static constexpr std::size_t kPiece = 8192;

    /// Looks whether the file is one mesh of plain statements, and how large it is.
    void scan() {
        ByteStream content = ByteStream::open(path_);
        LineScan lines(content);
        std::string_view line;
        std::vector<std::uint64_t> corners;
        std::string name;
        Size size;
        bool has_name = false, has_material = false;
        while (lines.next(line)) {
            std::string_view rest = line;
            const std::string_view word = take_word(rest);
            if (!line.empty() && line.back() == '\\')
                throw NotStreamable();
            if (word == "v") {
                (void)read_position(rest);
                ++vertices_;
            } else if (word == "f") {
                read_corners(rest, vertices_, corners);
                size.vertices += corners.size();
                size.triangles += corners.size() - 2;
                only_triangles_ = only_triangles_ && corners.size() == 3;
            } else if (word == "o" || word == "g") {
                name = take_word(rest);
                // A second one would begin another part.
                if (has_name || size.triangles > 0 || name.empty() || !is_plain_name(name) ||
                    !take_word(rest).empty())
                    throw NotStreamable();
                has_name = true;
            } else if (word == "usemtl") {
                if (has_material || size.triangles > 0)
                    throw NotStreamable();
                has_material = true;
            } else if (!word.empty() && word[0] != '#' && word != "vn" && word != "vt" &&
                       word != "s" && word != "mtllib") {
                throw NotStreamable();
            }
        }
        if (size.triangles == 0 ||
            std::max({size.vertices, size.triangles, vertices_}) > kLargestMesh)
            throw NotStreamable();
        set_part(has_name ? name : "defaultobject", size);
    }

    /// Calls take(corners' positions) for each face.
    template <typename Take>
    void for_each_face(PagedArray<FloatPosition>& positions, const Take& take) const {
        ByteStream content = ByteStream::open(path_);
        LineScan lines(content);
        std::string_view line;
        std::vector<std::uint64_t> corners;
        std::vector<Vec3> polygon;
        std::uint64_t vertices = 0;
        while (lines.next(line)) {
            std::string_view rest = line;
            const std::string_view word = take_word(rest);
            if (word == "v") {
                if (vertices >= positions.size())
                    throw Fault(ErrorCode::unreadable, "has changed while it was read");
                positions.set(vertices++, read_position(rest));
            } else if (word == "f") {
                read_corners(rest, vertices, corners);
                polygon.clear();
                for (const std::uint64_t corner : corners) {
                    const FloatPosition p = positions.get(corner);
                    polygon.push_back({p.x, p.y, p.z});
                }
                take(std::span<const Vec3>(polygon));
            }
        }
    }

    std::uint64_t memory_;
    std::uint64_t vertices_ = 0; ///< `v` lines
    bool only_triangles_ = true;
};

} // namespace

std::unique_ptr<SceneSource> open_obj_source(const std::string& path,
                                             const SourceOptions& options) {
    try {
        return std::make_unique<ObjSource>(path, options);
    } catch (const NotStreamable&) {
        return nullptr;
    }
}

} // namespace abut
