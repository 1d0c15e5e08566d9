#pragma once

#include <abut/picture.h>

#include <cstdint>
#include <memory>
#include <vector>

namespace abut {

/// A part with its place. `mesh` numbers the meshes of the model.
struct PicturePart {
    ViewPart view;
    std::int64_t mesh = 0;
    Transform world_from_mesh;
};

/// What is drawn: models in memory, or a store.
class PictureModel {
public:
    virtual ~PictureModel() = default;
    /// Returns a mesh. May be called from any thread.
    [[nodiscard]] virtual std::shared_ptr<const Mesh> mesh(std::int64_t number) const = 0;
    /// The colours of `parts`.
    [[nodiscard]] virtual std::vector<Colour> colours(ColourBy by) const = 0;

    std::vector<PicturePart> parts;
    Box3 bounds; ///< of all parts, world
    UpAxis up = UpAxis::y;
};

std::unique_ptr<PictureModel> picture_model(const std::vector<Scene>& models);
std::unique_ptr<PictureModel> picture_model(const Store& store);

/// Returns the number of the part with an id, or else with a name.
///
/// In          file: if not empty, the part belongs to this file.
/// Errors      Error{bad_argument} if there is none, or several.
std::uint32_t find_part(const PictureModel& model, const std::string& file,
                        const std::string& part);

} // namespace abut
