#pragma once

#include <abut/broad_phase.h>
#include <abut/store_clash.h>
#include <abut/types.h>

#include "massive/work/stored_parts.h"

#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// Pairs of parts whose meshes fit into the memory together. Large meshes are not counted, because
/// their blocks are read and evicted while the unit is tested.
struct WorkUnit {
    std::vector<IndexPair> pairs;      ///< sorted
    std::vector<std::uint32_t> meshes; ///< meshes of these pairs, sorted, without large ones
    std::uint64_t bytes = 0;           ///< of the models of these meshes
    bool cut = false;                  ///< its pairs join parts of different subgraphs
    bool alone = false;                ///< no other unit fits into the memory beside this one
};

/// Divides candidate pairs into work units. The parts are the nodes of the overlap graph and the
/// pairs its edges. The graph is cut into subgraphs whose meshes take at most `budget` bytes; then
/// the graph of the edges that were cut is divided in the same way, and so on. Units come in an
/// order in which each shares many meshes with the one before.
///
/// A part with a large mesh may meet many parts. It is one node for each of its cells (see
/// PairCell), so that it joins only parts that lie near each other.
///
/// In          budget: bytes of one unit while another one is read. order: with `random`, the pairs
///             are shuffled and cut wherever the budget is used up.
/// Errors      Error{bad_argument}, naming the store, if the meshes of one pair exceed twice the
///             budget.
/// Source      [Wilson, Larsen, Manocha, Lin 1999], the overlap graph and its repeated partition.
///             Differs: the weight of a subgraph is that of its distinct meshes.
std::vector<WorkUnit> make_work_units(const StoredParts& stored, std::vector<IndexPair> pairs,
                                      std::uint64_t budget, WorkOrder order,
                                      const std::string& store);

} // namespace abut
