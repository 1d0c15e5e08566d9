#include "io/fault.h"
#include "io/glb_document.h"
#include "io/scene_source.h"
#include "io/unique_ids.h"
#include "math/transform.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <optional>

namespace abut {

namespace {

constexpr std::uint64_t kLargestMesh = std::numeric_limits<std::uint32_t>::max() - 1;
constexpr std::size_t kVertexBytes = 3 * sizeof(float);
constexpr std::size_t kPieceBytes = std::size_t{1} << 18;

std::uint64_t component_bytes(std::uint16_t component) {
    switch (component) {
    case 5121:
        return 1;
    case 5123:
        return 2;
    case 5125:
        return 4;
    default:
        throw NotStreamable();
    }
}

/// Where the elements of an accessor lie in the file.
struct Elements {
    std::uint64_t at = 0, count = 0, stride = 0, bytes = 0;
};

/// Nodes with geometry, in the order of the tree; called with each node's number and its transform.
template <typename Take>
void walk(const GlbDocument& document, const Take& take) {
    struct Visit {
        std::uint32_t node = 0;
        Transform world_from_parent;
    };
    const std::uint64_t nodes = document.nodes.size();
    PartSpool::Cursor cursor(document.nodes);
    std::vector<bool> has_parent(nodes);
    std::vector<Visit> open;
    const auto push = [&](std::uint32_t node, const Transform& world) {
        // A node with two parents, or one that is its own ancestor, would be read forever.
        if (node >= nodes || has_parent[node])
            throw NotStreamable();
        has_parent[node] = true;
        open.push_back({node, world});
    };
    // One root after the other: a plant may have a million.
    for (const std::uint32_t root : document.roots) {
        push(root, {});
        while (!open.empty()) {
            const Visit visit = open.back();
            open.pop_back();
            const Part node = cursor.part(visit.node);
            Transform world = compose(visit.world_from_parent, node.world_from_mesh);
            // As the isolated reader composes, whose sums turn -0 into 0.
            for (std::size_t i = 0; i < 9; ++i)
                world.m[i] += 0.0;
            for (std::uint64_t i = document.first_child[visit.node + 1];
                 i-- > document.first_child[visit.node];)
                push(document.children[i], world);
            if (node.mesh != GlbDocument::kNone)
                take(visit.node, node, world);
        }
    }
}

class GlbSource : public SceneSource {
public:
    GlbSource(const std::string& path, const SourceOptions& options)
        : SceneSource(options.folder), file_(path), document_(options.folder) {
        read_glb_document(file_, document_);
        std::vector<std::uint32_t> number_of(document_.meshes(), GlbDocument::kNone);
        UniqueIds ids;
        const auto id_of = [](std::uint32_t node, const Part& part) {
            return part.id.empty() ? "node " + std::to_string(node) : part.id;
        };
        walk(document_, [&](std::uint32_t node, const Part& part, const Transform&) {
            ids.announce(id_of(node, part));
        });
        ids.finish();
        walk(document_, [&](std::uint32_t node, const Part& found, const Transform& world) {
            Part part = found;
            part.id = ids.unique(id_of(node, found));
            if (part.name.empty())
                part.name = part.id;
            part.world_from_mesh = world;
            if (options.unit != 0 && options.unit != 1)
                for (double& value : part.world_from_mesh.m)
                    value *= options.unit;
            if (found.mesh >= number_of.size())
                throw NotStreamable();
            std::uint32_t& number = number_of[found.mesh];
            if (number == GlbDocument::kNone)
                number = take_mesh(found.mesh);
            part.mesh = number;
            parts_.append(part);
        });
        if (parts_.size() == 0)
            throw NotStreamable();
        parts_.finish();
    }

    [[nodiscard]] std::uint32_t meshes() const override {
        return static_cast<std::uint32_t>(sizes_.size());
    }
    [[nodiscard]] Size size(std::uint32_t mesh) const override { return sizes_[mesh]; }

    void read(std::uint32_t mesh, MeshSink& sink) const override {
        for_each_primitive(meshes_[mesh], [&](const GlbDocument::Primitive& primitive) {
            read_positions(positions(primitive), sink);
        });
        std::uint32_t first = 0;
        for_each_primitive(meshes_[mesh], [&](const GlbDocument::Primitive& primitive) {
            const auto vertices = static_cast<std::uint32_t>(positions(primitive).count);
            if (const auto elements = indices(primitive))
                read_triangles(*elements, first, vertices, sink);
            else
                make_triangles(first, vertices, sink);
            first += vertices;
        });
    }

private:
    template <typename Take>
    void for_each_primitive(std::uint32_t gltf_mesh, const Take& take) const {
        for (std::uint64_t i = document_.first_primitive[gltf_mesh];
             i < document_.first_primitive[gltf_mesh + 1]; ++i)
            take(document_.primitives[i]);
    }

