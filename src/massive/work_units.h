#pragma once

#include <abut/broad_phase.h>
#include <abut/store_clash.h>
#include <abut/types.h>

#include "massive/stored_parts.h"

#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// Pairs of parts whose meshes fit into the memory together. Of large meshes it has nothing: their
/// blocks come and go while it is tested.
struct WorkUnit {
    std::vector<IndexPair> pairs;      ///< sorted
    std::vector<std::uint32_t> meshes; ///< that they need, sorted; no large ones
    std::uint64_t bytes = 0;           ///< of these
    bool cut = false;                  ///< of pairs that the partition put apart
    bool alone = false;                ///< no other unit fits into the memory beside it
};

/// Cuts the overlap graph, its nodes parts and its edges pairs, into subgraphs whose meshes take at
/// most `budget` bytes; then the graph of the edges that were cut, and so on. Subgraphs come in an
/// order in which each shares much with the one before.
///
/// A large mesh that meets many parts joins only those that lie near each other: it is a node for
/// each of its cells (see PairCell).
///
/// In          budget: of one unit, while another one comes into memory; order random: pairs in any
///             order, cut wherever the budget is used up.
/// Errors      Error{bad_argument}, naming the store, if the meshes of one pair exceed twice the
///             budget.
/// Source      [Wilson, Larsen, Manocha, Lin 1999], the overlap graph and its repeated partition.
///             Differs: the weight of a subgraph is that of its distinct meshes.
std::vector<WorkUnit> make_work_units(const StoredParts& stored, std::vector<IndexPair> pairs,
                                      std::uint64_t budget, WorkOrder order,
                                      const std::string& store);

} // namespace abut
