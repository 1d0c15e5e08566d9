#include "io/polygon/ply_body.h"

#include <algorithm>
#include <array>

namespace abut {

bool PlyBody::skip(const PlyType& type, std::uint64_t count) {
    if (is_text()) {
        for (; count > 0; --count) {
            const std::string_view word = take_word(data_);
            if (word.empty())
                return false;
            if (!to_real(word))
                malformed("has " + std::string(word.substr(0, 40)) + " in place of a number");
        }
        return true;
    }
    if (count > data_.left() / type.bytes)
        return false;
    for (std::uint64_t left = count * type.bytes; left > 0;) {
        if (data_.ahead().empty() && !data_.more())
            return false;
        const auto taken = std::min<std::uint64_t>(left, data_.ahead().size());
        data_.take(taken);
        left -= taken;
    }
    return true;
}

bool PlyBody::skip(const PlyProperty& property) {
    std::uint64_t length = 1;
    if (property.is_list && !take_length(property, length))
        return false;
    return skip(property.value, length);
}

bool PlyBody::take_length(const PlyProperty& property, std::uint64_t& length) {
    std::int64_t value = 0;
    if (!take(property.length, value))
        return false;
    if (value < 0)
        malformed("has a list of negative length");
    length = static_cast<std::uint64_t>(value);
    return true;
}

std::uint64_t PlyBody::most(const PlyElement& element) const {
    std::uint64_t bytes = 0;
    // A list may be empty; in text, a value has at least one character.
    for (const PlyProperty& property : element.properties)
        bytes += is_text() ? 1 : (property.is_list ? property.length : property.value).bytes;
    return bytes == 0 ? 0 : std::min(element.count, data_.left() / bytes);
}

bool PlyBody::at_end() {
    return is_text() ? take_word(data_).empty() : !data_.has(1);
}

namespace {

/// Returns the list of a face's vertices; null if faces have none.
const PlyProperty* corner_list(const PlyElement& element) {
    for (const PlyProperty& property : element.properties)
        if (property.is_list &&
            (property.name == "vertex_indices" || property.name == "vertex_index"))
            return &property;
    return nullptr;
}

/// Takes a face's corners. False at the end of the data.
bool take_corners(PlyBody& body, const PlyProperty& list, std::uint64_t vertices,
                  std::vector<std::uint64_t>& corners) {
    std::uint64_t length = 0;
    if (!body.take_length(list, length))
        return false;
    corners.clear();
    for (std::uint64_t i = 0; i < length; ++i) {
        std::int64_t index = 0;
        if (!body.take(list.value, index))
            return false;
        if (index < 0 || static_cast<std::uint64_t>(index) >= vertices)
            throw Fault(ErrorCode::bad_mesh, "a face refers to vertex " + std::to_string(index) +
                                                 " of " + std::to_string(vertices));
        corners.push_back(static_cast<std::uint64_t>(index));
    }
    return true;
}

/// The properties x, y and z of a vertex.
using Axes = std::array<const PlyProperty*, 3>;

Axes axes_of(const PlyElement& vertex) {
    Axes axes{};
    for (std::size_t i = 0; i < axes.size(); ++i) {
        const std::string name(1, "xyz"[i]);
        for (const PlyProperty& property : vertex.properties)
            if (property.name == name && !property.is_list)
                axes.at(i) = &property;
        if (axes.at(i) == nullptr)
            malformed("its vertices have no " + name);
    }
    return axes;
}

/// Takes a vertex. False at the end of the data.
bool take_vertex(PlyBody& body, const PlyElement& element, const Axes& axes, Vec3& position) {
    for (const PlyProperty& property : element.properties) {
        const bool taken = &property == axes[0]   ? body.take(property.value, position.x)
                           : &property == axes[1] ? body.take(property.value, position.y)
                           : &property == axes[2] ? body.take(property.value, position.z)
                                                  : body.skip(property);
        if (!taken)
            return false;
    }
    return true;
}

} // namespace

void take_ply_vertices(PlyBody& body, const PlyElement& element,
                       const std::function<void(const Vec3&)>& vertex) {
    const Axes axes = axes_of(element);
    take_ply_elements(element, [&] {
        Vec3 position;
        if (!take_vertex(body, element, axes, position))
            return false;
        vertex(position);
        return true;
    });
}

void take_ply_faces(PlyBody& body, const PlyElement& element, std::uint64_t vertices,
                    const PlyFace& face) {
    const PlyProperty* const list = corner_list(element);
    std::vector<std::uint64_t> corners;
    take_ply_elements(element, [&] {
        for (const PlyProperty& property : element.properties)
            if (!(&property == list ? take_corners(body, property, vertices, corners)
                                    : body.skip(property)))
                return false;
        face(corners);
        return true;
    });
}

void skip_ply_elements(PlyBody& body, const PlyElement& element) {
    take_ply_elements(element, [&] {
        return std::all_of(element.properties.begin(), element.properties.end(),
                           [&](const PlyProperty& property) { return body.skip(property); });
    });
}

} // namespace abut
