#pragma once

#include "tests/io/support.h"

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

namespace abut::test {

/// Component types of accessors.
inline constexpr int kByte = 5120, kUnsignedByte = 5121, kShort = 5122, kUnsignedShort = 5123,
                     kUnsignedInt = 5125, kFloat = 5126;

/// Builds a glTF file from buffer views and accessors.
class GltfBuilder {
public:
    using json = nlohmann::json;

    json document{{"asset", {{"version", "2.0"}}},
                  {"scene", 0},
                  {"scenes", json::array({{{"nodes", json::array()}}})},
                  {"buffers", json::array({json::object()})}};
    std::string binary;

    /// Adds a buffer view and returns its index.
    std::size_t view(const std::string& bytes, std::size_t stride = 0) {
        json view = place(bytes);
        if (stride > 0)
            view["byteStride"] = stride;
        return append("bufferViews", view);
    }

    /// Stores bytes and returns their `buffer`, `byteOffset` and `byteLength`.
    json place(const std::string& bytes) {
        binary.resize((binary.size() + 3) / 4 * 4, '\0');
        const std::size_t offset = binary.size();
        binary += bytes;
        return {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", bytes.size()}};
    }

    std::size_t accessor(std::size_t view, int component, std::size_t count, const char* type) {
        return append(
            "accessors",
            {{"bufferView", view}, {"componentType", component}, {"count", count}, {"type", type}});
    }

    template <typename Value>
    std::size_t accessor(const std::vector<Value>& values, int component, std::size_t count,
                         const char* type, std::size_t stride = 0) {
        std::string bytes;
        for (const Value& value : values)
            test::append(bytes, value);
        return accessor(view(bytes, stride), component, count, type);
    }

    std::size_t append(const char* list, const json& element) {
        document[list].push_back(element);
        return document[list].size() - 1;
    }

    /// Adds a mesh of one primitive and returns its index.
    std::size_t mesh(const json& primitive) {
        return append("meshes", {{"primitives", json::array({primitive})}});
    }

    /// Adds a root node and returns its index.
    std::size_t node(const json& node) {
        const std::size_t number = append("nodes", node);
        document["scenes"][0]["nodes"].push_back(number);
        return number;
    }

    void require(const char* extension) {
        document["extensionsUsed"].push_back(extension);
        document["extensionsRequired"].push_back(extension);
    }

    [[nodiscard]] std::string file() const {
        json copy = document;
        copy["buffers"][0]["byteLength"] = binary.size();
        return glb(copy, binary);
    }
};

} // namespace abut::test
