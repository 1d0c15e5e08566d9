#pragma once

#include "rigid/pair/contacts.h"
#include "rigid/solid/world_solid.h"

#include <cstdint>

namespace abut {

/// Tells contacts of two solids from those of faces that lie inside their own solid, as where shells
/// overlap (SolidBoundary).
class OuterContacts {
public:
    /// In          a, b: they outlive this. Solids in blocks know the triangles in contact.
    OuterContacts(const WorldSolid& a, const WorldSolid& b) : a_(a), b_(b) {}

    /// Whether every contact is one.
    [[nodiscard]] bool are_all() const {
        return a_.boundary() == nullptr && b_.boundary() == nullptr;
    }
    /// Returns whether the parts of both triangles that lie on the boundaries of their solids are no
    /// farther apart than rounding.
    ///
    /// Accuracy    exact for faces that are not cut by others of their solid.
    [[nodiscard]] bool holds(const TrianglePair& pair) const;

private:
    const WorldSolid &a_, &b_;
};

} // namespace abut
