#pragma once

#include <abut/clash.h>

#include "clash/building/building_source.h"

#include <string>
#include <vector>

namespace abut {

/// Writes the page of a report.
///
/// In          building: the geometry; null for a page without 3D.
/// Errors      those of write_clash_html and of the source.
void write_clash_page(const ClashReport& report, const std::vector<Scene>& models,
                      const BuildingSource* building, const std::string& path,
                      const ClashPageOptions& options);

} // namespace abut
