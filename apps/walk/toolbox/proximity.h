#pragma once

#include "session/session.h"

#include <optional>
#include <vector>

namespace abut::viewer {

/// The parts near the person, or near the chosen part.
struct Proximity {
    bool on = true, of_chosen = false, with_list = false;
    double reach = 1;     ///< metres, of the list and of the colours
    bool colours = false; ///< whether surfaces are coloured by their distance
    std::optional<WalkGap> nearest;
    std::vector<WalkGap> near; ///< the nearest first
    bool complete = true;
    double milliseconds = 0; ///< that the queries took

    void update(Session& session);
    /// Sets the colours of the session's style: exact distances from the chosen part or from the
    /// person, at points of a grid of pixels.
    void colour(Session& session);

private:
    [[nodiscard]] bool is_of_part(const Session& session) const;
    /// Around the person. The floor on which a person stands is not of interest to the queries.
    [[nodiscard]] static Capsule body(const Session& session);

    std::optional<std::uint32_t> coloured_; ///< the part of `model_`
    std::optional<Model> model_;
};

/// The name of a part on one line.
std::string name_of(Session& session, WalkPart part);

} // namespace abut::viewer
