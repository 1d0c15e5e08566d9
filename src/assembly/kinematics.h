#pragma once

#include <abut/assembly.h>
#include <abut/motion.h>

#include "assembly/loops.h"
#include "math/transform.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace abut {

/// The motion of one joint at a constant rate, between two keys.
struct JointRate {
    double speed = 0; ///< of the child's origin, in the parent's frame; metres a second
    double turn = 0;  ///< radians a second
};

/// The places of an assembly's parts over time. A part's displacement maps its place at rest to its
/// place in the world.
class AssemblyKinematics {
public:
    /// In          assembly: must outlive this object.
    /// Errors      Error{bad_argument}, naming the part, if the assembly is not valid.
    explicit AssemblyKinematics(const Assembly& assembly);

    [[nodiscard]] const Assembly& assembly() const { return assembly_; }
    [[nodiscard]] std::size_t size() const { return assembly_.parts.size(); }
    /// The parts in an order in which each comes after all that its place depends on.
    [[nodiscard]] const std::vector<std::uint32_t>& order() const { return order_; }
    /// The parts that the places of these two depend on, with themselves, in that order.
    [[nodiscard]] std::vector<std::uint32_t> needed_for(std::uint32_t a, std::uint32_t b) const;

    /// Computes the displacements of some parts.
    ///
    /// In          parts: closed under dependence, in order.
    ///             displacements: one for each part of the assembly; others are left as they are.
    /// Errors      Error{bad_argument}, naming the loop and the time, if a loop cannot close.
    void place(double time, std::span<const std::uint32_t> parts,
               std::vector<Transform>& displacements) const;

    [[nodiscard]] const LoopGeometry& loop(std::uint32_t loop) const { return loops_[loop]; }
    [[nodiscard]] const Vec3& axis(std::uint32_t part) const { return axes_[part]; }
    /// Index of the loop that determines a part's joint; kNone if there is none.
    [[nodiscard]] std::uint32_t loop_of(std::uint32_t part) const { return loop_of_[part]; }
    /// The rate of a joint that no loop determines, at a time that is no key's.
    [[nodiscard]] JointRate rate_at(std::uint32_t part, double time) const;
    /// The parts of equal number do not move relative to each other.
    [[nodiscard]] std::uint32_t rigid_group(std::uint32_t part) const { return group_[part]; }
    /// The part that a part hangs on; kNone: the world.
    [[nodiscard]] std::uint32_t parent(std::uint32_t part) const {
        return assembly_.parts[part].on.value_or(kNone);
    }
    /// The number of joints between a part and the world.
    [[nodiscard]] std::uint32_t depth(std::uint32_t part) const {
        return part == kNone ? 0 : depth_[part];
    }
    /// All times of keys, sorted, each once.
    [[nodiscard]] const std::vector<double>& key_times() const { return key_times_; }
    /// Whether a joint or a loop connects two parts.
    [[nodiscard]] bool are_joined(std::uint32_t a, std::uint32_t b) const;

    static constexpr std::uint32_t kNone = ~std::uint32_t{0};

private:
    void check_part(std::uint32_t part) const;
    void check_loop(std::uint32_t loop);
    void sort_parts();
    void group_parts();
    [[nodiscard]] std::vector<std::uint32_t> needs_of(std::uint32_t part) const;
    [[nodiscard]] double value_at(std::uint32_t part, double time) const;
    [[nodiscard]] Transform own_motion(std::uint32_t part, double time) const;
    [[nodiscard]] bool moves(std::uint32_t part) const;
    [[noreturn]] void fail(std::uint32_t part, const std::string& what) const;

    const Assembly& assembly_;
    std::vector<std::uint32_t> order_, loop_of_, group_;
    std::vector<std::uint32_t> rank_;  ///< place of each part in the order
    std::vector<std::uint32_t> depth_; ///< number of joints between each part and the world
    std::vector<LoopGeometry> loops_;
    std::vector<Vec3> axes_;                        ///< unit vectors
    std::vector<std::vector<Motion>> free_motions_; ///< of each part, between its keys
    std::vector<double> key_times_;
};

/// Returns the index of the last key that is not after the time; 0 if there is none.
std::size_t key_before(const std::vector<double>& times, double time);

} // namespace abut
