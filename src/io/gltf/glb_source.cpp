#include "io/file/fault.h"
#include "io/file/input_file.h"
#include "io/gltf/glb_document.h"
#include "io/gltf/gltf_geometry.h"
#include "io/gltf/gltf_json.h"
#include "io/scene/colour.h"
#include "io/scene/scene_source.h"
#include "io/scene/unique_ids.h"
#include "math/transform.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <tuple>

namespace abut {

namespace {

/// Calls `take` with the number and the transform of each node that has a mesh, in tree order.
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
        if (node >= nodes)
            malformed("its JSON refers to node " + std::to_string(node) + ", which does not exist");
        // A node with two parents, or one that is its own ancestor, would never end.
        if (has_parent[node])
            malformed("node " + std::to_string(node) + " has two parents");
        has_parent[node] = true;
        open.push_back({node, world});
    };
    // Roots are visited one after the other, because a plant may have a million of them.
    for (const std::uint32_t root : document.roots) {
        push(root, {});
        while (!open.empty()) {
            const Visit visit = open.back();
            open.pop_back();
            const Part node = cursor.part(visit.node);
            Transform world = compose(visit.world_from_parent, node.world_from_mesh);
            // Adding zero turns -0 into 0.
            for (std::size_t i = 0; i < 9; ++i)
                world.m[i] += 0.0;
            for (std::uint64_t i = document.first_child[visit.node + 1];
                 i-- > document.first_child[visit.node];)
                push(document.children[i], world);
            if (node.mesh == GlbDocument::kNone)
                continue;
            if (node.mesh >= document.meshes())
                malformed("its JSON refers to mesh " + std::to_string(node.mesh) +
                          ", which does not exist");
            take(visit.node, node, world);
        }
    }
}

/// Returns the step between neighbouring coordinates in the frame of a mesh; 0 for floats, whose
/// step depends on the coordinate.
double step_of(const GltfElements& positions) {
    constexpr std::uint16_t kFloat = 5126, kByte = 5120, kUnsignedByte = 5121, kShort = 5122;
    if (positions.component == kFloat)
        return 0;
    if (!positions.is_normalized)
        return 1;
    return 1 / (positions.component == kByte           ? 127.0
                : positions.component == kUnsignedByte ? 255.0
                : positions.component == kShort        ? 32767.0
                                                       : 65535.0);
}

/// Reads the transforms that place a node's mesh several times (EXT_mesh_gpu_instancing).
class InstanceReader {
public:
    InstanceReader(const GltfGeometry& geometry, const GlbDocument::Instances& instances) {
        for (const auto& [accessor, components, values] :
             {std::tuple{instances.translation, 3, &translation_},
              std::tuple{instances.rotation, 4, &rotation_},
              std::tuple{instances.scale, 3, &scale_}}) {
            if (accessor == GlbDocument::kNone)
                continue;
            *values = geometry.values(accessor, static_cast<std::uint8_t>(components));
            if (count_ && *count_ != (*values)->count)
                malformed("the attributes of a node's instances differ in their counts");
            count_ = (*values)->count;
        }
        if (!count_)
            malformed("a node has instances without attributes");
    }

    /// Calls `take` with each instance's node_from_instance.
    template <typename Take>
    void for_each(const Take& take) const {
        constexpr std::uint64_t kPiece = 4096;
        std::vector<double> translation, rotation, scale;
        for (std::uint64_t first = 0; first < *count_; first += kPiece) {
            const std::uint64_t count = std::min(kPiece, *count_ - first);
            read(translation_, first, count, translation);
            read(rotation_, first, count, rotation);
            read(scale_, first, count, scale);
            for (std::uint64_t i = 0; i < count; ++i)
                take(gltf_transform(
                    translation_ ? values_at<3>(translation, i) : std::array<double, 3>{0, 0, 0},
                    rotation_ ? values_at<4>(rotation, i) : std::array<double, 4>{0, 0, 0, 1},
                    scale_ ? values_at<3>(scale, i) : std::array<double, 3>{1, 1, 1}));
        }
    }

private:
    using Values = std::optional<GltfElements>;

