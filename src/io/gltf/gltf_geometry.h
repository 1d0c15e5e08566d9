#pragma once

#include "core/temporary_file.h"
#include "io/file/random_access_file.h"
#include "io/gltf/glb_document.h"
#include "io/scene/scene_source.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace abut {

/// The numbers that a glTF document's accessors refer to, in the file, in companion files, in data:
/// URIs or compressed. Any thread may read them.
class GltfGeometry {
public:
    /// Opens the companion files, and decodes compressed geometry into a temporary file.
    ///
    /// In          file: the model's; document and file must outlive this object.
    /// Errors      Fault: malformed; unsupported, also for a companion outside the model's folder
    ///             unless options.read.allow_outside_files is set. Error of the decoder's process.
    /// Cost        the decoder's process holds one compressed buffer view, or one Draco primitive,
    ///             at a time.
    GltfGeometry(const std::string& path, const RandomAccessFile& file, const GlbDocument& document,
                 const SourceOptions& options);

    /// Elements of one type of number, all within their file.
    struct Elements {
        const RandomAccessFile* file = nullptr; ///< null: `temporary`; both null: all zeros
        const TemporaryFile* temporary = nullptr;
        std::uint64_t at = 0, count = 0, stride = 0;
        std::uint16_t component = 0;
        std::uint8_t components = 0;
        bool is_normalized = false;
        std::shared_ptr<const std::array<Elements, 2>> sparse; ///< indices and values
    };

    /// Errors      Fault malformed, unsupported.
    [[nodiscard]] Elements positions(const GlbDocument::Primitive& primitive) const;
    /// Empty if the primitive has no indices.
    [[nodiscard]] std::optional<Elements> indices(const GlbDocument::Primitive& primitive) const;
    /// Returns the elements of an accessor. Throws if the number of components differs.
    [[nodiscard]] Elements values(std::uint32_t accessor, std::uint8_t components) const;

    /// Reads numbers, one element after the other. A normalised integer becomes the quotient that
    /// glTF defines, rounded to double and, for floats, then to float.
    ///
    /// In          to: one number for each component.
    static void read(const Elements& elements, std::uint64_t first, std::span<float> to);
    static void read(const Elements& elements, std::uint64_t first, std::span<double> to);
    /// Reads elements that are unsigned integers of one component.
    static void read(const Elements& elements, std::uint64_t first, std::span<std::uint32_t> to);

private:
    struct Place;
    struct DecodedPrimitive {
        std::uint64_t positions = 0, corners = 0;
    };

    void decode(const std::string& path, const SourceOptions& options);
    [[nodiscard]] bool is_decoded_view(const GlbDocument::View& view) const;
    [[nodiscard]] bool is_decoded_primitive(const GlbDocument::Primitive& primitive) const;
    [[nodiscard]] const GlbDocument::Accessor& accessor(std::uint32_t index) const;
    [[nodiscard]] const GlbDocument::View& view(std::uint32_t index) const;
    [[nodiscard]] Place place(std::uint32_t buffer, std::uint64_t offset,
                              std::uint64_t bytes) const;
    /// Returns elements of a view; zeros if it is GlbDocument::kNone.
    [[nodiscard]] Elements elements(std::uint32_t view, std::uint64_t offset, std::uint64_t count,
                                    std::uint16_t component, std::uint8_t components) const;
    [[nodiscard]] Elements elements(const GlbDocument::Accessor& accessor) const;

    const RandomAccessFile& file_;
    const GlbDocument& document_;
    std::vector<std::unique_ptr<RandomAccessFile>> companions_;
    std::unique_ptr<TemporaryFile> decoded_;  ///< null if nothing is compressed
    std::vector<std::uint64_t> decoded_view_; ///< position in decoded_, by GlbDocument::compressed
    std::vector<DecodedPrimitive> decoded_draco_; ///< by GlbDocument::draco
};

} // namespace abut
