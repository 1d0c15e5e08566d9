#include <abut/error.h>
#include <abut/frame.h>

#include "io/file/fault.h"
#include "io/file/file_kind.h"
#include "io/file/input_file.h"
#include "io/frames/frame_formats.h"
#include "io/polygon/obj_scan.h"
#include "io/polygon/ply_body.h"
#include "mesh/topology.h"

#include <limits>

namespace abut {

void read_obj_frame(ByteStream& content, std::vector<Vec3>& positions, FrameFaces& faces) {
    scan_obj(
        content, [&](const Vec3& position) { positions.push_back(position); },
        [&](auto corners) { faces.take(corners); });
}

void read_ply_frame(ByteStream& content, std::vector<Vec3>& positions, FrameFaces& faces) {
    const PlyHeader header = read_ply_header(content);
    PlyBody body(header, content);
    for (const PlyElement& element : header.elements) {
        if (element.name == "vertex") {
            positions.reserve(positions.size() + body.most(element));
            take_ply_vertices(body, element,
                              [&](const Vec3& position) { positions.push_back(position); });
        } else if (element.name == "face") {
            faces.expect(body.most(element));
            take_ply_faces(body, element, header.vertices(),
                           [&](auto corners) { faces.take(corners); });
        } else if (element.name == "tristrips") {
            throw Fault(ErrorCode::unsupported, "holds triangle strips");
        } else {
            skip_ply_elements(body, element);
        }
    }
    // A header that contradicts its data shows in nothing else: bytes of any type are numbers.
    if (!body.at_end())
        malformed("goes on after its last element");
}

void require_frame(const Mesh& mesh, const std::string& path) {
    if (mesh.positions.size() > std::numeric_limits<std::uint32_t>::max())
        throw Error(ErrorCode::bad_mesh, path, "has too many vertices for one mesh");
    if (mesh.triangles.empty())
        throw Error(ErrorCode::bad_mesh, path, "holds no triangles");
    try {
        require_valid(mesh);
    } catch (const Error& error) {
        throw Error(error.code(), path, error.what());
    }
}

namespace {

void read_unchecked(const std::string& path, std::vector<Vec3>& positions, FrameFaces& faces) {
    const std::string extension = lower_extension(path);
    if (extension != ".obj" && extension != ".ply")
        throw Error(ErrorCode::unsupported, path, "frames are read from .obj and .ply files only");
    try {
        check_file_kind(path, extension);
        ByteStream content = ByteStream::open(path);
        (extension == ".obj" ? read_obj_frame : read_ply_frame)(content, positions, faces);
    } catch (const Fault& fault) {
        throw Error(fault.code(), path, fault.what());
    }
}

/// Compares faces with the triangles of another frame.
class SameFaces : public FrameFaces {
public:
    explicit SameFaces(std::span<const std::array<std::uint32_t, 3>> triangles)
        : rest_(triangles) {}
    void take(std::span<const std::uint64_t> corners) override {
        for_each_of_fan(corners, [&](const auto& triangle) {
            same_ = same_ && !rest_.empty() && rest_.front() == triangle;
            if (same_)
                rest_ = rest_.subspan(1);
        });
    }
    /// Returns whether all triangles were equal and none is left.
    [[nodiscard]] bool same() const { return same_ && rest_.empty(); }

private:
    std::span<const std::array<std::uint32_t, 3>> rest_;
    bool same_ = true;
};

} // namespace

Mesh read_frame(const std::string& path) {
    Mesh mesh;
    CollectedFaces faces(mesh.triangles);
    read_unchecked(path, mesh.positions, faces);
    require_frame(mesh, path);
    // Many frames may be in memory at once, so spare capacity is freed.
    mesh.positions.shrink_to_fit();
    mesh.triangles.shrink_to_fit();
    return mesh;
}

std::optional<std::vector<Vec3>>
read_frame_positions(const std::string& path, std::size_t vertices,
                     std::span<const std::array<std::uint32_t, 3>> triangles) {
    std::vector<Vec3> positions;
    SameFaces faces(triangles);
    read_unchecked(path, positions, faces);
    if (!faces.same() || positions.size() != vertices)
        return std::nullopt;
    try {
        require_valid_positions(positions);
    } catch (const Error& error) {
        throw Error(error.code(), path, error.what());
    }
    positions.shrink_to_fit();
    return positions;
}

} // namespace abut
