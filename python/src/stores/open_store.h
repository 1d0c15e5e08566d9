#pragma once

#include <abut/store.h>

#include "support/python.h"

#include <optional>

namespace abut::python {

/// A store that can be closed. A query that runs keeps the file open until it ends.
struct OpenStore {
    std::string path;
    std::optional<Store> store;

    [[nodiscard]] Store get() const {
        if (!store)
            throw py::value_error("the store " + path + " is closed");
        return *store;
    }
};

} // namespace abut::python
