#include "pieces/decomposition/growing_hull.h"

#include <algorithm>

namespace abut {

void GrowingHull::clear() {
    for (const Face& f : faces_)
        if (f.alive)
            for (const std::uint32_t v : f.corners)
                face_at_[v] = kNone;
    faces_.clear();
    free_.clear();
    removed_.clear();
    added_.clear();
    alive_ = 0;
    grown_ = false;
}

void GrowingHull::begin(std::span<const std::uint32_t> base, std::uint32_t apex) {
    clear();
    const auto n = static_cast<std::uint32_t>(base.size());
    // The base as a fan from its first corner, then the sides.
    for (std::uint32_t i = 1; i + 1 < n; ++i) {
        const std::uint32_t f = new_face({base[0], base[i], base[i + 1]});
        faces_[f].is_closed = true;
        const std::uint32_t sides = n - 2;
        faces_[f].across = {i == 1 ? sides : f - 1, sides + i, i + 2 == n ? sides + n - 1 : f + 1};
    }
    for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t f = new_face({base[(i + 1) % n], base[i], apex});
        const std::uint32_t sides = n - 2, in_base = i == 0 ? 0 : std::min(i, sides) - 1;
        faces_[f].across = {in_base, sides + (i + n - 1) % n, sides + (i + 1) % n};
    }
    for (std::uint32_t f = 0; f < faces_.size(); ++f)
        put(f);
}

std::uint32_t GrowingHull::new_face(const IndexTriangle& corners) {
    auto f = static_cast<std::uint32_t>(faces_.size());
    if (free_.empty()) {
        faces_.emplace_back();
    } else {
        f = free_.back();
        free_.pop_back();
    }
    faces_[f] = {corners,
                 {},
                 {positions_[corners[0]], positions_[corners[1]], positions_[corners[2]]},
                 true,
                 false};
    added_.push_back(f);
    ++alive_;
    return f;
}

void GrowingHull::put(std::uint32_t face) {
    for (const std::uint32_t v : faces_[face].corners)
        face_at_[v] = face;
}

void GrowingHull::settle() {
    if (grown_)
        free_.insert(free_.end(), removed_.begin(), removed_.end());
    removed_.clear();
    added_.clear();
    grown_ = false;
}

/// Returns a face that the vertex sees; kNone if there is none. The corners `near` lie with the
/// vertex in a plane that touches the hull. If the vertex sees none of their faces, it can see a
/// face only beyond those that it is coplanar with, so the search continues across these.
std::uint32_t GrowingHull::find_visible(std::uint32_t vertex, std::span<const std::uint32_t> near) {
    pending_.clear();
    for (const std::uint32_t v : near)
        if (is_corner(v))
            pending_.push_back(v);
    if (pending_.empty()) {
        for (std::uint32_t f = 0; f < faces_.size(); ++f)
            if (faces_[f].alive && side(f, vertex) > 0)
                return f;
        return kNone;
    }
    is_seen_.resize(std::max(is_seen_.size(), faces_.size()));
    seen_.clear();
    std::uint32_t found = kNone;
    for (std::size_t i = 0; i < pending_.size() && found == kNone; ++i)
        any_around(pending_[i], [&](std::uint32_t f, std::size_t) {
            if (is_seen_[f])
                return false;
            is_seen_[f] = true;
            seen_.push_back(f);
            const int s = side(f, vertex);
            if (s > 0)
                found = f;
            if (s == 0)
                pending_.insert(pending_.end(), faces_[f].corners.begin(), faces_[f].corners.end());
            return s > 0;
        });
    for (const std::uint32_t f : seen_)
        is_seen_[f] = false;
    return found;
}

void GrowingHull::look_from(std::uint32_t vertex, std::span<const std::uint32_t> near) {
    settle();
    vertex_ = vertex;
    const std::uint32_t first = find_visible(vertex, near);
    if (first == kNone)
        return;
    // Dead while it is collected, so that no face is collected twice.
    removed_.push_back(first);
    faces_[first].alive = false;
    for (std::size_t i = 0; i < removed_.size(); ++i)
        for (const std::uint32_t beyond : faces_[removed_[i]].across)
            if (faces_[beyond].alive && side(beyond, vertex) > 0) {
                faces_[beyond].alive = false;
                removed_.push_back(beyond);
            }
    for (const std::uint32_t f : removed_)
        faces_[f].alive = true;
}