    static void read(const Values& values, std::uint64_t first, std::uint64_t count,
                     std::vector<double>& to) {
        if (!values)
            return;
        to.resize(count * values->components);
        read_elements(*values, first, std::span(to));
    }
    template <std::size_t size>
    static std::array<double, size> values_at(const std::vector<double>& from, std::uint64_t i) {
        std::array<double, size> result{};
        std::copy_n(from.begin() + static_cast<std::ptrdiff_t>(i * size), size, result.begin());
        return result;
    }

    std::optional<std::uint64_t> count_;
    Values translation_, rotation_, scale_;
};

class GlbSource : public SceneSource {
public:
    GlbSource(const ModelPath& path, const SourceOptions& options)
        : SceneSource(kGltfFrame, path, options), file_(path.path, options.watch),
          document_(options.folder) {
        read_glb_document(file_, lower_extension(path.path) != ".glb", document_);
        geometry_.emplace(path.path, file_, document_, options);
        std::vector<TakenMesh> taken(document_.meshes());
        mesh_of_accessor_.assign(document_.accessors.size(), kUnknown);
        UniqueIds ids;
        const auto id_of = [](std::uint32_t node, const Part& part) {
            return part.id.empty() ? "node " + std::to_string(node) : part.id;
        };
        walk(document_, [&](std::uint32_t node, const Part& part, const Transform&) {
            ids.announce(id_of(node, part));
        });
        ids.finish();
        PartSpool::Cursor nodes(document_.nodes);
        walk(document_, [&](std::uint32_t node, const Part& found, const Transform& world) {
            TakenMesh& mesh = taken[found.mesh];
            if (mesh.number == kUnknown)
                mesh = take_mesh(found.mesh);
            if (mesh.number == kNoSurface)
                return;
            Part part = found;
            part.mesh = mesh.number;
            part.colour = mesh.colour;
            const std::string id = id_of(node, found);
            const std::vector<PartProperty> properties = nodes.properties(node);
            for_each_placement(node, world, [&](const Transform& world_from_mesh) {
                part.id = ids.unique(id);
                part.name = found.name.empty() ? part.id : found.name;
                part.world_from_mesh = world_from_mesh;
                note_step(mesh.step, world_from_mesh);
                append(part, properties);
            });
        });
        mesh_of_accessor_ = {};
        if (parts().size() == 0)
            throw Fault(ErrorCode::bad_mesh, "holds no triangles");
        finish();
    }

    [[nodiscard]] std::uint32_t meshes() const override {
        return static_cast<std::uint32_t>(sizes_.size());
    }
    [[nodiscard]] Size size(std::uint32_t mesh) const override { return sizes_[mesh]; }

    void read(std::uint32_t mesh, MeshSink& sink) const override {
        for_each_surface(meshes_[mesh], [&](const GlbDocument::Primitive& primitive) {
            read_positions(geometry_->positions(primitive), sink);
        });
        std::uint32_t first = 0;
        for_each_surface(meshes_[mesh], [&](const GlbDocument::Primitive& primitive) {
            Corners corners{geometry_->indices(primitive), first,
                            static_cast<std::uint32_t>(geometry_->positions(primitive).count)};
            read_triangles(primitive.mode, corners, sink);
            first += corners.vertices;
        });
    }

private:
    static constexpr std::uint32_t kUnknown = 0xffffffff, kNoSurface = 0xfffffffe;
    using Mode = GlbDocument::Primitive::Mode;

    [[nodiscard]] std::span<const GlbDocument::Primitive>
    primitives(std::uint32_t gltf_mesh) const {
        const std::uint64_t first = document_.first_primitive[gltf_mesh];
        return std::span(document_.primitives)
            .subspan(first, document_.first_primitive[gltf_mesh + 1] - first);
    }

