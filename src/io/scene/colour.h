#pragma once

#include <abut/scene.h>

#include <array>
#include <cstdint>
#include <map>
#include <optional>

namespace abut {

/// Makes a colour of components in [0, 1] as displays take them: red, green, blue, alpha. Values
/// beyond are clamped. None if one is NaN.
std::optional<Colour> display_colour(const std::array<double, 4>& components);

/// Makes a colour of red, green and blue that are proportional to light [IEC 61966-2-1]. Alpha is the
/// same in both.
std::optional<Colour> display_colour_of_linear(const std::array<double, 4>& components);

/// Inverts display_colour_of_linear: it returns the colour again.
std::array<double, 4> linear_components(const Colour& colour);

/// Finds the colour that covers the most triangles. Triangles without a colour count like those of
/// one more colour. Of equal shares the first wins.
class ColourTally {
public:
    void add(const std::optional<Colour>& colour, std::uint64_t triangles);
    /// None also if nothing was added.
    [[nodiscard]] std::optional<Colour> largest() const;

private:
    struct Share {
        std::uint64_t triangles = 0;
        std::size_t turn = 0; ///< number of colours that were added before
    };
    std::map<std::optional<std::uint32_t>, Share> shares_; ///< by the colour's four bytes
};

} // namespace abut
