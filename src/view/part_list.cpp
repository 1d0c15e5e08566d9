#include "view/part_list.h"

#include "core/arguments.h"
#include "core/stop_watch.h"

#include <algorithm>
#include <string_view>

namespace abut {

namespace {

char small_letter(char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

/// In          sought: of small letters.
bool contains_text(std::string_view text, std::string_view sought) {
    return !std::ranges::search(text, sought, {}, small_letter).empty() || sought.empty();
}

} // namespace

PartList::PartList(StoreFile& store, std::span<const std::int64_t> numbers)
    : store_(&store), numbers_(numbers) {
    for (const ModelRow& model : store.models())
        files_[model.model] = model.file;
}

std::optional<std::uint32_t> PartList::index_of(std::int64_t number) const {
    const auto at = std::ranges::lower_bound(numbers_, number);
    if (at == numbers_.end() || *at != number)
        return std::nullopt;
    return static_cast<std::uint32_t>(at - numbers_.begin());
}

ViewPart PartList::part(std::uint32_t index) const {
    require(index < numbers_.size(), "there is no part " + std::to_string(index));
    const PartRow row = store_->part(numbers_[index]);
    const auto file = files_.find(row.model);
    ViewPart part;
    part.number = row.part;
    part.file = file == files_.end() ? "" : file->second;
    part.id = row.id, part.name = row.name, part.type = row.type;
    part.box = row.box;
    return part;
}

FoundParts PartList::find(const std::string& text, std::size_t most, std::uint32_t from,
                          double seconds) const {
    constexpr std::uint32_t kRowsBetweenLooks = 64;
    FoundParts found;
    found.next = static_cast<std::uint32_t>(numbers_.size());
    if (from >= numbers_.size() || most == 0) {
        found.next = std::min(from, found.next);
        return found;
    }
    std::string sought = text;
    std::ranges::transform(sought, sought.begin(), small_letter);
    const StopWatch watch;
    store_->with_connection([&](Database& database) {
        Statement rows(database, "SELECT part, id, name, type FROM part WHERE part >= ? "
                                 "ORDER BY part");
        rows.bind(numbers_[from]);
        for (std::uint32_t compared = 1; rows.step(); ++compared) {
            const auto index = index_of(rows.integer(0));
            if (!index)
                continue;
            if (found.parts.size() == most ||
                (compared % kRowsBetweenLooks == 0 && watch.seconds() > seconds)) {
                found.next = *index;
                break;
            }
            if (contains_text(rows.text(1), sought) || contains_text(rows.text(2), sought) ||
                contains_text(rows.text(3), sought))
                found.parts.push_back(*index);
        }
    });
    return found;
}

} // namespace abut
