#pragma once

#include "core/temporary_file.h"
#include "io/file/random_access_file.h"
#include "io/gltf/glb_document.h"
#include "io/gltf/gltf_elements.h"
#include "io/scene/scene_source.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace abut {

/// The numbers behind a glTF document's accessors, wherever they lie: in the file, in companions,
/// in data: URIs, compressed. Reading is possible from any thread.
class GltfGeometry {
public:
    /// Opens the companions, and has what is compressed decoded into a temporary file.
    ///
    /// In          file: the model's; document and file must outlive this.
    /// Errors      Fault: malformed; unsupported, also for a companion outside of the model's folder
    ///             unless options.read.allow_outside_files. Error of the decoder's process.
    /// Cost        the decoder's process holds one compressed buffer view, or one primitive of
    ///             Draco's, at a time.
    GltfGeometry(const std::string& path, const RandomAccessFile& file, const GlbDocument& document,
                 const SourceOptions& options);

    /// Errors      Fault malformed, unsupported.
    [[nodiscard]] GltfElements positions(const GlbDocument::Primitive& primitive) const;
    /// Empty if the primitive has no indices.
    [[nodiscard]] std::optional<GltfElements>
    indices(const GlbDocument::Primitive& primitive) const;
    /// The elements of an accessor. Throws if it has another number of components.
    [[nodiscard]] GltfElements values(std::uint32_t accessor, std::uint8_t components) const;

private:
    /// Bytes in a file.
    struct Place {
        const RandomAccessFile* file = nullptr; ///< else `temporary`
        const TemporaryFile* temporary = nullptr;
        std::uint64_t at = 0;
    };
    struct DecodedPrimitive {
        std::uint64_t positions = 0, corners = 0;
    };

    class Decoding;

    void decode(const std::string& path, const SourceOptions& options);
    [[nodiscard]] bool is_decoded_view(const GlbDocument::View& view) const;
    [[nodiscard]] bool is_decoded_primitive(const GlbDocument::Primitive& primitive) const;
    [[nodiscard]] const GlbDocument::Accessor& accessor(std::uint32_t index) const;
    [[nodiscard]] const GlbDocument::View& view(std::uint32_t index) const;
    [[nodiscard]] Place place(std::uint32_t buffer, std::uint64_t offset,
                              std::uint64_t bytes) const;
    /// The elements of a view; zeros if it is GlbDocument::kNone.
    [[nodiscard]] GltfElements elements(std::uint32_t view, std::uint64_t offset,
                                        std::uint64_t count, std::uint16_t component,
                                        std::uint8_t components) const;
    [[nodiscard]] GltfElements elements(const GlbDocument::Accessor& accessor) const;

    const RandomAccessFile& file_;
    const GlbDocument& document_;
    std::vector<std::unique_ptr<RandomAccessFile>> companions_;
    std::unique_ptr<TemporaryFile> decoded_;      ///< none if nothing is compressed
    std::vector<std::uint64_t> decoded_view_;     ///< by GlbDocument::compressed: place in decoded_
    std::vector<DecodedPrimitive> decoded_draco_; ///< by GlbDocument::draco
};

} // namespace abut
