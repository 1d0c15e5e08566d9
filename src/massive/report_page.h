#pragma once

#include <string_view>

/// The sources of the report page, src/massive/report/*, as the build embedded them.
namespace abut::report_page {

/// Holds @STYLE@, @DATA@ and @SCRIPT@, once each and in this order.
extern const std::string_view html;
extern const std::string_view style;
extern const std::string_view script;

} // namespace abut::report_page
