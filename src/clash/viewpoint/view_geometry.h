#pragma once

#include <abut/clash_viewpoint.h>
#include <abut/scene.h>
#include <abut/store.h>

#include "math/vector.h"
#include "store/database/schema.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace abut {

/// All parts among which clashes are looked at, and their triangles. May be used from any thread.
class ViewGeometry {
public:
    virtual ~ViewGeometry() = default;

    /// Appends the triangles of a part that meet a box, in the world.
    virtual void gather(std::uint32_t part, const Box3& box,
                        std::vector<Triangle>& triangles) const = 0;
    [[nodiscard]] virtual NamedPart name(std::uint32_t part) const = 0;
    /// Returns the number of the part that a clash refers to.
    ///
    /// Errors      Error{bad_argument} if there is none.
    [[nodiscard]] virtual std::uint32_t number(const ReportPart& part) const = 0;

    std::vector<Box3> boxes; ///< of each part, world
    UpAxis up = UpAxis::y;
};

/// In          models: must outlive the result.
std::unique_ptr<ViewGeometry> view_geometry(const std::vector<Scene>& models);
/// In          models: those of a job's report, whose parts clashes refer to.
std::unique_ptr<ViewGeometry> view_geometry(const Store& store, const std::vector<Scene>& models);

/// A part of a store, with its place among the store's models and the parts of its model.
struct ViewedPart {
    ReportPart place;
    PartRow row;
};
/// A store, and the parts that were asked for, which `number` knows by their places.
struct NamedGeometry {
    std::unique_ptr<ViewGeometry> geometry;
    std::vector<ViewedPart> parts;
};
/// Errors      Error{bad_argument} if the store lacks one of the parts.
NamedGeometry view_geometry(const Store& store, std::span<const NamedPart> parts);

} // namespace abut
