#include "rigid/solid/containment.h"

#include <algorithm>

namespace abut {

namespace {

bool inside(const PlacedSolid& inner, std::uint32_t triangle, const PlacedSolid& outer) {
    return outer.winds_around(
        inner.model().world_vertex(inner.model().data().mesh().triangles[triangle][0]));
}

} // namespace

std::vector<bool> contained_triangles(const PlacedSolid& inner, const PlacedSolid& outer,
                                      const std::vector<std::uint32_t>& touched) {
    const Solid& solid = inner.solid();
    const auto& triangles = inner.model().data().mesh().triangles;
    if (!outer.solid().solid || (solid.components.size() == 1 && !touched.empty()))
        return {};
    if (touched.empty() && !any_component_inside(inner, outer))
        return {};
    const std::vector<std::uint32_t> component =
        vertex_components(inner.model().data().mesh(), solid.topology);
    enum class State : std::uint8_t { apart, meets, contained };
    std::vector<State> state(component.size(), State::apart);
    for (const std::uint32_t t : touched)
        state[component[triangles[t][0]]] = State::meets;
    bool any = false;
    for (const std::uint32_t t : solid.components)
        if (State& s = state[component[triangles[t][0]]];
            s == State::apart && inside(inner, t, outer)) {
            s = State::contained;
            any = true;
        }
    std::vector<bool> result(any ? triangles.size() : 0);
    for (std::size_t t = 0; t < result.size(); ++t)
        result[t] = state[component[triangles[t][0]]] == State::contained;
    return result;
}

bool any_component_inside(const PlacedSolid& inner, const PlacedSolid& outer) {
    const auto& components = inner.solid().components;
    return outer.solid().solid &&
           std::any_of(components.begin(), components.end(),
                       [&](std::uint32_t t) { return inside(inner, t, outer); });
}

} // namespace abut
