#pragma once

#include "clash_scene.h"
#include "report.h"

#include <cstdint>
#include <string>
#include <vector>

namespace abut::bench {

struct ClashSuiteOptions {
    ClashSceneOptions scene;
    std::string part_file;   ///< empty: the bent pipe
    double clearance = 0.05; ///< in diagonals of the part
    int rounds = 5;
    int threads = 2;        ///< of the rows that use more than one
    double job_limit = 120; ///< seconds after which the whole job is given up
};

/// Intersection and clearance of all candidate pairs, against FCL; then the whole clash job.
Report run_clash_suite(const ClashSuiteOptions& options);

struct ImportSuiteOptions {
    std::vector<std::string> files;
    int rounds = 7;
};

/// `read_scene`, which keeps the reader in a process of its own, against Assimp called in process.
/// Errors      as read_scene.
Report run_import_suite(const ImportSuiteOptions& options);

struct MassiveSuiteOptions {
    std::vector<std::uint64_t> plants = {2'000'000}; ///< triangles of each, instances counted
    std::uint64_t ground = 2'000'000;                ///< of one that small parts lie on; 0: none
    std::uint64_t sheet = 2'000'000;                 ///< triangles of one mesh; 0: none
    std::uint64_t memory = std::uint64_t{512} << 20; ///< of the import
    std::vector<std::uint64_t> clash_memory = {std::uint64_t{512} << 20, std::uint64_t{64} << 20};
    int rounds = 3;
};

/// Imports into a store, against `read_scene` of the same files, which keeps all in memory; clashes
/// of the store, against the job in core.
/// Errors      as import_models.
Report run_massive_suite(const MassiveSuiteOptions& options);

struct WalkSuiteOptions {
    std::string store;                    ///< empty: a plant in which nothing is shared
    std::uint64_t triangles = 15'432'126; ///< of that plant
    std::vector<std::uint64_t> memory = {std::uint64_t{512} << 20, std::uint64_t{128} << 20,
                                         std::uint64_t{64} << 20};
    double seconds = 120; ///< of each walk, in real time
    std::string only;     ///< run the cases whose name has this in it
    std::uint64_t seed = 1;
};

/// A person walks through a store, and flies, and jumps, frame by frame: how long the distance to
/// the nearest part takes.
/// Errors      as open_store and Walk.
Report run_walk_suite(const WalkSuiteOptions& options);

struct RigidSuiteOptions {
    std::vector<std::string> files; ///< two a pair
    /// Triangles of each model of a generated pair; 100,000 and 1,000,000 where nothing is given.
    std::vector<std::uint32_t> generated;
    std::size_t poses = 500; ///< in each regime
    int rounds = 3;
    bool alone = false;   ///< without peers
    bool volumes = false; ///< also with every other kind of bounding volume
    std::string only;     ///< run the cases whose name has this in it
    std::uint64_t seed = 1;
};

/// Collide, distance and within on pairs of models, and their build, against FCL, CGAL and Embree.
/// Errors      as read_mesh; Error{bad_argument} for an odd number of files.
Report run_rigid_suite(const RigidSuiteOptions& options);

struct ImpactSuiteOptions {
    std::vector<std::string> files; ///< first and second model of each pair
    bool is_long = false;           ///< also large bodies against small ones
    int motions = 200;
    int rounds = 3;
    std::uint64_t seed = 1;
    double peer_limit = 30; ///< seconds that the peer has for each row; 0: no peer
};

/// Times of impact of random motions that let two models cross, against FCL's conservative
/// advancement.
/// Errors      as read_scene; Error{bad_argument} for an odd number of files.
Report run_impact_suite(const ImpactSuiteOptions& options);

struct CcdSuiteOptions {
    std::vector<std::string> files;  ///< of queries (see read_elementary_queries)
    std::vector<std::string> frames; ///< of steps: start and end of each (see read_frame)
    std::vector<std::string> scenes; ///< names of deforming scenes
    int samples = 12;                ///< frames of each scene that are measured
    std::size_t pairs = 2000;        ///< of each generated case
    int rounds = 5;
    std::uint64_t seed = 1;
};

/// Elementary tests of continuous collision, by kind and truth, against FCL's cubic solver; whole
/// steps of deforming surfaces, every scheme beside representative triangles.
/// Errors      as read_elementary_queries and read_frame; Error{bad_argument} for an odd number of
///             frames.
Report run_ccd_suite(const CcdSuiteOptions& options);

struct ShapesSuiteOptions {
    std::string file; ///< empty: a generated model
    std::uint32_t triangles = 100000;
    std::size_t queries = 20000;
    int rounds = 5;
    std::uint64_t seed = 1;
};

/// One model against rays (Embree), points (CGAL) and containment.
/// Errors      as read_mesh.
Report run_shapes_suite(const ShapesSuiteOptions& options);

struct ConvexSuiteOptions {
    std::vector<std::string> files;                    ///< models whose hulls are taken too
    std::vector<std::size_t> vertices{100, 500, 2000}; ///< of the ellipsoids
    std::size_t poses = 2000;                          ///< in each case
    bool alone = false;                                ///< without peers
    std::string only;                                  ///< run the cases whose name has this in it
    int rounds = 5;
    std::uint64_t seed = 1;
};

/// Pairs of convex bodies against FCL and Bullet.
/// Errors      as read_mesh.
Report run_convex_suite(const ConvexSuiteOptions& options);

struct PiecesSuiteOptions {
    std::vector<std::string> files; ///< two a pair; closed
    std::size_t poses = 500;        ///< in each regime
    std::string part;               ///< run the machine parts whose name has this in it
    std::string only;               ///< run the cases whose name has this in it
    std::uint32_t curved = 0; ///< triangles of generated bodies that are built, and nothing else
    int rounds = 5;
    std::uint64_t seed = 1;
};

/// Solids as unions of convex pieces against the triangle trees and FCL: machine parts, each with
/// itself, and pairs of files.
/// Errors      as read_mesh and ConvexPieces; Error{bad_argument} for an odd number of files.
Report run_pieces_suite(const PiecesSuiteOptions& options);

struct WorldSuiteOptions {
    std::vector<std::size_t> counts{1000, 10000, 100000, 1000000};
    int steps = 20;        ///< at least, of each case
    bool alone = false;    ///< without peers
    bool methods = false;  ///< also each broad phase by itself
    std::string only;      ///< run the cases whose name has this in it
    double peer_limit = 4; ///< seconds of a step, about, beyond which a peer is left out
    std::uint64_t seed = 1;
};

/// Overlapping pairs of moving boxes, against Bullet, CGAL, Embree and FCL.
Report run_world_suite(const WorldSuiteOptions& options);

} // namespace abut::bench
