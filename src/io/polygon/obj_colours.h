#pragma once

#include "io/scene/colour.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace abut {

class ReadWatch;

/// Finds the colours of an OBJ file's parts: the diffuse colours (`Kd`) of its material libraries,
/// taken to be sRGB, with the opacity (`d`, or 1 - `Tr`) as alpha.
///
/// A library that is missing, cannot be read or is larger than 4 MiB gives no colours, and neither
/// does a material with a texture (`map_Kd`).
class ObjColours {
public:
    /// In          allow_outside: whether libraries may lie outside the model's folder.
    ObjColours(std::string model, bool allow_outside, std::shared_ptr<const ReadWatch> watch)
        : model_(std::move(model)), allow_outside_(allow_outside), watch_(std::move(watch)) {}

    /// Reads libraries (`mtllib`) or chooses the material of the next faces (`usemtl`). In: as
    /// scan_obj passes it; other statements have no effect.
    ///
    /// Errors      Fault unsupported for a library outside the folder; Error of the watch.
    void statement(std::string_view statement, std::string_view name);

    /// Adds triangles of the current material to a part.
    void add(std::size_t part, std::uint64_t triangles);

    /// The colour that covers the most triangles of a part.
    [[nodiscard]] std::optional<Colour> of_part(std::size_t part);

private:
    void read_library(const std::string& name);
    void flush();

    std::string model_;
    bool allow_outside_;
    std::shared_ptr<const ReadWatch> watch_;
    std::set<std::string, std::less<>> read_; ///< libraries that have been read
    std::map<std::string, std::optional<Colour>, std::less<>> materials_;
    std::vector<ColourTally> parts_;
    std::optional<Colour> current_;
    /// Triangles of the current material that are not yet in the tally of their part.
    std::size_t part_ = 0;
    std::uint64_t triangles_ = 0;
};

} // namespace abut
