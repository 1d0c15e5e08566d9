#pragma once

#include <abut/scene.h>

#include <optional>

namespace abut {

/// The unit and up axis of a file's coordinates, as its format defines them.
struct FormatFrame {
    double unit = 0;            ///< metres per unit; 0: the format defines none
    std::optional<UpAxis> up{}; ///< none: the format defines none
};

inline constexpr FormatFrame kGltfFrame{1, UpAxis::y};

/// The unit and up axis that are used for a file's coordinates.
struct ModelFrame {
    double unit = 1;
    UpAxis up = UpAxis::z;
};

/// Chooses the unit and up axis: those of the path, else of the format, else of the options.
ModelFrame model_frame(const FormatFrame& format, const ModelPath& path,
                       const ReadOptions& options);

/// Returns the factor for coordinates that a reader gives in `applied` metres.
///
/// In          applied: metres per coordinate if the format's own unit is used. It is 1 for a
///             reader that applies the file's unit itself, and the unit for one that does not.
double scale_of(const FormatFrame& format, double applied, const ModelFrame& frame);

/// Returns the transform into a world in which `from` is up, followed by the quarter turns that
/// make `to` up. Exact; zeros lose their sign.
Transform turned(const Transform& world_from_mesh, UpAxis from, UpAxis to);

/// Multiplies a transform by a unit; each entry is rounded once.
void scale(Transform& world_from_mesh, double factor);

} // namespace abut