    std::uint32_t take_mesh(std::uint32_t gltf_mesh) {
        Size size;
        for_each_primitive(gltf_mesh, [&](const GlbDocument::Primitive& primitive) {
            const std::uint64_t vertices = positions(primitive).count;
            const auto corners = indices(primitive);
            const std::uint64_t count = corners ? corners->count : vertices;
            // Without elements Assimp may leave the primitive out; what is no multiple of three is
            // refused.
            if (vertices == 0 || count == 0 || count % 3 != 0)
                throw NotStreamable();
            size.vertices += vertices;
            size.triangles += count / 3;
        });
        if (size.triangles == 0 || std::max(size.vertices, size.triangles) > kLargestMesh)
            throw NotStreamable();
        meshes_.push_back(gltf_mesh);
        sizes_.push_back(size);
        return static_cast<std::uint32_t>(sizes_.size() - 1);
    }

    [[nodiscard]] Elements elements(std::uint32_t accessor_index, std::uint64_t size) const {
        if (accessor_index >= document_.accessors.size())
            throw NotStreamable();
        const GlbDocument::Accessor& accessor = document_.accessors[accessor_index];
        if (accessor.view >= document_.views.size())
            throw NotStreamable();
        const GlbDocument::View& view = document_.views[accessor.view];
        const std::uint64_t stride = view.stride == 0 ? size : view.stride;
        constexpr std::uint64_t kLargest = std::uint64_t{1} << 40;
        if (!view.is_plain || stride < size ||
            std::max({accessor.count, accessor.offset, view.offset, view.bytes}) > kLargest)
            throw NotStreamable();
        const bool fits = accessor.count == 0 ||
                          (accessor.offset + stride * (accessor.count - 1) + size <= view.bytes &&
                           view.offset + view.bytes <= document_.binary_bytes);
        if (!fits)
            throw NotStreamable();
        return {document_.binary_at + view.offset + accessor.offset, accessor.count, stride, size};
    }

    [[nodiscard]] Elements positions(const GlbDocument::Primitive& primitive) const {
        const Elements result = elements(primitive.position, kVertexBytes);
        const GlbDocument::Accessor& accessor = document_.accessors[primitive.position];
        constexpr std::uint16_t kFloat = 5126;
        if (!accessor.is_vector || accessor.component != kFloat)
            throw NotStreamable();
        return result;
    }

    [[nodiscard]] std::optional<Elements> indices(const GlbDocument::Primitive& primitive) const {
        if (primitive.indices == GlbDocument::kNone)
            return std::nullopt;
        if (primitive.indices >= document_.accessors.size())
            throw NotStreamable();
        const GlbDocument::Accessor& accessor = document_.accessors[primitive.indices];
        const Elements result = elements(primitive.indices, component_bytes(accessor.component));
        if (!accessor.is_scalar || result.stride != result.bytes)
            throw NotStreamable();
        return result;
    }

    void read_positions(const Elements& elements, MeshSink& sink) const {
        const std::uint64_t most = std::max<std::uint64_t>(kPieceBytes / elements.stride, 1);
        std::vector<std::byte> bytes;
        std::vector<Vec3> piece;
        for (std::uint64_t i = 0; i < elements.count; i += most) {
            const std::uint64_t count = std::min(most, elements.count - i);
            bytes.resize(elements.stride * (count - 1) + kVertexBytes);
            file_.read(elements.at + i * elements.stride, bytes);
            piece.resize(count);
            for (std::uint64_t k = 0; k < count; ++k) {
                float xyz[3];
                std::memcpy(xyz, bytes.data() + k * elements.stride, sizeof xyz);
                piece[k] = {xyz[0], xyz[1], xyz[2]};
            }
            sink.vertices(piece);
        }
    }

    void read_triangles(const Elements& elements, std::uint32_t first, std::uint32_t vertices,
                        MeshSink& sink) const {
        const std::uint64_t most = kPieceBytes / 12;
        std::vector<std::byte> bytes;
        std::vector<std::array<std::uint32_t, 3>> piece;
        for (std::uint64_t i = 0; i < elements.count / 3; i += most) {
            const std::uint64_t count = std::min(most, elements.count / 3 - i);
            bytes.resize(count * 3 * elements.bytes);
            file_.read(elements.at + i * 3 * elements.bytes, bytes);
            piece.resize(count);
            for (std::uint64_t k = 0; k < 3 * count; ++k) {
                std::uint32_t index = 0;
                std::memcpy(&index, bytes.data() + k * elements.bytes, elements.bytes);
                if (index >= vertices)
                    throw Fault(ErrorCode::bad_mesh, "triangle " + std::to_string(i + k / 3) +
                                                         " of a primitive" +
                                                         " refers to a vertex that does not exist");
                piece[k / 3].at(k % 3) = first + index;
            }
            sink.triangles(piece);
        }
    }

    static void make_triangles(std::uint32_t first, std::uint32_t vertices, MeshSink& sink) {
        for (std::uint32_t i = 0; i < vertices; i += 3) {
            const std::array<std::uint32_t, 3> triangle{first + i, first + i + 1, first + i + 2};
            sink.triangles({&triangle, 1});
        }
    }

    RandomAccessFile file_;
    GlbDocument document_;
    std::vector<std::uint32_t> meshes_; ///< of glTF, by their number here
    std::vector<Size> sizes_;
};

} // namespace

std::unique_ptr<SceneSource> open_glb_source(const std::string& path,
                                             const SourceOptions& options) {
    try {
        return std::make_unique<GlbSource>(path, options);
    } catch (const NotStreamable&) {
        return nullptr;
    }
}

} // namespace abut
