#pragma once

#include <string_view>

/// The sources of the report page in src/clash/report/page, embedded by the build.
namespace abut::report_page {

/// Contains the markers @STYLE@, @DATA@, @SCRIPT@ and @BUILDING@, once each and in this order. Its
/// Content-Security-Policy names the hashes of the style and the scripts.
extern const std::string_view html;
extern const std::string_view style;
extern const std::string_view script;
/// The 3D view: three.js and page/scene in one script. Empty if the build had no npm modules.
extern const std::string_view scene;

} // namespace abut::report_page
