#include "io/scene/part_spool.h"

#include <abut/error.h>

#include <array>
#include <cstring>
#include <limits>

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

void PartSpool::append(const Part& part, std::span<const PartProperty> properties) {
    Record record;
    record.world_from_mesh = part.world_from_mesh;
    record.text = text_writer_.end();
    record.mesh = part.mesh;
    record.id_size = checked_size(part.id);
    record.name_size = checked_size(part.name);
    record.type_size = checked_size(part.type);
    record.has_colour = part.colour ? 1 : 0;
    record.colour = part.colour.value_or(Colour());
    record.properties = static_cast<std::uint32_t>(properties.size());
    for (const auto& [name, value] : properties)
        record.property_bytes += 2 * sizeof(std::uint32_t) + name.size() + value.size();
    record_writer_.append(&record, sizeof record);
    for (const std::string* text : {&part.id, &part.name, &part.type})
        text_writer_.append(text->data(), text->size());
    for (const auto& [name, value] : properties) {
        const std::array<std::uint32_t, 2> sizes{checked_size(name), checked_size(value)};
        text_writer_.append(sizes.data(), sizeof sizes);
        text_writer_.append(name.data(), name.size());
        text_writer_.append(value.data(), value.size());
    }
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

template <typename Reader>
std::vector<PartProperty> PartSpool::read_properties(Reader& records, Reader& texts,
                                                     std::uint64_t number) {
    const Record record = read_record(records, number);
    std::string bytes(record.property_bytes, '\0');
    if (!bytes.empty())
        texts.read(record.text + record.id_size + record.name_size + record.type_size,
                   std::as_writable_bytes(std::span(bytes)));
    std::vector<PartProperty> properties;
    properties.reserve(record.properties);
    std::size_t at = 0;
    for (std::uint32_t i = 0; i < record.properties; ++i) {
        std::array<std::uint32_t, 2> sizes{};
        std::memcpy(sizes.data(), bytes.data() + at, sizeof sizes);
        at += sizeof sizes;
        properties.push_back({bytes.substr(at, sizes[0]), bytes.substr(at + sizes[0], sizes[1])});
        at += std::size_t{sizes[0]} + sizes[1];
    }
    return properties;
}

Part PartSpool::placement(std::uint64_t number) const {
    return placement_of(read_record(records_, number));
}

Part PartSpool::part(std::uint64_t number) const {
    return read_part(records_, texts_, number);
}

std::vector<PartProperty> PartSpool::properties(std::uint64_t number) const {
    return read_properties(records_, texts_, number);
}

Part PartSpool::Cursor::placement(std::uint64_t number) {
    return placement_of(read_record(records_, number));
}

Part PartSpool::Cursor::part(std::uint64_t number) {
    return read_part(records_, texts_, number);
}

std::vector<PartProperty> PartSpool::Cursor::properties(std::uint64_t number) {
    return read_properties(records_, texts_, number);
}

} // namespace abut
