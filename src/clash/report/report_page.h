#pragma once

#include <string_view>

/// The sources of the report page in src/clash/report/page, embedded by the build.
namespace abut::report_page {

/// Contains the markers @STYLE@, @DATA@ and @SCRIPT@, once each and in this order.
extern const std::string_view html;
extern const std::string_view style;
extern const std::string_view script;

} // namespace abut::report_page
