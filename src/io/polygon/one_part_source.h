#pragma once

#include "io/scene/scene_source.h"

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

namespace abut {

/// A position as files with one mesh store it.
struct FloatPosition {
    float x = 0, y = 0, z = 0;
};

/// A file with one mesh and one part.
class OnePartSource : public SceneSource {
public:
    [[nodiscard]] std::uint32_t meshes() const override { return 1; }
    [[nodiscard]] Size size(std::uint32_t) const override { return size_; }

protected:
    /// The formats with one mesh define neither a unit nor axes.
    OnePartSource(const ModelPath& path, const SourceOptions& options)
        : SceneSource(FormatFrame{}, path, options), path_(path.path), watch_(options.watch) {}

    void set_part(const std::string& id, const Size& size,
                  const std::optional<Colour>& colour = std::nullopt) {
        size_ = size;
        Part part;
        part.id = part.name = id;
        part.colour = colour;
        append(std::move(part));
        finish();
    }

    /// Sends triangles of the vertices 0 1 2, 3 4 5, …
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

    std::string path_;                       // NOLINT: read by the format's reader
    std::shared_ptr<const ReadWatch> watch_; // NOLINT: likewise

private:
    Size size_;
};

} // namespace abut
