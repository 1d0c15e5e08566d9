#pragma once

#include <abut/world.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace abut::bench {

/// Bodies in a world that move step by step, and tell the world their bounds.
class MovingScene {
public:
    MovingScene() = default;
    explicit MovingScene(WorldOptions options) : world(std::move(options)) {}
    virtual ~MovingScene() = default;
    MovingScene(const MovingScene&) = delete;
    MovingScene& operator=(const MovingScene&) = delete;

    /// Moves all bodies on by kSceneStep.
    virtual void move() = 0;
    /// Tells the world new bounds. Call it after `advance`.
    virtual void steer() = 0;

    World world;
};

inline constexpr double kSceneStep = 1.0 / 240;

struct NamedScene {
    std::string name;
    std::function<std::unique_ptr<MovingScene>()> make;
};

/// Tori that fly and bounce in boxes; rings in chains, gears and a robot in its cell, whose boxes
/// overlap all the time while their surfaces stay apart.
std::vector<NamedScene> moving_scenes(std::uint64_t seed);

} // namespace abut::bench
