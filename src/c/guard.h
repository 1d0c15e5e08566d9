#pragma once

#include <abut/c.h>
#include <abut/error.h>
#include <abut/model.h>
#include <abut/scene.h>
#include <abut/types.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <unordered_set>
#include <utility>
#include <vector>

/// The handles of abut/c.h.
struct abut_model { // NOLINT(readability-identifier-naming)
    abut::Model model;
};
struct abut_scene { // NOLINT(readability-identifier-naming)
    explicit abut_scene(abut::Scene parts) : scene(std::move(parts)) {
        for (const abut::Part& part : scene.parts)
            ids.insert(part.id);
    }

    abut::Scene scene;
    std::unordered_set<std::string> ids; ///< of its parts
};

namespace abut {

/// Notes the message of the exception that is being handled, and returns its code. Call it from a
/// handler.
abut_status note_failure() noexcept;

/// Runs a function. What it throws becomes a code and a message.
template <class Function>
abut_status guarded(const Function& function) noexcept {
    try {
        function();
        return ABUT_OK;
    } catch (...) {
        return note_failure();
    }
}

/// Throws Error{bad_argument} if the pointer is null.
template <class T>
T& needed(T* pointer, const char* name) {
    if (pointer == nullptr)
        throw Error(ErrorCode::bad_argument, std::string(name) + " is NULL");
    return *pointer;
}

/// As above for an array of `count` times `width` elements; an empty one may be null. Throws also
/// if no memory can hold so many.
template <class T>
std::span<T> needed(T* pointer, std::size_t count, const char* name, std::size_t width = 1) {
    constexpr std::size_t kMostBytes = std::numeric_limits<std::ptrdiff_t>::max();
    // NOLINTNEXTLINE(bugprone-sizeof-expression): an array of pointers has elements of that size
    if (count > kMostBytes / (width * sizeof(T)))
        throw Error(ErrorCode::bad_argument, std::string(name) + " are more than memory can hold");
    if (count != 0)
        needed(pointer, name);
    return {pointer, count * width};
}

inline Vec3 from_c(const abut_vec3& v) {
    return {v.x, v.y, v.z};
}

inline abut_vec3 to_c(const Vec3& v) {
    return {v.x, v.y, v.z};
}

Pose from_c(const abut_pose& pose);
abut_pose to_c(const Pose& pose);
/// The identity if the pointer is null. Throws Error{bad_argument} if a value is not finite.
Transform from_c(const abut_transform* transform, const char* name);
/// Whether ABUT_SIGNED is set. Throws Error{bad_argument} if any other flag is.
bool is_signed(int flags);
std::vector<Vec3> from_c(const abut_vec3* points, std::size_t count);

/// Throws Error{bad_mesh} if an index is out of range or a coordinate is not finite.
Mesh mesh_from_c(std::span<const double> coordinates, std::span<const std::uint32_t> indices);

} // namespace abut
