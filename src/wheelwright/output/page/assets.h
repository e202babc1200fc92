#pragma once

#include <string_view>

/// Files of the pages that are compiled into the library: those of output/page/assets, and the system's
/// libraries for charts and lit surfaces.
namespace wheelwright::assets {

extern const std::string_view report_html, report_css, report_js, formats_js, parts_js, watch_html, watch_css,
    watch_js, stage_js, designs_html, designs_css, designs_js, chart_js, three_js;

}  // namespace wheelwright::assets
