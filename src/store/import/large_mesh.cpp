#include "store/import/large_mesh.h"

#include "core/external_sort.h"
#include "core/paged_array.h"
#include "core/parallel.h"
#include "core/progress.h"
#include "io/file/fault.h"
#include "math/predicates.h"
#include "math/rounding.h"
#include "math/transform.h"
#include "mesh/equal_positions.h"
#include "store/import/cut_mesh.h"
#include "store/import/mesh_draft.h"

#include <optional>

namespace abut {

namespace {

struct FloatPosition {
    float x = 0, y = 0, z = 0;
    [[nodiscard]] Vec3 exact() const { return {x, y, z}; }
};

/// Sorts vertices by position, and those at equal positions by number.
struct VertexByPosition {
    std::array<std::uint32_t, 3> bits{};
    std::uint32_t number = 0;
    friend bool operator<(const VertexByPosition& a, const VertexByPosition& b) {
        return a.bits != b.bits ? a.bits < b.bits : a.number < b.number;
    }
};

/// A vertex, and the first vertex at the same position.
struct VertexAndFirst {
    std::uint32_t number = 0, first = 0;
    friend bool operator<(const VertexAndFirst& a, const VertexAndFirst& b) {
        return a.number < b.number;
    }
};

class LargeMeshImport : public MeshSink {
public:
    LargeMeshImport(const SceneSource::Size& size, std::span<const Transform> placements,
                    const std::string& folder, std::uint64_t memory, const Progress& progress,
                    StoreWriter& writer)
        : size_(size), placements_(placements), folder_(folder), memory_(memory),
          progress_(progress), writer_(writer), by_position_(folder, memory / 3),
          by_key_(folder, memory / 3) {
        raw_.emplace(folder);
        raw_writer_.emplace(*raw_);
        result_.boxes.resize(placements.size());
    }

    void vertices(std::span<const Vec3> positions) override {
        check_stop(progress_);
        for (const Vec3& p : positions) {
            const FloatPosition narrow{to_float(p.x), to_float(p.y), to_float(p.z)};
            by_position_.push(
                {{detail::coordinate_bits(narrow.x), detail::coordinate_bits(narrow.y),
                  detail::coordinate_bits(narrow.z)},
                 static_cast<std::uint32_t>(vertices_++)});
            raw_writer_->append(&narrow, sizeof narrow);
        }
    }

    void triangles(std::span<const std::array<std::uint32_t, 3>> indices) override {
        check_stop(progress_);
        if (!number_)
            join();
        std::vector<std::array<std::uint32_t, 3>> joined;
        joined.reserve(indices.size());
        for (const auto& corners : indices)
            joined.push_back(take(corners));
        corners_hash_.add(std::as_bytes(std::span<const std::array<std::uint32_t, 3>>(joined)));
    }

    LargeMesh finish() {
        if (!number_)
            join();
        if (vertices_ != size_.vertices || triangles_ != size_.triangles)
            malformed("its numbers of vertices and triangles differ from those that it states");
        MeshRow row;
        const Hash128 hash =
            mesh_hash(joined_, positions_hash_.value(), triangles_, corners_hash_.value());
        row.hash_low = hash.low;
        row.hash_high = hash.high;
        row.vertices = joined_;
        row.triangles = triangles_;
        number_.reset();
        const auto known = writer_.find_mesh(hash);
        is_known_ = known.has_value();
        cut();
        row.box = box_;
        result_.mesh = known ? *known : writer_.end_mesh(row);
        return std::move(result_);
    }

private:
    /// Joins vertices at equal positions and gives the joined vertices their numbers.
    void join() {
        raw_writer_->flush();
        ExternalSort<VertexAndFirst> by_number(folder_, memory_ / 3);
        std::optional<VertexByPosition> first;
        by_position_.drain([&](const VertexByPosition& vertex) {
            if (!first || first->bits != vertex.bits)
                first = vertex;
            by_number.push({vertex.number, first->number});
        });
        number_.emplace(folder_, vertices_, memory_ / 6);
        positions_.emplace(folder_, vertices_, memory_ / 6);
        std::vector<FloatPosition> buffer;
        std::size_t at = 0;
        std::uint64_t next = 0;
        by_number.drain([&](const VertexAndFirst& vertex) {
            if (at == buffer.size()) {
                buffer.resize(std::min<std::uint64_t>(16384, vertices_ - next));
                raw_->read(next * sizeof(FloatPosition), std::as_writable_bytes(std::span(buffer)));
                next += buffer.size();
                at = 0;
                check_stop(progress_);
            }
            const FloatPosition position = buffer[at++];
            if (vertex.first < vertex.number) {
                number_->set(vertex.number, number_->get(vertex.first));
                return;
            }
            const Vec3 exact = position.exact();
            check_coordinate(exact, joined_);
            extend(all_, exact);
            positions_hash_.add_value(exact);
            positions_->set(joined_, position);
            number_->set(vertex.number, static_cast<std::uint32_t>(joined_++));
        });
        raw_writer_.reset();
        raw_.reset();
        used_.resize(joined_);
    }

