#include "io/assimp_number.h"
#include "io/fault.h"
#include "io/one_part_source.h"
#include "io/random_access_file.h"
#include "io/text_scan.h"

#include <cstring>
#include <limits>

namespace abut {

namespace {

constexpr std::uint64_t kHeaderBytes = 84;
constexpr std::uint64_t kTriangleBytes = 50;
constexpr std::uint64_t kMostTriangles = (std::numeric_limits<std::uint32_t>::max() - 1) / 3;
constexpr std::size_t kPieceTriangles = 4096;

/// Every triangle has three vertices of its own, in the order of the file.
class StlSource : public OnePartSource {
public:
    StlSource(const std::string& path, const SourceOptions& options)
        : OnePartSource(path, options), file_(path) {
        std::uint32_t count = 0;
        if (file_.size() >= kHeaderBytes)
            count = file_.value<std::uint32_t>(kHeaderBytes - sizeof count);
        is_text_ = file_.size() != kHeaderBytes + count * kTriangleBytes;
        std::string name;
        std::uint64_t triangles = count;
        if (is_text_)
            triangles = scan_text(name, nullptr);
        if (triangles == 0 || triangles > kMostTriangles)
            throw NotStreamable();
        // As Assimp's tree has it: the root is node 0.
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
        for (std::uint64_t i = 0; i < triangles; i += kPieceTriangles) {
            const std::uint64_t count = std::min<std::uint64_t>(kPieceTriangles, triangles - i);
            bytes.resize(count * kTriangleBytes);
            file_.read(kHeaderBytes + i * kTriangleBytes, bytes);
            piece.clear();
            for (std::uint64_t k = 0; k < count; ++k) {
                float values[12]; // a normal and three vertices
                std::memcpy(values, bytes.data() + k * kTriangleBytes, sizeof values);
                for (std::size_t v = 3; v < 12; v += 3)
                    piece.push_back({values[v], values[v + 1], values[v + 2]});
            }
            sink.vertices(piece);
        }
    }

    /// One solid, each statement on a line of its own; the rest is left to the isolated reader.
    ///
    /// In/out      name: of the solid; sink: takes the vertices, if there is one. The number of
    ///             triangles.
    std::uint64_t scan_text(std::string& name, MeshSink* sink) const {
        ByteStream content = ByteStream::open(path_);
        LineScan lines(content);
        std::string_view line;
        std::uint64_t facets = 0, vertices = 0;
        int solids = 0, ends = 0;
        std::vector<Vec3> piece;
        while (lines.next(line)) {
            std::string_view rest = line;
            const std::string_view word = take_word(rest);
            if (word == "vertex") {
                const auto x = number_as_assimp(take_word(rest));
                const auto y = number_as_assimp(take_word(rest));
                const auto z = number_as_assimp(take_word(rest));
                if (!x || !y || !z || !take_word(rest).empty() || ends > 0)
                    throw NotStreamable();
                ++vertices;
                piece.push_back({*x, *y, *z});
                if (sink != nullptr && piece.size() >= 3 * kPieceTriangles)
                    sink->vertices(piece);
                if (sink == nullptr || piece.size() >= 3 * kPieceTriangles)
                    piece.clear();
            } else if (word == "facet") {
                if (++facets != vertices / 3 + 1 || vertices % 3 != 0)
                    throw NotStreamable();
            } else if (word == "solid") {
                ++solids;
                name = take_word(rest);
            } else if (word == "endsolid") {
                ++ends;
            } else if (word != "outer" && word != "endloop" && word != "endfacet" &&
                       !word.empty()) {
                throw NotStreamable();
            }
        }
        if (solids != 1 || ends != 1 || vertices != 3 * facets || !is_plain_name(name))
            throw NotStreamable();
        if (sink != nullptr && !piece.empty())
            sink->vertices(piece);
        return facets;
    }

    RandomAccessFile file_;
    bool is_text_ = false;
};

} // namespace

std::unique_ptr<SceneSource> open_stl_source(const std::string& path,
                                             const SourceOptions& options) {
    try {
        return std::make_unique<StlSource>(path, options);
    } catch (const NotStreamable&) {
        return nullptr;
    }
}

} // namespace abut
