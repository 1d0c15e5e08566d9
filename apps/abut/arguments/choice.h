#pragma once

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <string>
#include <vector>

/// Options whose value is one of several words.
namespace abut::command {

template <typename Value>
struct Named {
    const char* name;
    Value value;
};

/// Returns the word for a value.
/// In          value: one of the choices.
template <typename Value, std::size_t kCount>
const char* name_of(Value value, const std::array<Named<Value>, kCount>& choices) {
    return std::find_if(choices.begin(), choices.end(),
                        [&](const Named<Value>& choice) { return choice.value == value; })
        ->name;
}

/// Declares an option whose word sets `value`. The current `value` is the default.
template <typename Value, std::size_t kCount>
void add_choice(CLI::App& app, const std::string& option, Value& value,
                const std::array<Named<Value>, kCount>& choices, const std::string& description) {
    std::vector<std::string> names;
    for (const Named<Value>& choice : choices)
        names.emplace_back(choice.name);
    const auto set = [&value, choices](const std::string& name) {
        for (const Named<Value>& choice : choices)
            if (name == choice.name)
                value = choice.value;
    };
    app.add_option_function<std::string>(option, set, description)
        ->check(CLI::IsMember(names))
        ->default_str(name_of(value, choices));
}

} // namespace abut::command
