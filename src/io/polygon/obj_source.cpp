#include "core/paged_array.h"
#include "io/file/fault.h"
#include "io/polygon/obj_colours.h"
#include "io/polygon/obj_scan.h"
#include "io/polygon/one_part_source.h"
#include "io/polygon/triangulate.h"
#include "math/rounding.h"

#include <algorithm>
#include <limits>
#include <span>
#include <vector>

namespace abut {

namespace {

/// Every corner of a face is a separate vertex, in the order of the file, as with Assimp. Vertices
/// that no face uses are left out.
class ObjSource : public OnePartSource {
public:
    ObjSource(const ModelPath& path, const SourceOptions& options)
        : OnePartSource(path, options), memory_(options.memory) {
        scan(options.read.allow_outside_files);
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

    /// Checks that the file is one part whose faces come after their vertices, and finds its size.
    void scan(bool allow_outside) {
        ByteStream content = ByteStream::open(path_, watch_);
        ObjParts parts;
        ObjColours colours(path_, allow_outside, watch_);
        Size size;
        scan_obj(
            content, [&](const Vec3&) { ++vertices_; },
            [&](auto corners) {
                if (parts.of_face() > 0 || std::any_of(corners.begin(), corners.end(),
                                                       [&](auto i) { return i >= vertices_; }))
                    throw NotStreamable();
                size.vertices += corners.size();
                size.triangles += corners.size() - 2;
                colours.add(0, corners.size() - 2);
                only_triangles_ = only_triangles_ && corners.size() == 3;
            },
            [&](std::string_view statement, std::string_view name) {
                colours.statement(statement, name);
                parts.name(statement, name);
            });
        if (size.triangles == 0)
            throw Fault(ErrorCode::bad_mesh, "holds no triangles");
        if (std::max({size.vertices, size.triangles, vertices_}) > kLargestMesh)
            throw NotStreamable();
        set_part(parts.ids().front(), size, colours.of_part(0));
    }

    /// Calls take(positions of the corners) for each face.
    template <typename Take>
    void for_each_face(PagedArray<FloatPosition>& positions, const Take& take) const {
        ByteStream content = ByteStream::open(path_, watch_);
        std::vector<Vec3> polygon;
        std::uint64_t vertices = 0;
        scan_obj(
            content,
            [&](const Vec3& p) {
                if (vertices >= positions.size())
                    throw Fault(ErrorCode::unreadable, "changed while it was read");
                positions.set(vertices++, {to_float(p.x), to_float(p.y), to_float(p.z)});
            },
            [&](auto corners) {
                polygon.clear();
                for (const std::uint64_t corner : corners) {
                    if (corner >= vertices)
                        throw Fault(ErrorCode::unreadable, "changed while it was read");
                    const FloatPosition p = positions.get(corner);
                    polygon.push_back({p.x, p.y, p.z});
                }
                take(std::span<const Vec3>(polygon));
            });
    }

    std::uint64_t memory_;
    std::uint64_t vertices_ = 0; ///< number of `v` lines
    bool only_triangles_ = true;
};

} // namespace

std::unique_ptr<SceneSource> open_obj_source(const ModelPath& path, const SourceOptions& options) {
    try {
        return std::make_unique<ObjSource>(path, options);
    } catch (const NotStreamable&) {
        return nullptr;
    }
}

} // namespace abut
