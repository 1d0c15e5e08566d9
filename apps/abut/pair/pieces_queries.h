#pragma once

#include <abut/convex_pieces.h>

#include "pair/pair_query.h"

#include <vector>

/// The queries on two models as solids of convex pieces (--pieces).
namespace abut::command {

/// Decomposes a model into convex pieces.
///
/// Errors      as ConvexPieces; the message begins with the file's name.
ConvexPieces pieces_of(const Model& model, const std::string& file);

/// Returns {pieces, triangles, largest, bytes}: the number of convex pieces of a mesh, the
/// triangles of all pieces and of the largest one, and the memory. Returns {pieces: null,
/// triangles, error} if the mesh is not a solid.
nlohmann::ordered_json describe_pieces(const Mesh& mesh);

struct PiecesDistanceQuery : PairQuery {
    PosesOption poses;
    PiecesDistanceOptions options;

    [[nodiscard]] PiecesGap ask(const TwoModels& m) const;
    [[nodiscard]] std::vector<PiecesGap> ask(const TwoModels& m,
                                             const std::vector<Placement>& placements) const;
    static void add_answer(const PiecesGap& gap, nlohmann::ordered_json& json);
    static std::string in_words(const PiecesGap& gap);
    static std::string in_a_line(const PiecesGap& gap);
    static bool is_problem(const PiecesGap& /*gap*/) { return false; }
};

struct PiecesWithinQuery : PairQuery {
    PosesOption poses;
    double tolerance = 0;

    [[nodiscard]] bool ask(const TwoModels& m) const;
    [[nodiscard]] std::vector<bool> ask(const TwoModels& m,
                                        const std::vector<Placement>& placements) const;
    [[nodiscard]] nlohmann::ordered_json question() const;
    static void add_answer(bool near, nlohmann::ordered_json& json);
    [[nodiscard]] std::string in_words(bool near) const;
    static std::string in_a_line(bool near);
    static bool is_problem(bool near) { return near; }
};

struct PiecesCollideQuery : PairQuery {
    PosesOption poses;
    bool all = false;

    [[nodiscard]] PiecesContacts ask(const TwoModels& m) const;
    [[nodiscard]] std::vector<PiecesContacts> ask(const TwoModels& m,
                                                  const std::vector<Placement>& placements) const;
    void add_answer(const PiecesContacts& contacts, nlohmann::ordered_json& json) const;
    [[nodiscard]] std::string in_words(const PiecesContacts& contacts) const;
    [[nodiscard]] static std::string in_a_line(const PiecesContacts& contacts);
    static bool is_problem(const PiecesContacts& contacts) { return contacts.meet; }
};

struct PiecesPenetrationQuery : PairQuery {
    PiecesPenetrationOptions options;

    [[nodiscard]] PiecesDepth ask(const TwoModels& m) const;
    void add_answer(const PiecesDepth& depth, nlohmann::ordered_json& json) const;
    [[nodiscard]] std::string in_words(const PiecesDepth& depth) const;
    static bool is_problem(const PiecesDepth& depth) { return depth.depth > 0; }
};

} // namespace abut::command
