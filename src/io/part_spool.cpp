#include "io/part_spool.h"

#include <abut/error.h>

#include <limits>
#include <span>

namespace abut {

namespace {

std::uint32_t checked_size(const std::string& text) {
    if (text.size() > std::numeric_limits<std::uint32_t>::max())
        throw Error(ErrorCode::bad_argument, "a part's text is too long");
    return static_cast<std::uint32_t>(text.size());
}

} // namespace

PartSpool::PartSpool(const std::string& folder)
    : records_(folder), texts_(folder), record_writer_(records_), text_writer_(texts_) {}

void PartSpool::append(const Part& part) {
    Record record;
    record.world_from_mesh = part.world_from_mesh;
    record.text = text_writer_.end();
    record.mesh = part.mesh;
    record.id_size = checked_size(part.id);
    record.name_size = checked_size(part.name);
    record.type_size = checked_size(part.type);
    record_writer_.append(&record, sizeof record);
    for (const std::string* text : {&part.id, &part.name, &part.type})
        text_writer_.append(text->data(), text->size());
    ++count_;
}

void PartSpool::finish() {
    record_writer_.flush();
    text_writer_.flush();
}

PartSpool::Record PartSpool::record(std::uint64_t number) const {
    Record record;
    records_.read(number * sizeof record, std::as_writable_bytes(std::span(&record, 1)));
    return record;
}

Part PartSpool::placement(std::uint64_t number) const {
    const Record found = record(number);
    Part part;
    part.mesh = found.mesh;
    part.world_from_mesh = found.world_from_mesh;
    return part;
}

Part PartSpool::part(std::uint64_t number) const {
    const Record found = record(number);
    Part part;
    part.mesh = found.mesh;
    part.world_from_mesh = found.world_from_mesh;
    std::string texts(std::size_t{found.id_size} + found.name_size + found.type_size, '\0');
    texts_.read(found.text, std::as_writable_bytes(std::span(texts)));
    part.id = texts.substr(0, found.id_size);
    part.name = texts.substr(found.id_size, found.name_size);
    part.type = texts.substr(std::size_t{found.id_size} + found.name_size);
    return part;
}

} // namespace abut
