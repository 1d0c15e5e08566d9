#include "c/guard.h"

#include <abut/make_mesh.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <new>

namespace abut {

namespace {

thread_local std::string t_message;

abut_status code_in_c(ErrorCode code) {
    switch (code) {
    case ErrorCode::bad_argument:
        return ABUT_BAD_ARGUMENT;
    case ErrorCode::file_not_found:
        return ABUT_FILE_NOT_FOUND;
    case ErrorCode::unreadable:
        return ABUT_UNREADABLE;
    case ErrorCode::malformed:
        return ABUT_MALFORMED;
    case ErrorCode::unsupported:
        return ABUT_UNSUPPORTED;
    case ErrorCode::bad_mesh:
        return ABUT_BAD_MESH;
    case ErrorCode::reader_failed:
        return ABUT_READER_FAILED;
    case ErrorCode::cannot_write:
        return ABUT_CANNOT_WRITE;
    case ErrorCode::interrupted:
        return ABUT_INTERRUPTED;
    }
    return ABUT_INTERNAL;
}

void keep_message(const char* message) noexcept {
    try {
        t_message = message;
    } catch (...) {
        t_message.clear();
    }
}

} // namespace

abut_status note_failure() noexcept {
    try {
        throw;
    } catch (const Error& error) {
        keep_message(error.what());
        return code_in_c(error.code());
    } catch (const std::bad_alloc&) {
        keep_message("out of memory");
        return ABUT_OUT_OF_MEMORY;
    } catch (const std::exception& error) {
        keep_message(error.what());
        return ABUT_INTERNAL;
    } catch (...) {
        keep_message("unknown fault");
        return ABUT_INTERNAL;
    }
}

Pose from_c(const abut_pose& pose) {
    Pose result{.translation = from_c(pose.translation)};
    std::copy_n(pose.rotation, 4, result.rotation.begin());
    return result;
}

abut_pose to_c(const Pose& pose) {
    abut_pose result{.translation = to_c(pose.translation), .rotation = {}};
    std::copy_n(pose.rotation.begin(), 4, result.rotation);
    return result;
}

Transform from_c(const abut_transform* transform, const char* name) {
    Transform result;
    if (transform == nullptr)
        return result;
    std::copy_n(transform->m, 12, result.m.begin());
    if (!std::all_of(result.m.begin(), result.m.end(), [](double v) { return std::isfinite(v); }))
        throw Error(ErrorCode::bad_argument, std::string(name) + " has a value that is not finite");
    return result;
}

bool is_signed(int flags) {
    if ((flags & ~ABUT_SIGNED) != 0)
        throw Error(ErrorCode::bad_argument,
                    "flags: " + std::to_string(flags) + " is neither 0 nor ABUT_SIGNED");
    return flags == ABUT_SIGNED;
}

std::vector<Vec3> from_c(const abut_vec3* points, std::size_t count) {
    const std::span<const abut_vec3> given = needed(points, count, "points");
    std::vector<Vec3> result;
    result.reserve(count);
    for (const abut_vec3& point : given)
        result.push_back(from_c(point));
    return result;
}

Mesh mesh_from_c(std::span<const double> coordinates, std::span<const std::uint32_t> indices) {
    return make_mesh(coordinates, indices);
}

} // namespace abut

extern "C" {

const char* abut_error_message(void) {
    return abut::t_message.c_str();
}

int abut_c_version(void) {
    return ABUT_C_VERSION;
}

const char* abut_version(void) {
    return ABUT_VERSION;
}

abut_status abut_transform_of(const abut_pose* pose, abut_transform* transform) {
    return abut::guarded([&] {
        const abut::Transform result(abut::from_c(abut::needed(pose, "pose")));
        std::copy_n(result.m.begin(), 12, abut::needed(transform, "transform").m);
    });
}

} // extern "C"
