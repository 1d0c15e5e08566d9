#include "core/paged_array.h"
#include "io/file/fault.h"
#include "io/polygon/one_part_source.h"
#include "io/polygon/ply_body.h"
#include "io/polygon/triangulate.h"
#include "math/rounding.h"

#include <algorithm>
#include <limits>
#include <optional>

namespace abut {

namespace {

/// Accepts vertices with real numbers x, y, z, followed by faces with one list, as scanners and
/// simulations write them. A file in text is read whole.
void check_header(const PlyHeader& header) {
    const auto& elements = header.elements;
    if (header.encoding == PlyEncoding::text || elements.size() != 2 ||
        elements[0].name != "vertex" || elements[1].name != "face" || elements[0].count == 0)
        throw NotStreamable();
    for (const char* axis : {"x", "y", "z"})
        if (std::count_if(elements[0].properties.begin(), elements[0].properties.end(),
                          [&](const PlyProperty& property) {
                              return property.name == axis && !property.is_list &&
                                     property.value.is_real;
                          }) != 1)
            throw NotStreamable();
    const auto& face = elements[1].properties;
    if (face.size() != 1 || !face[0].is_list || face[0].value.is_real || face[0].length.is_real ||
        (face[0].name != "vertex_indices" && face[0].name != "vertex_index"))
        throw NotStreamable();
}

/// All vertices as in the file, used or not.
class PlySource : public OnePartSource {
public:
    PlySource(const ModelPath& path, const SourceOptions& options)
        : OnePartSource(path, options), memory_(options.memory) {
        ByteStream content = ByteStream::open(path_, watch_);
        const PlyHeader header = read_ply_header(content);
        check_header(header);
        Size size{header.vertices(), 0};
        PlyBody body(header, content);
        skip_ply_elements(body, header.elements[0]);
        take_ply_faces(body, header.elements[1], header.vertices(), [&](auto corners) {
            size.triangles += corners.size() < 3 ? 0 : corners.size() - 2;
            only_triangles_ = only_triangles_ && corners.size() <= 3;
        });
        if (size.triangles == 0 || std::max(size.vertices, size.triangles) > kLargestMesh)
            throw NotStreamable();
        set_part("node 0", size);
    }

    void read(std::uint32_t, MeshSink& sink) const override {
        ByteStream content = ByteStream::open(path_, watch_);
        const PlyHeader header = read_ply_header(content);
        check_header(header);
        PlyBody body(header, content);
        std::optional<PagedArray<FloatPosition>> positions;
        if (!only_triangles_)
            positions.emplace(folder(), header.vertices(), memory_ / 2);
        read_vertices(header.elements[0], body, positions, sink);
        read_faces(header, body, positions, sink);
    }

private:
    static constexpr std::size_t kPiece = 8192;

    static void read_vertices(const PlyElement& element, PlyBody& body,
                              std::optional<PagedArray<FloatPosition>>& positions, MeshSink& sink) {
        std::vector<Vec3> piece;
        std::uint64_t number = 0;
        take_ply_elements(element, [&] {
            Vec3 p;
            for (const PlyProperty& property : element.properties) {
                double* const to = property.name == "x"   ? &p.x
                                   : property.name == "y" ? &p.y
                                   : property.name == "z" ? &p.z
                                                          : nullptr;
                if (!(to != nullptr ? body.take(property.value, *to) : body.skip(property)))
                    return false;
            }
            // Narrowed to float, as read_scene does.
            const Vec3 narrow{to_float(p.x), to_float(p.y), to_float(p.z)};
            if (positions)
                positions->set(number++,
                               {to_float(narrow.x), to_float(narrow.y), to_float(narrow.z)});
            piece.push_back(narrow);
            if (piece.size() == kPiece) {
                sink.vertices(piece);
                piece.clear();
            }
            return true;
        });
        sink.vertices(piece);
    }

    static void read_faces(const PlyHeader& header, PlyBody& body,
                           std::optional<PagedArray<FloatPosition>>& positions, MeshSink& sink) {
        std::vector<std::array<std::uint32_t, 3>> piece, cut;
        std::vector<Vec3> polygon;
        std::vector<std::uint32_t> local;
        take_ply_faces(body, header.elements[1], header.vertices(), [&](auto corners) {
            const auto vertex = [&](std::size_t i) {
                return static_cast<std::uint32_t>(corners[i]);
            };
            if (corners.size() == 3) {
                piece.push_back({vertex(0), vertex(1), vertex(2)});
            } else if (corners.size() > 3 && positions) {
                polygon.clear();
                local.clear();
                cut.clear();
                for (std::uint32_t i = 0; i < corners.size(); ++i) {
                    const FloatPosition p = positions->get(vertex(i));
                    polygon.push_back({p.x, p.y, p.z});
                    local.push_back(i);
                }
                triangulate(std::span<const std::uint32_t>(local), polygon.data(), cut);
                for (const auto& [a, b, c] : cut)
                    piece.push_back({vertex(a), vertex(b), vertex(c)});
            }
            if (piece.size() >= kPiece) {
                sink.triangles(piece);
                piece.clear();
            }
        });
        sink.triangles(piece);
    }

    std::uint64_t memory_;
    bool only_triangles_ = true;
};

} // namespace

std::unique_ptr<SceneSource> open_ply_source(const ModelPath& path, const SourceOptions& options) {
    try {
        return std::make_unique<PlySource>(path, options);
    } catch (const NotStreamable&) {
        return nullptr;
    }
}

} // namespace abut
