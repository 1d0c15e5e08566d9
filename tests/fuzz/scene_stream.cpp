/// A reader's output, damaged in any way, gives a sound scene or an Error.
#include <abut/error.h>

#include "io/process/decode_scene.h"

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <span>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try {
        const abut::Scene scene =
            abut::decode_scene(std::as_bytes(std::span(data, size)), {"fuzzed"}, {});
        for (const abut::Mesh& mesh : scene.meshes) {
            for (const auto& triangle : mesh.triangles)
                for (const std::uint32_t corner : triangle)
                    if (corner >= mesh.positions.size())
                        std::abort();
            for (const abut::Vec3& p : mesh.positions)
                if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
                    std::abort();
        }
        for (const abut::Part& part : scene.parts)
            if (part.mesh >= scene.meshes.size())
                std::abort();
    } catch (const abut::Error&) { // an Error is a valid answer
    }
    return 0;
}
