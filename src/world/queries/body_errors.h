#pragma once

#include <abut/error.h>

#include "core/arguments.h"
#include "world/narrow_phase/world_data.h"

#include <string>

namespace abut {

/// Calls work() and prefixes the message of an error with the body's index.
template <typename Work>
auto naming(BodyId id, const Work& work) {
    try {
        return work();
    } catch (const Error& error) {
        throw Error(error.code(), "body " + std::to_string(id.index) + ": " + error.what());
    }
}

/// Errors      Error{bad_argument} if the body is deformable.
inline void require_rigid(const Body& body) {
    require(!is_deformable(body.shape), "is deformable: it moves as its own step says");
}

} // namespace abut
