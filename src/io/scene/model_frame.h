#pragma once

#include <abut/scene.h>

#include <optional>

namespace abut {

/// The unit and axes of a file's coordinates as its format gives them.
struct FormatFrame {
    double unit = 0;            ///< metres per unit; 0: the format has none
    std::optional<UpAxis> up{}; ///< none: the format does not say it
};

inline constexpr FormatFrame kGltfFrame{1, UpAxis::y};

/// The unit and axes that a file's coordinates are taken in.
struct ModelFrame {
    double unit = 1;
    UpAxis up = UpAxis::z;
};

/// The unit and axes of a file. The path overrules the format, which overrules the options.
ModelFrame model_frame(const FormatFrame& format, const ModelPath& path,
                       const ReadOptions& options);

/// By how much coordinates are multiplied that a reader gives as `applied` metres.
///
/// In          applied: metres per coordinate if the format's own unit holds. A reader that applies the
///             file's unit itself gives metres: 1; one that does not: the unit.
double scale_of(const FormatFrame& format, double applied, const ModelFrame& frame);

/// A transform into a world in which `from` points up, after the quarter turns that make it `to`.
/// Exact. Zeros have no sign then.
Transform turned(const Transform& world_from_mesh, UpAxis from, UpAxis to);

/// Multiplies by a unit: each entry is rounded once.
void scale(Transform& world_from_mesh, double factor);

} // namespace abut
