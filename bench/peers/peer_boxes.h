#pragma once

#include <abut/types.h>

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace abut::bench {

/// Another library's broad phase: finds the overlapping pairs of boxes, step by step, on one
/// thread.
class BoxPeer {
public:
    BoxPeer() = default;
    BoxPeer(const BoxPeer&) = delete;
    BoxPeer& operator=(const BoxPeer&) = delete;
    virtual ~BoxPeer() = default;
    [[nodiscard]] virtual std::string name() const = 0;
    /// Takes all boxes of a step, as many as before, and returns the number of pairs.
    virtual std::size_t step(std::span<const Box3> boxes) = 0;
};

/// Creates a peer from the boxes of the first step. The functions below list the installed peers.
using MakeBoxPeer = std::unique_ptr<BoxPeer> (*)(std::span<const Box3>);
std::vector<MakeBoxPeer> bullet_box_peers();
std::vector<MakeBoxPeer> cgal_box_peers();
std::vector<MakeBoxPeer> embree_box_peers();
std::vector<MakeBoxPeer> fcl_box_peers();

} // namespace abut::bench
