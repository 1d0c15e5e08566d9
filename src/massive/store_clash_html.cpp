#include <abut/store_clash.h>

#include "clash/report/clash_page.h"
#include "massive/store_building.h"

namespace abut {

void write_clash_html(const StoreClashReport& found, const Store& store, const std::string& path,
                      const ClashPageOptions& options) {
    if (options.building_bytes == 0 || found.report.clashes.empty())
        return write_clash_page(found.report, found.models, nullptr, path, options);
    const StoreBuilding building(found, store.file());
    write_clash_page(found.report, found.models, &building, path, options);
}

} // namespace abut
