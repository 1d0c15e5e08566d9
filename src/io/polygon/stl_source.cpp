#include "io/file/fault.h"
#include "io/file/random_access_file.h"
#include "io/file/text_scan.h"
#include "io/polygon/one_part_source.h"
#include "io/polygon/stl_scan.h"
#include "math/rounding.h"

#include <cstring>
#include <limits>

namespace abut {

namespace {

constexpr std::uint64_t kMostTriangles = (std::numeric_limits<std::uint32_t>::max() - 1) / 3;
constexpr std::size_t kBlockTriangles = 4096;

/// Every triangle has three separate vertices, in the order of the file.
class StlSource : public OnePartSource {
public:
    StlSource(const ModelPath& path, const SourceOptions& options)
        : OnePartSource(path, options), file_(path.path, options.watch) {
        is_text_ = is_text_stl(path.path);
        std::string name;
        const std::uint64_t triangles = is_text_
                                            ? scan_text(name, nullptr)
                                            : (file_.size() - kStlHeaderBytes) / kStlTriangleBytes;
        if (triangles == 0)
            throw Fault(ErrorCode::bad_mesh, "holds no triangles");
        if (triangles > kMostTriangles)
            throw Fault(ErrorCode::unsupported, "has a part with more than 4 billion vertices");
        set_part(name.empty() ? "node 1" : name, {3 * triangles, triangles});
    }

    void read(std::uint32_t, MeshSink& sink) const override {
        if (is_text_) {
            std::string name;
            (void)scan_text(name, &sink);
        } else {
            read_binary(sink);
        }
        send_separate_triangles(size(0).triangles, sink);
    }

private:
    void read_binary(MeshSink& sink) const {
        const std::uint64_t triangles = size(0).triangles;
        std::vector<std::byte> bytes;
        std::vector<Vec3> piece;
        for (std::uint64_t i = 0; i < triangles; i += kBlockTriangles) {
            const std::uint64_t count = std::min<std::uint64_t>(kBlockTriangles, triangles - i);
            bytes.resize(count * kStlTriangleBytes);
            file_.read(kStlHeaderBytes + i * kStlTriangleBytes, bytes);
            piece.clear();
            for (std::uint64_t k = 0; k < count; ++k) {
                float values[12]; // a normal and three vertices
                std::memcpy(values, bytes.data() + k * kStlTriangleBytes, sizeof values);
                for (std::size_t v = 3; v < 12; v += 3)
                    piece.push_back({values[v], values[v + 1], values[v + 2]});
            }
            sink.vertices(piece);
        }
    }

    /// Returns the number of triangles.
    ///
    /// Out         name: of the solid; sink: receives the vertices unless it is null.
    /// Errors      NotStreamable for a second solid, because it is a second part.
    std::uint64_t scan_text(std::string& name, MeshSink* sink) const {
        ByteStream content = ByteStream::open(path_, watch_);
        std::uint64_t vertices = 0;
        bool has_solid = false;
        std::vector<Vec3> piece;
        scan_text_stl(
            content,
            [&](std::string_view own_name) {
                if (has_solid)
                    throw NotStreamable();
                has_solid = true;
                name = own_name;
            },
            [&](const Vec3& p) {
                ++vertices;
                if (sink == nullptr)
                    return;
                piece.push_back({to_float(p.x), to_float(p.y), to_float(p.z)});
                if (piece.size() >= 3 * kBlockTriangles) {
                    sink->vertices(piece);
                    piece.clear();
                }
            });
        if (sink != nullptr)
            sink->vertices(piece);
        return vertices / 3;
    }

    RandomAccessFile file_;
    bool is_text_ = false;
};

} // namespace

std::unique_ptr<SceneSource> open_stl_source(const ModelPath& path, const SourceOptions& options) {
    try {
        return std::make_unique<StlSource>(path, options);
    } catch (const NotStreamable&) {
        return nullptr;
    }
}

} // namespace abut
