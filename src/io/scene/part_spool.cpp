#include "io/scene/part_spool.h"

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
    record.has_colour = part.colour ? 1 : 0;
    record.colour = part.colour.value_or(Colour());
    record_writer_.append(&record, sizeof record);
    for (const std::string* text : {&part.id, &part.name, &part.type})
        text_writer_.append(text->data(), text->size());
    ++count_;
}

void PartSpool::finish() {
    record_writer_.flush();
    text_writer_.flush();
}

template <typename Reader>
PartSpool::Record PartSpool::read_record(Reader& records, std::uint64_t number) {
    Record record;
    records.read(number * sizeof record, std::as_writable_bytes(std::span(&record, 1)));
    return record;
}

Part PartSpool::placement_of(const Record& record) {
    Part part;
    part.mesh = record.mesh;
    part.world_from_mesh = record.world_from_mesh;
    if (record.has_colour != 0)
        part.colour = record.colour;
    return part;
}

template <typename Reader>
Part PartSpool::read_part(Reader& records, Reader& texts, std::uint64_t number) {
    const Record record = read_record(records, number);
    Part part = placement_of(record);
    std::string text(std::size_t{record.id_size} + record.name_size + record.type_size, '\0');
    texts.read(record.text, std::as_writable_bytes(std::span(text)));
    part.id = text.substr(0, record.id_size);
    part.name = text.substr(record.id_size, record.name_size);
    part.type = text.substr(std::size_t{record.id_size} + record.name_size);
    return part;
}

Part PartSpool::placement(std::uint64_t number) const {
    return placement_of(read_record(records_, number));
}

Part PartSpool::part(std::uint64_t number) const {
    return read_part(records_, texts_, number);
}

Part PartSpool::Cursor::placement(std::uint64_t number) {
    return placement_of(read_record(records_, number));
}

Part PartSpool::Cursor::part(std::uint64_t number) {
    return read_part(records_, texts_, number);
}

} // namespace abut
