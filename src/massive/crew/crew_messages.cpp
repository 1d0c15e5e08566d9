#include "massive/crew/crew_messages.h"

#include "massive/crew/message_bytes.h"

#include <concepts>
#include <stdexcept>
#include <utility>

namespace abut {

/// Value is Struct when a message is read, const Struct when it is written.
template <typename Value, typename Struct>
concept Either = std::same_as<std::remove_const_t<Value>, Struct>;

template <typename Stream>
void fields(Stream& stream, Either<Task::Terms> auto& terms) {
    stream(terms.numbers, terms.rule, terms.severity);
}

template <typename Stream>
void fields(Stream& stream, Either<Briefing> auto& briefing) {
    stream(briefing.budget, briefing.blocks_budget, briefing.models);
}

template <typename Stream>
void fields(Stream& stream, Either<Task> auto& task) {
    stream(task.unit, task.alone, task.meshes, task.large, task.parts, task.pairs, task.terms,
           task.large_pairs);
}

template <typename Stream>
void fields(Stream& /*stream*/, Either<NoMoreWork> auto& /*nothing*/) {}

template <typename Stream>
void fields(Stream& stream, Either<TaskResult::Found> auto& found) {
    auto& clash = found.clash;
    stream(found.pair, clash.id, clash.kind, clash.distance, clash.point_a, clash.point_b,
           clash.direction, clash.triangle_pairs, clash.rule, clash.severity, clash.volume,
           clash.volume_error, clash.neighbours, found.left_out);
}

template <typename Stream>
void fields(Stream& stream, Either<TaskResult::Named> auto& named) {
    stream(named.row, named.part.id, named.part.name, named.part.type);
}

template <typename Stream>
void fields(Stream& stream, Either<TaskResult> auto& result) {
    stream(result.unit, result.pairs, result.clashes, result.named, result.worker);
}

template <typename Stream>
void fields(Stream& stream, Either<Failure> auto& failure) {
    stream(failure.is_error, failure.code, failure.file, failure.text);
}

Failure Failure::of(const std::exception& exception) {
    const auto* const error = dynamic_cast<const Error*>(&exception);
    if (error == nullptr)
        return {false, {}, {}, exception.what()};
    const std::string text = error->what();
    const std::string& file = error->file();
    return {true, error->code(), file, file.empty() ? text : text.substr(file.size() + 2)};
}

void Failure::rethrow() const {
    if (!is_error)
        throw std::runtime_error(text);
    if (file.empty())
        throw Error(code, text);
    throw Error(code, file, text);
}

std::vector<std::byte> encode(const CrewMessage& message) {
    MessageWriter writer;
    writer(static_cast<std::uint8_t>(message.index()));
    std::visit([&](const auto& content) { writer(content); }, message);
    return writer.take();
}

namespace {

/// Returns a message that holds the alternative with that index.
template <std::size_t... I>
CrewMessage make(std::size_t index, std::index_sequence<I...>) {
    CrewMessage message;
    ((index == I ? void(message.emplace<I>()) : void()), ...);
    return message;
}

} // namespace

CrewMessage decode(const std::vector<std::byte>& bytes) {
    MessageReader reader(bytes);
    std::uint8_t index = 0;
    reader(index);
    if (index >= std::variant_size_v<CrewMessage>)
        throw std::length_error("a message of an unknown kind");
    CrewMessage message = make(index, std::make_index_sequence<std::variant_size_v<CrewMessage>>());
    std::visit([&](auto& content) { reader(content); }, message);
    return message;
}

} // namespace abut
