#include "io/polygon/obj_colours.h"

#include "io/file/companion_file.h"
#include "io/file/fault.h"
#include "io/file/input_file.h"
#include "io/file/text_scan.h"

#include <algorithm>
#include <array>

namespace abut {

namespace {

constexpr std::uint64_t kLargestLibrary = std::uint64_t{4} << 20;

/// A material as its statements are read.
struct ObjMaterial {
    std::string name;
    std::optional<std::array<double, 3>> diffuse;
    double opacity = 1;
    bool has_texture = false;

    [[nodiscard]] std::optional<Colour> colour() const {
        if (!diffuse || has_texture)
            return std::nullopt;
        return display_colour({(*diffuse)[0], (*diffuse)[1], (*diffuse)[2], opacity});
    }
};

/// Takes three numbers, or one that stands for three.
std::optional<std::array<double, 3>> take_diffuse(std::string_view rest) {
    const auto red = to_real(take_word(rest));
    const std::string_view second = take_word(rest);
    if (red && second.empty())
        return std::array{*red, *red, *red};
    const auto green = to_real(second), blue = to_real(take_word(rest));
    if (!red || !green || !blue)
        return std::nullopt;
    return std::array{*red, *green, *blue};
}

void take_statement(std::string_view word, std::string_view rest, ObjMaterial& material) {
    if (word == "Kd")
        material.diffuse = take_diffuse(rest);
    else if (word == "map_Kd")
        material.has_texture = true;
    else if (word == "d" || word == "Tr")
        if (const auto value = to_real(take_word(rest)))
            material.opacity = word == "d" ? *value : 1 - *value;
}

} // namespace

void ObjColours::statement(std::string_view statement, std::string_view name) {
    if (statement == "usemtl") {
        flush();
        const auto found = materials_.find(name);
        current_ = found == materials_.end() ? std::nullopt : found->second;
    } else if (statement == "mtllib") {
        // Names are separated by blanks. Some programs write one name that has blanks.
        const std::string whole(name);
        std::size_t words = 0;
        for (std::string_view word = take_word(name); !word.empty(); word = take_word(name)) {
            read_library(std::string(word));
            ++words;
        }
        if (words > 1)
            read_library(whole);
    }
}

void ObjColours::read_library(const std::string& name) {
    const std::string path = companion_path(model_, name, allow_outside_);
    if (!read_.insert(path).second)
        return;
    try {
        if (readable_size(path) > kLargestLibrary)
            return;
        ByteStream content = ByteStream::open(path, watch_);
        LineScan lines(content);
        ObjMaterial material;
        const auto keep = [&] {
            if (!material.name.empty())
                materials_.insert_or_assign(material.name, material.colour());
        };
        for (std::string_view line; lines.next(line);) {
            const std::string_view word = take_word(line);
            if (word == "newmtl") {
                keep();
                material = {std::string(trimmed(line)), std::nullopt};
            } else {
                take_statement(word, line, material);
            }
        }
        keep();
    } catch (const Fault&) { // NOLINT: a model is useful without its colours
    }
}

void ObjColours::add(std::size_t part, std::uint64_t triangles) {
    if (part != part_)
        flush();
    part_ = part;
    triangles_ += triangles;
}

void ObjColours::flush() {
    if (triangles_ == 0)
        return;
    parts_.resize(std::max(parts_.size(), part_ + 1));
    parts_[part_].add(current_, triangles_);
    triangles_ = 0;
}

std::optional<Colour> ObjColours::of_part(std::size_t part) {
    flush();
    return part < parts_.size() ? parts_[part].largest() : std::nullopt;
}

} // namespace abut