    /// Visits the primitives with triangles; points and lines are left out.
    template <typename Take>
    void for_each_surface(std::uint32_t gltf_mesh, const Take& take) const {
        for (const GlbDocument::Primitive& primitive : primitives(gltf_mesh))
            if (primitive.mode != Mode::other)
                take(primitive);
    }

    template <typename Take>
    void for_each_placement(std::uint32_t node, const Transform& world, const Take& take) const {
        const auto instances = std::lower_bound(
            document_.instances.begin(), document_.instances.end(), node,
            [](const GlbDocument::Instances& a, std::uint32_t b) { return a.node < b; });
        if (instances == document_.instances.end() || instances->node != node) {
            take(world);
            return;
        }
        InstanceReader(*geometry_, *instances).for_each([&](const Transform& node_from_instance) {
            take(compose(world, node_from_instance));
        });
    }

    static std::uint64_t triangles(Mode mode, std::uint64_t corners) {
        if (mode != Mode::triangles)
            return corners - std::min<std::uint64_t>(corners, 2);
        if (corners % 3 != 0)
            malformed("the indices of a primitive are not a multiple of three");
        return corners / 3;
    }

    struct TakenMesh {
        std::uint32_t number = kUnknown; ///< in this source, or kNoSurface
        std::optional<Colour> colour;
        double step = 0; ///< the largest step_of its primitives
    };

    /// Points that lie within one step of each other cannot be told apart.
    void note_step(double step, const Transform& world_from_mesh) {
        const auto& m = world_from_mesh.m;
        for (std::size_t axis = 0; step > 0 && axis < 3; ++axis)
            facts_.precision.stated = std::max(
                facts_.precision.stated,
                step * frame().unit * std::hypot(m[3 * axis], m[3 * axis + 1], m[3 * axis + 2]));
    }

    TakenMesh take_mesh(std::uint32_t gltf_mesh) {
        Size size;
        ColourTally colours;
        double step = 0;
        for_each_surface(gltf_mesh, [&](const GlbDocument::Primitive& primitive) {
            const GltfElements positions = geometry_->positions(primitive);
            const std::uint64_t vertices = positions.count;
            step = std::max(step, step_of(positions));
            const auto corners = geometry_->indices(primitive);
            const std::uint64_t count =
                triangles(primitive.mode, corners ? corners->count : vertices);
            size.vertices += vertices;
            size.triangles += count;
            colours.add(colour_of(primitive), count);
        });
        if (size.triangles == 0)
            return {kNoSurface, std::nullopt, 0};
        if (std::max(size.vertices, size.triangles) > kLargestMesh)
            throw Fault(ErrorCode::unsupported, "has a part with more than 4 billion vertices");
        return {number_of(gltf_mesh, size), colours.largest(), step};
    }

    [[nodiscard]] std::optional<Colour> colour_of(const GlbDocument::Primitive& primitive) const {
        return primitive.material < document_.materials.size()
                   ? document_.materials[primitive.material]
                   : std::nullopt;
    }

    /// Returns the number of a mesh in this source. glTF repeats a mesh that has several materials,
    /// with the same accessors; here it is one mesh.
    std::uint32_t number_of(std::uint32_t gltf_mesh, const Size& size) {
        using Primitive = GlbDocument::Primitive;
        const std::span<const Primitive> own = primitives(gltf_mesh);
        const Primitive& first = *std::ranges::find_if(
            own, [](const Primitive& primitive) { return primitive.mode != Mode::other; });
        std::uint32_t& number =
            mesh_of_accessor_[first.indices != GlbDocument::kNone ? first.indices : first.position];
        const auto same = [](const Primitive& a, const Primitive& b) {
            return a.mode == b.mode && a.position == b.position && a.indices == b.indices &&
                   a.draco == b.draco;
        };
        if (number != kUnknown && std::ranges::equal(own, primitives(meshes_[number]), same))
            return number;
        meshes_.push_back(gltf_mesh);
        sizes_.push_back(size);
        return number = static_cast<std::uint32_t>(sizes_.size() - 1);
    }

