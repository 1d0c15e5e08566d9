#pragma once

#include "support/arguments.h"
#include "support/work.h"

#include <optional>

namespace abut::python {

/// A warm start as Python keeps it: one query at a time may use it.
template <class T>
struct Warm {
    T value;
    InUse use;
};

/// The warm start that a query is given, for as long as it runs.
template <class T>
class WarmArgument {
public:
    WarmArgument(const Arguments& arguments, std::size_t place) {
        if (!arguments.has(place))
            return;
        auto& warm = abut::python::get<Warm<T>>(arguments[place], "warm_start");
        change_.emplace(warm.use, "the warm start");
        value_ = &warm.value;
    }
    [[nodiscard]] T* get() const noexcept { return value_; }

private:
    std::optional<InUse::Change> change_;
    T* value_ = nullptr;
};

} // namespace abut::python
