#pragma once

#include <abut/renderer.h>

#include "render/gl_handle.h"

#include <array>
#include <cstdint>
#include <vector>

namespace abut {

/// The states of all parts, and the texture that the shaders read them from: 4096 parts a row; red,
/// green, blue, and in alpha the flags hidden 1, ghosted 2, highlighted 4.
class PartStates {
public:
    /// Errors      Error{unsupported} if the texture would be too large for the graphics card.
    explicit PartStates(std::size_t parts);

    void set(std::uint32_t part, const PartState& state);
    [[nodiscard]] PartState state(std::uint32_t part) const;

    /// Sends the rows that have changed, and binds the texture.
    void bind(GLuint unit);

    [[nodiscard]] bool has_ghosts() const { return ghosts_ > 0; }
    [[nodiscard]] bool has_highlights() const { return highlights_ > 0; }
    /// Returns whether any part has a flag.
    [[nodiscard]] bool has_flags() const { return flagged_ > 0; }

private:
    static constexpr std::uint32_t kRow = 4096;
    using Texel = std::array<std::uint8_t, 4>;

    void count(Texel texel, int by);

    std::size_t parts_;
    std::vector<Texel> texels_;
    std::vector<bool> changed_;                ///< by row
    std::int64_t ghosts_ = 0, highlights_ = 0; ///< of parts that are not hidden
    std::int64_t flagged_ = 0;
    GlTexture texture_;
};

} // namespace abut
