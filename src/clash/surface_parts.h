#pragma once

#include <abut/clash.h>
#include <abut/scene.h>

#include "clash/part_instances.h"

#include <vector>

namespace abut {

/// Finds the parts whose surface bounds no solid. Parts without triangles are not counted.
///
/// Cost        O(n) for meshes without a border, O(n log n) for others; each mesh once, in parallel.
ClashReport::Surfaces surface_parts(const std::vector<Scene>& models, const PartInstances& parts);

} // namespace abut
