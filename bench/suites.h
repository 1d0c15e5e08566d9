#pragma once

#include "report.h"
#include "suites/clash_scene.h"

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
    double job_limit = 120; ///< seconds after which the whole job is stopped
};

/// Measures intersection and clearance of all candidate pairs against FCL, then the whole clash
/// job.
Report run_clash_suite(const ClashSuiteOptions& options);

struct ImportSuiteOptions {
    std::vector<std::string> files;
    int rounds = 7;
};

/// Measures `read_scene`, whose reader runs in a process of its own, against Assimp in this
/// process.
///
/// Errors      as read_scene.
Report run_import_suite(const ImportSuiteOptions& options);

struct MassiveSuiteOptions {
    std::vector<std::uint64_t> plants = {2'000'000}; ///< triangles of each, instances counted
    std::uint64_t ground = 2'000'000; ///< triangles of a large mesh with small parts on it; 0: none
    std::uint64_t sheet = 2'000'000;  ///< triangles of one mesh; 0: none
    std::uint64_t memory = std::uint64_t{512} << 20; ///< of the import
    std::vector<std::uint64_t> clash_memory = {std::uint64_t{512} << 20, std::uint64_t{64} << 20};
    int rounds = 3;
};

/// Measures imports into a store against `read_scene` of the same files, which keeps all in memory,
/// and clash jobs on the store against the job in core.
///
/// Errors      as import_models.
Report run_massive_suite(const MassiveSuiteOptions& options);

struct WalkSuiteOptions {
    std::string store;                    ///< empty: a plant in which no mesh is shared
    std::uint64_t triangles = 15'432'126; ///< of that plant
    std::vector<std::uint64_t> memory = {std::uint64_t{512} << 20, std::uint64_t{128} << 20,
                                         std::uint64_t{64} << 20};
    double seconds = 120; ///< of each walk, in real time
    std::string only;     ///< runs only the cases whose name contains this
    std::uint64_t seed = 1;
};

/// A person walks, flies and jumps through a store, frame by frame. Measures the time to find the
/// distance to the nearest part.
///
/// Errors      as open_store and Walk.
Report run_walk_suite(const WalkSuiteOptions& options);

struct RigidSuiteOptions {
    std::vector<std::string> files; ///< two for each pair
    /// Triangles of each model of a generated pair; 100,000 and 1,000,000 if nothing is given.
    std::vector<std::uint32_t> generated;
    std::size_t poses = 500; ///< in each regime
    int rounds = 3;
    bool alone = false;   ///< without peers
    bool volumes = false; ///< also with every other kind of bounding volume
    std::string only;     ///< runs only the cases whose name contains this
    std::uint64_t seed = 1;
};

/// Measures collide, distance and within on pairs of models, and their build, against FCL, CGAL and
/// Embree.
///
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

/// Measures times of impact of random motions that let two models cross, against FCL's conservative
/// advancement.
///
/// Errors      as read_scene; Error{bad_argument} for an odd number of files.
Report run_impact_suite(const ImpactSuiteOptions& options);

struct CcdSuiteOptions {
    std::vector<std::string> files;  ///< of queries (see read_elementary_queries)
    std::vector<std::string> frames; ///< start and end of each step (see read_frame)
    std::vector<std::string> scenes; ///< names of deforming scenes
    int samples = 12;                ///< frames of each scene that are measured
    std::size_t pairs = 2000;        ///< of each generated case
    int rounds = 5;
    std::uint64_t seed = 1;
};

/// Measures elementary tests of continuous collision, by kind and truth, against FCL's cubic
/// solver, and whole steps of deforming surfaces, with other schemes compared with representative
/// triangles.
///
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

/// Measures one model against rays (Embree), points (CGAL) and containment.
///
/// Errors      as read_mesh.
Report run_shapes_suite(const ShapesSuiteOptions& options);

struct ConvexSuiteOptions {
    std::vector<std::string> files;                    ///< models whose hulls are measured too
    std::vector<std::size_t> vertices{100, 500, 2000}; ///< of the ellipsoids
    std::size_t poses = 2000;                          ///< in each case
    bool alone = false;                                ///< without peers
    std::string only; ///< runs only the cases whose name contains this
    int rounds = 5;
    std::uint64_t seed = 1;
};

/// Measures pairs of convex bodies against FCL and Bullet.
///
/// Errors      as read_mesh.
Report run_convex_suite(const ConvexSuiteOptions& options);

struct PiecesSuiteOptions {
    std::vector<std::string> files; ///< two for each pair; closed
    std::size_t poses = 500;        ///< in each regime
    std::string part;               ///< runs only the machine parts whose name contains this
    std::string only;               ///< runs only the cases whose name contains this
    std::uint32_t curved = 0;       ///< if not 0: only builds of generated bodies with this many
                                    ///< triangles are measured
    int rounds = 5;
    std::uint64_t seed = 1;
};

/// Measures solids as unions of convex pieces against the triangle trees and FCL: machine parts,
/// each with itself, and pairs of files.
///
/// Errors      as read_mesh and ConvexPieces; Error{bad_argument} for an odd number of files.
Report run_pieces_suite(const PiecesSuiteOptions& options);

struct WorldSuiteOptions {
    std::vector<std::size_t> counts{1000, 10000, 100000, 1000000};
    int steps = 20;        ///< at least, for each case
    bool alone = false;    ///< without peers
    bool methods = false;  ///< also each broad phase by itself
    std::string only;      ///< runs only the cases whose name contains this
    double peer_limit = 4; ///< approximate seconds per step beyond which a peer is left out
    std::uint64_t seed = 1;
};

/// Measures overlapping pairs of moving boxes, against Bullet, CGAL, Embree and FCL.
Report run_world_suite(const WorldSuiteOptions& options);

} // namespace abut::bench
