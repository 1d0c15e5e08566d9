/// Any bytes as a file of a format that is read in this process give a scene with valid indices and
/// finite coordinates, or an Error.
#include <abut/error.h>
#include <abut/scene.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <string>
#include <unistd.h>

namespace {

const std::string& folder() {
    static const std::string made = [] {
        setenv("ABUT_READER", "/bin/false", 1); // what is left to the helper is of no interest
        std::string pattern = "/tmp/abut-fuzz-XXXXXX";
        if (mkdtemp(pattern.data()) == nullptr)
            std::abort();
        return pattern;
    }();
    return made;
}

void check(const std::string& extension, const std::string& content) {
    const std::string path = folder() + "/model" + extension;
    std::ofstream(path, std::ios::binary) << content;
    try {
        const abut::Scene scene =
            abut::read_scene(path, {.time_limit = 5, .memory_limit = std::uint64_t{1} << 28});
        for (const abut::Part& part : scene.parts)
            if (part.mesh >= scene.meshes.size())
                std::abort();
        for (const abut::Mesh& mesh : scene.meshes) {
            for (const abut::Vec3& p : mesh.positions)
                if (!std::isfinite(p.x + p.y + p.z))
                    std::abort();
            for (const auto& triangle : mesh.triangles)
                for (const std::uint32_t corner : triangle)
                    if (corner >= mesh.positions.size())
                        std::abort();
        }
    } catch (const abut::Error& error) {
        if (error.code() == abut::ErrorCode::reader_failed && extension != ".glb")
            std::abort(); // too slow or too much memory for a small file
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string content(reinterpret_cast<const char*>(data), size);
    check(".obj", content);
    check(".off", "OFF\n" + content);
    check(".ply", content);
    check(".ply", "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
                  "property float z\nelement face 2\nproperty list uchar int vertex_index\n"
                  "element tristrips 1\nproperty list int int vertex_indices\nend_header\n" +
                      content);
    check(".stl", "solid a\n" + content);
    check(".glb", content);
    return 0;
}
