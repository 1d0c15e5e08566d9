#include "io/polygon/ply_scan.h"

#include "io/polygon/ply_body.h"

#include <array>

namespace abut {

namespace {

using TakeFace = std::function<void(std::span<const std::uint64_t> corners)>;

/// The triangles of strips, which the index -1 separates. Every second triangle is reversed.
class Strip {
public:
    Strip(std::uint64_t vertices, const TakeFace& face) : vertices_(vertices), face_(face) {}

    void begin() { length_ = 0; }
    void take(std::int64_t index) {
        if (index == -1) {
            begin();
            return;
        }
        if (index < 0 || static_cast<std::uint64_t>(index) >= vertices_)
            throw Fault(ErrorCode::bad_mesh, "a strip refers to vertex " + std::to_string(index) +
                                                 " of " + std::to_string(vertices_));
        const auto corner = static_cast<std::uint64_t>(index);
        if (length_ >= 2) {
            const bool odd = length_ % 2 == 1;
            const std::array triangle{last_[odd ? 1 : 0], last_[odd ? 0 : 1], corner};
            // A repeated corner only connects one strip with the next.
            if (triangle[0] != triangle[1] && corner != last_[0] && corner != last_[1])
                face_(triangle);
        }
        last_ = {last_[1], corner};
        ++length_;
    }

private:
    std::uint64_t vertices_;
    const TakeFace& face_;
    std::array<std::uint64_t, 2> last_{};
    std::uint64_t length_ = 0;
};

void take_strips(PlyBody& body, const PlyElement& element, Strip strip) {
    take_ply_elements(element, [&] {
        for (const PlyProperty& property : element.properties) {
            if (!property.is_list ||
                (property.name != "vertex_indices" && property.name != "vertex_index")) {
                if (!body.skip(property))
                    return false;
                continue;
            }
            std::uint64_t length = 0;
            if (!body.take_length(property, length))
                return false;
            strip.begin();
            for (; length > 0; --length) {
                std::int64_t index = 0;
                if (!body.take(property.value, index))
                    return false;
                strip.take(index);
            }
        }
        return true;
    });
}

} // namespace

void scan_ply(ByteStream& content, const std::function<void(const Vec3&)>& vertex,
              const TakeFace& face) {
    const PlyHeader header = read_ply_header(content);
    PlyBody body(header, content);
    for (const PlyElement& element : header.elements) {
        if (element.name == "vertex")
            take_ply_vertices(body, element, vertex);
        else if (element.name == "face")
            take_ply_faces(body, element, header.vertices(), face);
        else if (element.name == "tristrips")
            take_strips(body, element, Strip(header.vertices(), face));
        else
            skip_ply_elements(body, element);
    }
}

} // namespace abut