    std::array<std::uint32_t, 3> take(const std::array<std::uint32_t, 3>& corners) {
        std::array<std::uint32_t, 3> joined{};
        std::array<Vec3, 3> at;
        for (std::size_t k = 0; k < 3; ++k) {
            if (corners.at(k) >= vertices_)
                throw Fault(ErrorCode::bad_mesh, "triangle " + std::to_string(triangles_) +
                                                     " refers to a vertex that does not exist");
            joined.at(k) = number_->get(corners.at(k));
            used_[joined.at(k)] = true;
            at.at(k) = positions_->get(joined.at(k)).exact();
        }
        by_key_.push({spatial_key(all_, at[0], at[1], at[2]),
                      static_cast<std::uint32_t>(triangles_++), joined});
        if (!result_.has_area)
            look_for_area(at);
        return joined;
    }

    void look_for_area(const std::array<Vec3, 3>& at) {
        for (const Transform& world_from_mesh : placements_)
            result_.has_area = result_.has_area || !collinear(apply(world_from_mesh, at[0]),
                                                              apply(world_from_mesh, at[1]),
                                                              apply(world_from_mesh, at[2]));
    }

    void cut() {
        BlockCutter cutter([&](std::uint32_t v) { return positions_->get(v).exact(); },
                           [&](const MeshBlock& block) { emit(block); });
        if (is_whole(joined_, triangles_)) {
            emit_whole();
        } else {
            by_key_.drain([&](const BlockTriangle& triangle) { cutter.add(triangle); });
            for (std::uint32_t v = 0; v < joined_; ++v)
                if (!used_[v])
                    cutter.add_unused(v);
            cutter.finish();
        }
        flush();
    }

    /// Emits the mesh as one block, if few triangles and vertices are left after joining.
    void emit_whole() {
        MeshBlock block;
        block.mesh.triangles.resize(triangles_);
        by_key_.drain([&](const BlockTriangle& triangle) {
            block.mesh.triangles[triangle.id] = triangle.corners;
        });
        for (std::uint32_t v = 0; v < joined_; ++v)
            block.mesh.positions.push_back(positions_->get(v).exact());
        emit(block);
    }

    void emit(const MeshBlock& block) {
        pieces_.push_back(block);
        if (pieces_.size() == kPiecesAtOnce)
            flush();
    }

    /// Packs blocks in parallel and writes them in order.
    void flush() {
        check_stop(progress_);
        std::vector<BlockDraft> drafts(pieces_.size());
        if (!is_known_)
            parallel_for(pieces_.size(), 1,
                         [&](std::size_t i) { drafts[i] = encode_draft(pieces_[i]); });
        for (BlockDraft& draft : drafts)
            if (!is_known_)
                writer_.add_block(draft);
        parallel_for(placements_.size(), 1, [&](std::size_t part) {
            for (const MeshBlock& block : pieces_)
                for (const auto& triangle : block.mesh.triangles)
                    for (const std::uint32_t v : triangle)
                        extend(result_.boxes[part],
                               apply(placements_[part], block.mesh.positions[v]));
        });
        for (const BlockDraft& draft : drafts)
            if (!is_empty(draft.row.box)) {
                extend(box_, draft.row.box.lower);
                extend(box_, draft.row.box.upper);
            }
        pieces_.clear();
    }

    static constexpr std::size_t kPiecesAtOnce = 8;

    const SceneSource::Size& size_;
    std::span<const Transform> placements_;
    const std::string& folder_;
    std::uint64_t memory_;
    const Progress& progress_;
    StoreWriter& writer_;

    std::optional<TemporaryFile> raw_; ///< all vertices in the order of the file
    std::optional<TemporaryWriter> raw_writer_;
    ExternalSort<VertexByPosition> by_position_;
    std::optional<PagedArray<std::uint32_t>> number_; ///< of a vertex after joining
    std::optional<PagedArray<FloatPosition>> positions_;
    ExternalSort<BlockTriangle> by_key_;
    std::vector<bool> used_;
    std::uint64_t vertices_ = 0, joined_ = 0, triangles_ = 0;
    Box3 all_; ///< of all vertices
    Box3 box_; ///< of the vertices that triangles use
    Hasher positions_hash_, corners_hash_;
    bool is_known_ = false;
    std::vector<MeshBlock> pieces_;
    LargeMesh result_;
};

} // namespace

LargeMesh import_large_mesh(const SceneSource& source, std::uint32_t mesh,
                            std::span<const Transform> placements, std::uint64_t memory,
                            const Progress& progress, StoreWriter& writer) {
    const SceneSource::Size size = source.size(mesh);
    const std::string& folder = source.folder();
    LargeMeshImport import(size, placements, folder, memory, progress, writer);
    source.read(mesh, import);
    return import.finish();
}

} // namespace abut
