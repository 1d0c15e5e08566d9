#pragma once

#include <abut/clash.h>
#include <abut/clash_viewpoint.h>
#include <abut/progress.h>
#include <abut/renderer.h>
#include <abut/scene.h>
#include <abut/store.h>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

/// Pictures of models without a window: for documents, reports and snapshots. They belong to the
/// library target Abut::render. docs/viewer.md shows some.
namespace abut {

/// Directions from which a whole model is seen. Front is the side towards the viewer of the frames
/// that UpAxis describes.
enum class NamedView : std::uint8_t { iso, front, back, left, right, top, bottom };
inline constexpr std::array kNamedViews{NamedView::iso,   NamedView::front, NamedView::back,
                                        NamedView::left,  NamedView::right, NamedView::top,
                                        NamedView::bottom};
/// "iso", "front", "back", "left", "right", "top", "bottom".
const char* to_string(NamedView view);

/// One part in its colour, filling the picture; all others are ghosts.
struct PartAim {
    std::string part; ///< its id or, if no part has that id, its name
};

/// A pair of parts in red and blue, seen from where most of both shows; all others are ghosts. If
/// one of them is inside the other, a section plane opens it.
struct PairAim {
    std::array<std::string, 2> file, part; ///< ids, as a clash report has them
    /// Points of both surfaces that the picture is about; if none, they are computed.
    std::optional<std::array<Vec3, 2>> points;
};

/// Two sets of parts in red and blue, as a camera sees them. The parts around them are ghosts; no
/// other part is drawn.
struct SidesAim {
    Camera camera; ///< its size is ignored
    std::array<std::vector<NamedPart>, 2> sides;
    std::vector<NamedPart> around;
};

/// What parts take their colours from.
enum class ColourBy : std::uint8_t {
    material, ///< the file's materials; of parts without one, as `type`
    type,
    file,
    part,
    storey, ///< the property `storey`; grey without one
    clash,  ///< the worst kind of the part's clashes in the store's last jobs; grey without one
};
inline constexpr std::array kColourings{ColourBy::material, ColourBy::type,   ColourBy::file,
                                        ColourBy::part,     ColourBy::storey, ColourBy::clash};
/// "material", "type", "file", "part", "storey", "clash".
const char* to_string(ColourBy by);

/// Returns the colours of parts. Equal words get equal colours, in every model. By `storey` and by
/// `clash`, all are grey: a ViewPart does not state them. The functions below know them.
std::vector<Colour> part_colours(std::span<const ViewPart> parts, ColourBy by);

/// The colours of all parts of a store or of models, with a legend.
struct PartColouring {
    struct Group {
        std::string word; ///< a type, a file, a storey, a kind of clash, or "none"
        Colour colour;
        std::uint64_t parts = 0;
    };
    std::vector<Colour> colours;       ///< in the order of View::parts(), or model by model
    std::vector<std::uint32_t> groups; ///< of each part, its index in `legend`
    /// By `type`, `file`, `storey` and `clash`, the largest group first; otherwise empty.
    std::vector<Group> legend;
};
/// Errors      those of the store.
PartColouring part_colouring(const Store& store, ColourBy by);
/// The colours alone.
std::vector<Colour> part_colours(const Store& store, ColourBy by);
/// As above, of models in memory.
///
/// Errors      Error{bad_argument} for `clash`: only a store keeps clashes.
PartColouring part_colouring(const std::vector<Scene>& models, ColourBy by);
std::vector<Colour> part_colours(const std::vector<Scene>& models, ColourBy by);

/// Surfaces are coloured by their exact distance from a part, up to `reach`; see DistanceColours.
struct PartDistances {
    std::string part; ///< its id or, if no part has that id, its name
    double reach = 1;
};

struct PictureOptions {
    /// The picture shows the whole model from a side, or what a camera sees (its size is ignored),
    /// or one part, a pair of parts, or two sets of parts.
    std::variant<NamedView, Camera, PartAim, PairAim, SidesAim> aim = NamedView::iso;
    std::uint32_t width = 1600, height = 1000; ///< pixels; at most 8192
    ColourBy colour_by = ColourBy::material;
    std::uint32_t samples = 2; ///< along each side of a pixel: 1, 2 or 4
    bool edges = true, ambient_occlusion = true, ground = true;
    std::vector<SectionPlane> sections; ///< at most 6: kMostSections, less one that opens a part
    std::optional<Box3> section_box;
    std::optional<PartDistances> distances;
    Progress progress{};
};

/// Draws parts at full detail. Models whose axes differ from the first model's are turned.
///
/// Errors      Error{unsupported} if EGL or OpenGL 3.3 is not available; Error{bad_argument} if the
///             options are not valid, no part or several have the given id, or the colours are by
///             clash; Error{interrupted}.
/// Cost        memory for the geometry of a few thousand parts at a time, beside the models.
Picture picture(const std::vector<Scene>& models, const PictureOptions& options = {});
/// As above, of a store. Reads only the parts that the camera may see. Knows colours by clash.
///
/// Errors      as above; those of the store.
Picture picture(const Store& store, const PictureOptions& options = {});

struct PictureStudio;

/// Makes several pictures of the same models. The context, the shaders and the list of parts are
/// made once, which is most of the time of a small picture.
class PictureMaker {
public:
    /// In          models: must outlive the maker.
    /// Errors      Error{unsupported} if EGL or OpenGL 3.3 is not available; those of the store.
    explicit PictureMaker(const std::vector<Scene>& models);
    explicit PictureMaker(const Store& store);
    ~PictureMaker();
    PictureMaker(const PictureMaker&) = delete;
    PictureMaker& operator=(const PictureMaker&) = delete;

    /// As `picture`, with the same result.
    Picture make(const PictureOptions& options = {});

private:
    std::unique_ptr<PictureStudio> studio_;
};

/// Returns a picture as the bytes of a PNG file.
///
/// Errors      Error{bad_argument} if the picture has no pixels.
std::string png_bytes(const Picture& picture);
/// Writes a picture as PNG, atomically.
///
/// Errors      as png_bytes; Error{cannot_write}, naming the file.
void write_png(const Picture& picture, const std::string& path);

} // namespace abut
