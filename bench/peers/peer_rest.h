#pragma once

#include <abut/mesh.h>

#include <cstddef>
#include <memory>
#include <optional>

namespace abut::bench {

/// CGAL's pairs of triangles of one mesh that share a point, but are no neighbours.
class CgalSelfIntersections {
public:
    /// Converts the mesh.
    explicit CgalSelfIntersections(const Mesh& mesh);
    ~CgalSelfIntersections();
    CgalSelfIntersections(const CgalSelfIntersections&) = delete;
    CgalSelfIntersections& operator=(const CgalSelfIntersections&) = delete;

    /// The number of pairs. Nothing if built without CGAL, or if the mesh is not manifold.
    [[nodiscard]] std::optional<std::size_t> count() const;

private:
    struct Data;
    std::unique_ptr<Data> data_;
};

} // namespace abut::bench
