#pragma once

#include <abut/scene.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace abut {

class ReadWatch;

/// Puts a scene together from vertices, faces and parts as a file of polygons has them.
class PolygonScene {
public:
    /// In          watch: must outlive this.
    explicit PolygonScene(const ReadWatch& watch) : watch_(watch) {}

    /// Is narrowed to float. Errors: Fault unsupported beyond 2^32 - 2 vertices; Error of the watch.
    void vertex(const Vec3& position);

    /// Returns the part's number.
    std::size_t add_part(std::string id);

    /// In          corners: numbers of vertices, which may come later; less than three are no face.
    /// Errors      as vertex.
    void face(std::size_t part, std::span<const std::uint64_t> corners);

    [[nodiscard]] std::uint64_t vertices() const noexcept { return pool_.size(); }

    enum class Vertices : std::uint8_t { used, all };

    /// The parts that have faces, polygons cut into triangles, vertices at equal positions joined;
    /// ids as they were given. To be called once.
    ///
    /// In          vertices: whether a mesh has only those that its faces use, in the order of their
    ///             first use, or all that there are.
    /// Errors      Fault bad_mesh for a corner that is no vertex; as vertex.
    Scene finish(Vertices vertices);

private:
    struct FloatPosition {
        float x = 0, y = 0, z = 0;
    };
    struct Faces {
        std::string id;
        std::vector<std::uint32_t> corners; ///< of one face after the other
        std::vector<std::uint32_t> sizes;   ///< of the faces; empty: all are triangles
    };
    template <typename Value>
    void push(std::vector<Value>& values, Value value);
    void require(std::uint64_t more_bytes);
    void add_positions(Faces& faces, Vertices vertices, Mesh& mesh);
    void add_triangles(const Faces& faces, Mesh& mesh);

    const ReadWatch& watch_;
    std::vector<FloatPosition> pool_;
    std::vector<Faces> parts_;
    std::vector<std::uint32_t> number_of_; ///< in the current mesh, of each vertex of the pool
    std::uint64_t bytes_ = 0;
};

} // namespace abut
