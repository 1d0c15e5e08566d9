#pragma once

#include "io/scene_source.h"

#include <algorithm>
#include <cctype>
#include <string>
#include <string_view>
#include <vector>

namespace abut {

/// A file of one mesh, which one part shows.
class OnePartSource : public SceneSource {
public:
    [[nodiscard]] std::uint32_t meshes() const override { return 1; }
    [[nodiscard]] Size size(std::uint32_t) const override { return size_; }

protected:
    OnePartSource(const std::string& path, const SourceOptions& options)
        : SceneSource(options.folder), path_(path), unit_(options.unit) {}

    void set_part(const std::string& id, const Size& size) {
        size_ = size;
        Part part;
        part.id = part.name = id;
        if (unit_ != 0 && unit_ != 1)
            for (double& value : part.world_from_mesh.m)
                value *= unit_;
        parts_.append(part);
        parts_.finish();
    }

    /// Names that Assimp takes as they are: one word of letters, digits and a few signs.
    static bool is_plain_name(std::string_view name) {
        constexpr std::size_t kLongest = 200;
        return name.size() <= kLongest && std::all_of(name.begin(), name.end(), [](char c) {
                   return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' ||
                          c == '-' || c == '.';
               });
    }

    /// Triangles of vertices 0 1 2, 3 4 5, …
    static void send_separate_triangles(std::uint64_t count, MeshSink& sink) {
        constexpr std::uint64_t kPiece = 4096;
        std::vector<std::array<std::uint32_t, 3>> piece;
        for (std::uint64_t i = 0; i < count; i += kPiece) {
            piece.clear();
            for (std::uint64_t k = i; k < std::min(i + kPiece, count); ++k) {
                const auto first = static_cast<std::uint32_t>(3 * k);
                piece.push_back({first, first + 1, first + 2});
            }
            sink.triangles(piece);
        }
    }

    std::string path_; // NOLINT: read by those who know the format

private:
    double unit_;
    Size size_;
};

} // namespace abut
