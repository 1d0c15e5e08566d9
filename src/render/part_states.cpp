#include "render/part_states.h"

#include <abut/error.h>

#include <algorithm>

namespace abut {

namespace {

constexpr std::uint8_t kHidden = 1, kGhosted = 2, kHighlighted = 4;

} // namespace

PartStates::PartStates(std::size_t parts) : parts_(parts) {
    const std::size_t rows = std::max<std::size_t>(1, (parts + kRow - 1) / kRow);
    GLint most = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &most);
    if (rows > static_cast<std::size_t>(most) || kRow > static_cast<std::uint32_t>(most))
        throw Error(ErrorCode::unsupported, "the graphics card has no room for so many parts");
    const PartState none;
    texels_.assign(rows * kRow, {none.colour.red, none.colour.green, none.colour.blue, 0});
    changed_.assign(rows, false);
    glBindTexture(GL_TEXTURE_2D, texture_.name());
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, kRow, static_cast<GLsizei>(rows), 0, GL_RGBA,
                 GL_UNSIGNED_BYTE, texels_.data());
}

void PartStates::count(Texel texel, int by) {
    flagged_ += texel[3] != 0 ? by : 0;
    if ((texel[3] & kHidden) != 0)
        return;
    ghosts_ += (texel[3] & kGhosted) != 0 ? by : 0;
    highlights_ += (texel[3] & kHighlighted) != 0 ? by : 0;
}

void PartStates::set(std::uint32_t part, const PartState& state) {
    if (part >= parts_)
        throw Error(ErrorCode::bad_argument, "the renderer has no such part");
    const Texel texel{state.colour.red, state.colour.green, state.colour.blue,
                      static_cast<std::uint8_t>((state.hidden ? kHidden : 0) |
                                                (state.ghosted ? kGhosted : 0) |
                                                (state.highlighted ? kHighlighted : 0))};
    if (texels_[part] == texel)
        return;
    count(texels_[part], -1);
    count(texel, 1);
    texels_[part] = texel;
    changed_[part / kRow] = true;
}

PartState PartStates::state(std::uint32_t part) const {
    if (part >= parts_)
        throw Error(ErrorCode::bad_argument, "the renderer has no such part");
    const Texel& texel = texels_[part];
    return {{texel[0], texel[1], texel[2]},
            (texel[3] & kHidden) != 0,
            (texel[3] & kGhosted) != 0,
            (texel[3] & kHighlighted) != 0};
}

void PartStates::bind(GLuint unit) {
    glActiveTexture(GL_TEXTURE0 + unit);
    glBindTexture(GL_TEXTURE_2D, texture_.name());
    for (std::size_t row = 0; row < changed_.size(); ++row)
        if (changed_[row]) {
            glTexSubImage2D(GL_TEXTURE_2D, 0, 0, static_cast<GLint>(row), kRow, 1, GL_RGBA,
                            GL_UNSIGNED_BYTE, texels_.data() + row * kRow);
            changed_[row] = false;
        }
}

} // namespace abut
