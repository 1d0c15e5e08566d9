#include "rigid/solid/prepared_faces.h"

namespace abut {

void PreparedFaces::make_room() {
    if (faces_.size() >= kMost) {
        faces_.clear();
        table_.assign(table_.size(), {});
        return;
    }
    const std::vector<Entry> before = std::move(table_);
    table_.assign(before.empty() ? 64 : 2 * before.size(), {});
    faces_.reserve(table_.size() / 2);
    for (const Entry& entry : before) {
        if (entry.face == 0)
            continue;
        std::size_t at = place(entry.slot);
        while (table_[at].face != 0)
            at = (at + 1) & (table_.size() - 1);
        table_[at] = entry;
    }
}

} // namespace abut
