#include <abut/error.h>
#include <abut/make_mesh.h>

#include <string>
#include <utility>

namespace abut {

namespace {

template <typename Number, typename Index>
Mesh mesh_of(std::span<const Number> positions, std::span<const Index> indices) {
    if (positions.size() % 3 != 0)
        throw Error(ErrorCode::bad_mesh,
                    std::to_string(positions.size()) + " numbers of positions: not three a vertex");
    if (indices.size() % 3 != 0)
        throw Error(ErrorCode::bad_mesh,
                    std::to_string(indices.size()) + " indices: not three a triangle");
    const std::size_t vertices = positions.size() / 3;
    Mesh mesh;
    mesh.positions.reserve(vertices);
    for (std::size_t i = 0; i < positions.size(); i += 3)
        mesh.positions.push_back({positions[i], positions[i + 1], positions[i + 2]});
    mesh.triangles.resize(indices.size() / 3);
    for (std::size_t i = 0; i < indices.size(); ++i) {
        if (std::cmp_less(indices[i], 0) || std::cmp_greater_equal(indices[i], vertices))
            throw Error(ErrorCode::bad_mesh, "index " + std::to_string(i) + " is " +
                                                 std::to_string(indices[i]) + " of " +
                                                 std::to_string(vertices) + " vertices");
        mesh.triangles[i / 3][i % 3] = static_cast<std::uint32_t>(indices[i]);
    }
    return mesh;
}

} // namespace

Mesh make_mesh(std::span<const double> positions, std::span<const std::uint32_t> indices) {
    return mesh_of(positions, indices);
}

Mesh make_mesh(std::span<const double> positions, std::span<const std::int32_t> indices) {
    return mesh_of(positions, indices);
}

Mesh make_mesh(std::span<const float> positions, std::span<const std::uint32_t> indices) {
    return mesh_of(positions, indices);
}

Mesh make_mesh(std::span<const float> positions, std::span<const std::int32_t> indices) {
    return mesh_of(positions, indices);
}

} // namespace abut