void GrowingHull::grow() {
    grown_ = true;
    for (const std::uint32_t f : removed_) {
        faces_[f].alive = false;
        for (const std::uint32_t v : faces_[f].corners)
            face_at_[v] = kNone;
    }
    alive_ -= removed_.size();
    horizon_.clear();
    for (const std::uint32_t f : removed_)
        for (std::size_t k = 0; k < 3; ++k)
            if (faces_[faces_[f].across[k]].alive)
                horizon_.push_back(
                    {faces_[f].corners[k], faces_[f].corners[(k + 1) % 3], f, faces_[f].across[k]});
    link_cone();
}

void GrowingHull::link_cone() {
    for (const HorizonEdge& edge : horizon_) {
        const std::uint32_t f = new_face({edge.from, edge.to, vertex_});
        Face &face = faces_[f], &beyond = faces_[edge.beyond];
        face.across[0] = edge.beyond;
        // A face that is coplanar with a closed one extends it, in the same plane.
        face.is_closed = beyond.is_closed && side(edge.beyond, vertex_) == 0;
        beyond.across[corner_in(edge.beyond, edge.to)] = f;
        cone_from_[edge.from] = f;
    }
    for (const std::uint32_t f : added_) {
        const std::uint32_t next = cone_from_[faces_[f].corners[1]];
        faces_[f].across[1] = next;
        faces_[next].across[2] = f;
        put(f);
    }
}

void GrowingHull::take_back() {
    if (!grown_)
        return;
    face_at_[vertex_] = kNone;
    for (const HorizonEdge& edge : horizon_)
        faces_[edge.beyond].across[corner_in(edge.beyond, edge.to)] = edge.visible;
    for (const std::uint32_t f : removed_) {
        faces_[f].alive = true;
        put(f);
    }
    for (const std::uint32_t f : added_)
        faces_[f].alive = false;
    alive_ += removed_.size();
    alive_ -= added_.size();
    free_.insert(free_.end(), added_.begin(), added_.end());
    added_.clear();
    removed_.clear();
    grown_ = false;
}

std::uint32_t GrowingHull::climb(std::uint32_t from, const Vec3& point) const {
    if (from >= faces_.size() || !faces_[from].alive)
        return kNone;
    const auto height = [&](std::uint32_t f) {
        const ExactPlane& plane = faces_[f].plane;
        return dot(plane.normal, point - plane.a) / length(plane.normal);
    };
    double most = height(from);
    for (std::uint32_t at = kNone; at != from;) {
        at = from;
        for (const std::uint32_t f : faces_[at].across)
            if (const double h = height(f); h > most)
                most = h, from = f;
    }
    return from;
}

bool GrowingHull::lies_in(const ExactPlane& plane, std::uint32_t face) const {
    const IndexTriangle& c = faces_[face].corners;
    return std::all_of(c.begin(), c.end(),
                       [&](std::uint32_t v) { return plane.side(positions_[v]) == 0; });
}

void GrowingHull::close(const ExactPlane& plane, std::uint32_t corner) {
    pending_.clear();
    const auto close_if_in = [&](std::uint32_t f) {
        if (!faces_[f].is_closed && lies_in(plane, f)) {
            faces_[f].is_closed = true;
            pending_.push_back(f);
        }
    };
    if (corner == kNone) {
        for (std::uint32_t f = 0; f < faces_.size(); ++f)
            if (faces_[f].alive)
                close_if_in(f);
        return;
    }
    any_around(corner, [&](std::uint32_t f, std::size_t) {
        close_if_in(f);
        return false;
    });
    for (std::size_t i = 0; i < pending_.size(); ++i) {
        const IndexTriangle across = faces_[pending_[i]].across;
        for (const std::uint32_t f : across)
            close_if_in(f);
    }
}

} // namespace abut