    static void read_positions(const GltfElements& elements, MeshSink& sink) {
        constexpr std::uint64_t kPiece = 16384;
        std::vector<float> numbers;
        std::vector<Vec3> piece;
        for (std::uint64_t i = 0; i < elements.count; i += kPiece) {
            piece.resize(std::min(kPiece, elements.count - i));
            numbers.resize(3 * piece.size());
            read_elements(elements, i, std::span(numbers));
            for (std::size_t k = 0; k < piece.size(); ++k)
                piece[k] = {numbers[3 * k], numbers[3 * k + 1], numbers[3 * k + 2]};
            sink.vertices(piece);
        }
    }

    /// The corners of a primitive, as vertex indices of the whole mesh.
    struct Corners {
        std::optional<GltfElements> indices;
        std::uint32_t first = 0, vertices = 0;

        [[nodiscard]] std::uint64_t count() const { return indices ? indices->count : vertices; }
        void read(std::uint64_t from, std::span<std::uint32_t> to) const {
            if (indices)
                read_elements(*indices, from, to);
            else
                std::iota(to.begin(), to.end(), static_cast<std::uint32_t>(from));
            for (std::uint32_t& corner : to) {
                if (corner >= vertices)
                    throw Fault(ErrorCode::bad_mesh, "index " + std::to_string(corner) +
                                                         " of a primitive refers to a vertex that "
                                                         "does not exist");
                corner += first;
            }
        }
    };

    static void read_triangles(Mode mode, const Corners& corners, MeshSink& sink) {
        constexpr std::uint64_t kPiece = 16384;
        const std::uint64_t count = triangles(mode, corners.count());
        std::uint32_t centre = 0; // of a fan
        if (mode == Mode::fan && count > 0)
            corners.read(0, std::span(&centre, 1));
        std::vector<std::uint32_t> read;
        std::vector<std::array<std::uint32_t, 3>> piece;
        for (std::uint64_t first = 0; first < count; first += kPiece) {
            piece.resize(std::min(kPiece, count - first));
            if (mode == Mode::triangles) {
                read.resize(3 * piece.size());
                corners.read(3 * first, std::span(read));
                for (std::size_t i = 0; i < piece.size(); ++i)
                    piece[i] = {read[3 * i], read[3 * i + 1], read[3 * i + 2]};
            } else if (mode == Mode::strip) {
                read.resize(piece.size() + 2);
                corners.read(first, std::span(read));
                // Every other triangle of a strip is reversed, so that all have one orientation.
                for (std::size_t i = 0; i < piece.size(); ++i)
                    piece[i] = (first + i) % 2 == 0 ? std::array{read[i], read[i + 1], read[i + 2]}
                                                    : std::array{read[i + 1], read[i], read[i + 2]};
            } else {
                read.resize(piece.size() + 1);
                corners.read(first + 1, std::span(read));
                for (std::size_t i = 0; i < piece.size(); ++i)
                    piece[i] = {centre, read[i], read[i + 1]};
            }
            sink.triangles(piece);
        }
    }

    RandomAccessFile file_;
    GlbDocument document_;
    std::optional<GltfGeometry> geometry_; ///< always set
    std::vector<std::uint32_t> meshes_;    ///< glTF mesh for each mesh of this source
    std::vector<Size> sizes_;
    /// The last mesh whose first primitive uses an accessor for its indices, or else its positions.
    std::vector<std::uint32_t> mesh_of_accessor_;
};

} // namespace

std::unique_ptr<SceneSource> open_glb_source(const ModelPath& path, const SourceOptions& options) {
    return std::make_unique<GlbSource>(path, options);
}

} // namespace abut
