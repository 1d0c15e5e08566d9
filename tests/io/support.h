#pragma once

#include <abut/error.h>
#include <abut/scene.h>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <gtest/gtest.h>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <unistd.h>
#include <vector>

namespace abut::test {

inline bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

/// A temporary folder, removed after the test.
class TemporaryFolder {
public:
    TemporaryFolder() {
        std::string pattern = std::filesystem::temp_directory_path() / "abut-io-XXXXXX";
        path_ = mkdtemp(pattern.data());
    }
    ~TemporaryFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    /// Writes a file and returns its path.
    [[nodiscard]] std::string file(const std::string& name, const std::string& content) const {
        std::ofstream(path_ / name, std::ios::binary) << content;
        return path_ / name;
    }
    [[nodiscard]] std::string script(const std::string& name, const std::string& body) const {
        const std::string path = file(name, "#!/bin/sh\n" + body);
        std::filesystem::permissions(path, std::filesystem::perms::owner_all);
        return path;
    }
    [[nodiscard]] std::string path(const std::string& name) const { return path_ / name; }

private:
    std::filesystem::path path_;
};

/// While it lives, a process of root opens files as nobody, because permissions do not bind root.
class AsNobody {
public:
    AsNobody() {
        if (geteuid() == 0) {
            EXPECT_EQ(seteuid(65534), 0);
        }
    }
    ~AsNobody() {
        if (getuid() == 0) {
            EXPECT_EQ(seteuid(0), 0);
        }
    }
    AsNobody(const AsNobody&) = delete;
    AsNobody& operator=(const AsNobody&) = delete;
};

/// Sets an environment variable while it lives.
class Environment {
public:
    Environment(const char* name, const std::string& value) : name_(name) {
        if (const char* const before = std::getenv(name))
            before_ = before;
        setenv(name, value.c_str(), 1);
    }
    ~Environment() {
        if (before_.empty())
            unsetenv(name_);
        else
            setenv(name_, before_.c_str(), 1);
    }
    Environment(const Environment&) = delete;
    Environment& operator=(const Environment&) = delete;

private:
    const char* name_;
    std::string before_;
};

inline std::string read_bytes(const std::string& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

/// Expects an action on a file to throw an error with this code, on one line that begins with the
/// file's name. Returns the message.
inline std::string error_of(const std::string& path, ErrorCode code,
                            const std::function<void()>& action) {
    try {
        action();
        ADD_FAILURE() << path << " was accepted";
    } catch (const Error& error) {
        const std::string text = error.what();
        EXPECT_EQ(static_cast<int>(error.code()), static_cast<int>(code)) << text;
        if (code != ErrorCode::interrupted) {
            EXPECT_EQ(text.rfind(path + ": ", 0), 0U) << text;
            EXPECT_EQ(error.file(), path);
        }
        EXPECT_EQ(text.find('\n'), std::string::npos) << text;
        return text;
    }
    return "";
}

/// Expects read_scene to throw an error with this code. Returns the message.
inline std::string error_of(const std::string& path, ErrorCode code,
                            const ReadOptions& options = {}) {
    return error_of(path, code, [&] { (void)read_scene(path, options); });
}

template <typename Value>
void append(std::string& bytes, const Value& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// A GLB file of a JSON text and a binary chunk.
inline std::string glb(const nlohmann::json& document, std::string binary) {
    std::string text = document.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    binary.resize((binary.size() + 3) / 4 * 4, '\0');
    std::string bytes = "glTF";
    append(bytes, std::uint32_t{2});
    append(bytes, static_cast<std::uint32_t>(28 + text.size() + binary.size()));
    append(bytes, static_cast<std::uint32_t>(text.size()));
    bytes += "JSON" + text;
    append(bytes, static_cast<std::uint32_t>(binary.size()));
    bytes += std::string("BIN\0", 4) + binary;
    return bytes;
}

/// The tetrahedron that the sample of every format contains.
inline constexpr std::array<std::array<float, 3>, 4> kCorners{
    {{0, 0, 0}, {1.25F, 0, 0}, {0, 2.5F, 0}, {0, 0, 0.1F}}};
inline constexpr std::array<std::array<std::uint32_t, 3>, 4> kFaces{
    {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};

/// 48 bytes of positions, then 48 of indices.
inline std::string tetrahedron_bytes() {
    std::string bytes;
    append(bytes, kCorners);
    append(bytes, kFaces);
    return bytes;
}

/// A glTF document of `nodes` that may use mesh 0, the tetrahedron, whose buffer is the GLB's
/// binary chunk.
inline nlohmann::json tetrahedron_document(const nlohmann::json& nodes,
                                           const nlohmann::json& roots) {
    using nlohmann::json;
    return {
        {"asset", {{"version", "2.0"}}},
        {"scene", 0},
        {"scenes", json::array({{{"nodes", roots}}})},
        {"nodes", nodes},
        {"meshes", json::array({{{"primitives", json::array({{{"attributes", {{"POSITION", 0}}},
                                                              {"indices", 1}}})}}})},
        {"accessors",
         json::array(
             {{{"bufferView", 0},
               {"componentType", 5126},
               {"count", 4},
               {"type", "VEC3"},
               {"min", {0, 0, 0}},
               {"max", {1.25, 2.5, 0.10000000149011612}}},
              {{"bufferView", 1}, {"componentType", 5125}, {"count", 12}, {"type", "SCALAR"}}})},
        {"bufferViews", json::array({{{"buffer", 0}, {"byteOffset", 0}, {"byteLength", 48}},
                                     {{"buffer", 0}, {"byteOffset", 48}, {"byteLength", 48}}})},
        {"buffers", json::array({{{"byteLength", 96}}})}};
}

/// The corners of all triangles of a scene in world coordinates, in order.
inline std::vector<std::array<Vec3, 3>> world_triangles(const Scene& scene) {
    std::vector<std::array<Vec3, 3>> result;
    for (const Part& part : scene.parts) {
        const auto& m = part.world_from_mesh.m;
        const Mesh& mesh = scene.meshes.at(part.mesh);
        const auto at = [&](std::uint32_t index) {
            const Vec3& p = mesh.positions.at(index);
            return Vec3{m[0] * p.x + m[3] * p.y + m[6] * p.z + m[9],
                        m[1] * p.x + m[4] * p.y + m[7] * p.z + m[10],
                        m[2] * p.x + m[5] * p.y + m[8] * p.z + m[11]};
        };
        for (const auto& [a, b, c] : mesh.triangles)
            result.push_back({at(a), at(b), at(c)});
    }
    return result;
}

} // namespace abut::test
