/// Any text as a frame or as the data of a PLY file gives a mesh with valid indices, or a Fault.
#include "io/file/fault.h"
#include "io/frames/frame_formats.h"

#include <cstdint>
#include <cstdlib>
#include <string>

namespace {

template <typename Read>
void check(Read read, const std::string& content) {
    try {
        abut::ByteStream stream(content);
        abut::Mesh mesh;
        abut::CollectedFaces faces(mesh.triangles);
        read(stream, mesh.positions, faces);
        // The mesh may have at most one item for each byte of the file.
        if (mesh.positions.size() + mesh.triangles.size() > content.size())
            std::abort();
        for (const auto& triangle : mesh.triangles)
            for (const std::uint32_t corner : triangle)
                if (corner >= mesh.positions.size())
                    std::abort();
    } catch (const abut::Fault&) { // a Fault is a valid answer
    }
}

std::string ply_of(const std::string& encoding, const std::string& body) {
    return "ply\nformat " + encoding +
           " 1.0\nelement vertex 3\nproperty double y\nproperty char c\nproperty float x\n"
           "property short z\nelement other 1\nproperty list short float f\nelement face 2\n"
           "property list ushort uchar other\nproperty list char int vertex_index\nend_header\n" +
           body;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string content(reinterpret_cast<const char*>(data), size);
    check(abut::read_obj_frame, content);
    check(abut::read_ply_frame, content);
    for (const char* const encoding : {"ascii", "binary_little_endian", "binary_big_endian"})
        check(abut::read_ply_frame, ply_of(encoding, content));
    return 0;
}
