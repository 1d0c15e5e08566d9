#pragma once

#include <abut/scene.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace abut {

class ReadWatch;

/// Builds a scene from the vertices, faces and parts of a polygon file.
class PolygonScene {
public:
    /// In          watch: must outlive this.
    explicit PolygonScene(const ReadWatch& watch) : watch_(watch) {}

    /// Adds a vertex, narrowed to float.
    ///
    /// Errors      Fault unsupported beyond 2^32 - 2 vertices; Error of the watch.
    void vertex(const Vec3& position);

    /// Adds a part and returns its number.
    std::size_t add_part(std::string id);

    /// In          corners: vertex numbers, which may be added later. Fewer than three are ignored.
    /// Errors      as vertex.
    void face(std::size_t part, std::span<const std::uint64_t> corners);

    [[nodiscard]] std::uint64_t vertices() const noexcept { return pool_.size(); }

    enum class Vertices : std::uint8_t { used, all };

    /// Returns the parts that have faces. Polygons are cut into triangles, vertices at equal
    /// positions are joined, and ids are as given. Call it once.
    ///
    /// In          vertices: whether a mesh has only the vertices that its faces use, in the order
    ///             of their first use, or all vertices.
    /// Errors      Fault bad_mesh for a corner without a vertex; as `vertex`.
    Scene finish(Vertices vertices);

private:
    struct FloatPosition {
        float x = 0, y = 0, z = 0;
    };
    struct Faces {
        std::string id;
        std::vector<std::uint32_t> corners; ///< of all faces, one after the other
        std::vector<std::uint32_t> sizes;   ///< corners of each face; empty: all are triangles
    };
    template <typename Value>
    void push(std::vector<Value>& values, Value value);
    void require(std::uint64_t more_bytes);
    void add_positions(Faces& faces, Vertices vertices, Mesh& mesh);
    void add_triangles(const Faces& faces, Mesh& mesh);

    const ReadWatch& watch_;
    std::vector<FloatPosition> pool_;
    std::vector<Faces> parts_;
    std::vector<std::uint32_t> number_of_; ///< number of each pool vertex in the current mesh
    std::uint64_t bytes_ = 0;
};

} // namespace abut
