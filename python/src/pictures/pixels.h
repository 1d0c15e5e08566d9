#pragma once

#include <abut/renderer.h>

#include "support/python.h"

#include <stdexcept>
#include <string>
#include <thread>

namespace abut::python {

/// The rows of a picture as an array of shape (height, width, 3).
py::array to_pixels(Picture picture);
/// Errors      TypeError, ValueError.
Picture from_pixels(const py::object& object);

/// The thread that an object with a context of OpenGL belongs to: the one that made it.
class OwnThread {
public:
    [[nodiscard]] bool is_this() const { return std::this_thread::get_id() == id_; }
    void require(const char* what) const {
        if (!is_this())
            throw std::runtime_error(std::string(what) + " belongs to the thread that made it");
    }

private:
    std::thread::id id_ = std::this_thread::get_id();
};

} // namespace abut::python
