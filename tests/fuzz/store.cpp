/// A store with any rows and blocks under valid checksums, or with any bytes changed, gives usable
/// meshes, parts and remaining work, or an Error.
#include <abut/error.h>
#include <abut/store.h>

#include "core/hash.h"
#include "io/file/fault.h"
#include "massive/record/job_rows.h"
#include "massive/record/job_tables.h"
#include "massive/record/work_rows.h"
#include "massive/work/stored_parts.h"
#include "store/codec/mesh_codec.h"
#include "store/database/schema.h"
#include "store/database/store_file.h"
#include "tests/support/byte_choices.h"
#include "tests/support/folder.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <span>
#include <string>
#include <zstd.h>

namespace {

using namespace abut;
using abut::test::ByteChoices;

void require(bool condition) {
    if (!condition)
        std::abort();
}

Mesh tetrahedron() {
    return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
            {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
}

/// A store of one model with some meshes and parts, valid except where the fuzzer's bytes change
/// it.
class StoreDraft {
public:
    StoreDraft(ByteChoices& choices, const std::string& path)
        : choices_(choices), database_(path, OpenMode::create) {
        database_.run("PRAGMA journal_mode = OFF; PRAGMA synchronous = OFF");
        create_schema(database_);
        Transaction transaction(database_);
        const int meshes = choices_.integer(1, 3), parts = choices_.integer(0, 4);
        for (int i = 1; i <= meshes; ++i)
            add_mesh(i);
        std::uint64_t sum = 0;
        for (int i = 0; i < parts; ++i)
            sum += add_part(i);
        add_model(static_cast<std::uint64_t>(parts), sum);
        if (choices_.chance(0.3))
            add_job();
        transaction.commit();
    }

private:
    /// Changes the value, seldom.
    template <typename Integer>
    void distort(Integer& value) {
        if (!choices_.chance(0.1))
            return;
        constexpr std::array<std::uint64_t, 8> kOdd{
            0, 1, 2, 65537, 0xffffffff, 0x100000000, 0x7fffffffffffffff, 0xffffffffffffffff};
        value = static_cast<Integer>(choices_.chance(0.5)
                                         ? static_cast<std::uint64_t>(value) +
                                               static_cast<std::uint64_t>(choices_.integer(-3, 3))
                                         : kOdd[static_cast<std::size_t>(choices_.integer(0, 7))]);
    }
    void distort(double& value) {
        if (!choices_.chance(0.05))
            return;
        // SQLite stores NaN as null, which the columns refuse.
        constexpr std::array kOdd{0.0,
                                  -1.0,
                                  1e300,
                                  -1e300,
                                  1e18,
                                  5e-324,
                                  std::numeric_limits<double>::infinity(),
                                  -std::numeric_limits<double>::infinity()};
        value = kOdd[static_cast<std::size_t>(choices_.integer(0, 7))];
    }
    void distort(Box3& box) {
        for (Vec3* const corner : {&box.lower, &box.upper})
            for (double* const at : {&corner->x, &corner->y, &corner->z})
                distort(*at);
    }

    /// A valid block, or one with a header and lists from the fuzzer's bytes.
    EncodedBlock some_block(MeshBlock& block) {
        if (choices_.chance(0.5))
            return encode_block(block);
        std::array<std::uint32_t, 4> header{4, 4, 4, 0};
        for (std::uint32_t& word : header)
            distort(word);
        std::vector<std::byte> raw(sizeof header);
        std::memcpy(raw.data(), header.data(), raw.size());
        for (int count = choices_.integer(0, 255); count > 0; --count)
            raw.push_back(static_cast<std::byte>(choices_.integer(0, 255)));
        EncodedBlock encoded;
        encoded.raw_bytes = raw.size();
        encoded.data.resize(ZSTD_compressBound(raw.size()));
        encoded.data.resize(
            ZSTD_compress(encoded.data.data(), encoded.data.size(), raw.data(), raw.size(), 1));
        return encoded;
    }

    void add_mesh(std::int64_t number) {
        MeshBlock block{tetrahedron(), {}, {}};
        if (choices_.chance(0.3)) // a mesh block of a larger mesh
            block.vertex_ids = {0, 1, 2, 3}, block.triangle_ids = {0, 1, 2, 3};
        for (auto* const ids : {&block.vertex_ids, &block.triangle_ids})
            for (std::uint32_t& id : *ids)
                distort(id);
        for (Vec3& p : block.mesh.positions)
            distort(p.x), distort(p.y);
        MeshRow row{number, hash_, 0, 4, 4, next_block_, 0, 0, 0, true, {{0, 0, 0}, {1, 1, 1}}};
        ++hash_;
        for (int count = choices_.chance(0.2) ? 2 : 1; count > 0; --count) {
            const EncodedBlock encoded = some_block(block);
            add_block(number, encoded);
            ++row.blocks;
            row.raw_bytes += encoded.raw_bytes, row.stored_bytes += encoded.data.size();
        }
        for (std::uint64_t* const value :
             {&row.vertices, &row.triangles, &row.blocks, &row.raw_bytes, &row.stored_bytes})
            distort(*value);
        distort(row.first_block);
        distort(row.box);
        const std::array hash{row.hash_low, row.hash_high};
        const Box3& b = row.box;
        Statement(database_, "INSERT INTO mesh VALUES (?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?)")
            .bind(row.mesh, std::as_bytes(std::span(hash)), row.vertices, row.triangles,
                  row.first_block, row.blocks, row.raw_bytes, row.stored_bytes, 1, b.lower.x,
                  b.lower.y, b.lower.z, b.upper.x, b.upper.y, b.upper.z, row.checksum())
            .run();
    }

    void add_block(std::int64_t mesh, const EncodedBlock& encoded) {
        BlockRow row{next_block_++,        mesh, 4, 4, encoded.raw_bytes, {{0, 0, 0}, {1, 1, 1}},
                     hash_64(encoded.data)};
        for (std::uint64_t* const value : {&row.vertices, &row.triangles, &row.raw_bytes})
            distort(*value);
        distort(row.box);
        const Box3& b = row.box;
        Statement(database_, "INSERT INTO block VALUES (?,?,?,?,?,?,?,?,?,?,?,?,?,?)")
            .bind(row.block, row.mesh, row.vertices, row.triangles, row.raw_bytes, b.lower.x,
                  b.lower.y, b.lower.z, b.upper.x, b.upper.y, b.upper.z, row.data_checksum,
                  row.checksum(), encoded.data)
            .run();
    }

    std::uint64_t add_part(int number) {
        PartRow row;
        row.part = number + 1, row.model = 1, row.number = static_cast<std::uint64_t>(number);
        row.mesh = 1 + number % 3, row.id = std::to_string(number), row.generation = 1;
        row.box = {{0, 0, 0}, {1, 1, 1}};
        distort(row.number);
        distort(row.mesh);
        distort(row.generation);
        distort(row.box);
        if (choices_.chance(0.5)) {
            row.colour.emplace();
            for (std::uint8_t* const byte : {&row.colour->red, &row.colour->alpha})
                distort(*byte);
        }
        for (double& value : row.world_from_mesh.m)
            distort(value);
        const Box3& b = row.box;
        Statement(database_, "INSERT INTO part VALUES (?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?)")
            .bind(row.part, row.model, row.number, row.mesh, row.id, row.name, row.type, b.lower.x,
                  b.lower.y, b.lower.z, b.upper.x, b.upper.y, b.upper.z,
                  std::as_bytes(std::span(row.world_from_mesh.m)), row.generation,
                  colour_text(row.colour), row.checksum())
            .run();
        return row.checksum();
    }

    void add_model(std::uint64_t parts, std::uint64_t sum) {
        ModelRow row;
        row.model = 1, row.file = row.path = "a.glb", row.parts = parts, row.parts_sum = sum;
        distort(row.parts);
        distort(row.triangles);
        distort(row.generation);
        const std::array hash{row.hash_low, row.hash_high};
        Statement(database_, "INSERT INTO model VALUES (?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?)")
            .bind(row.model, row.file, row.path, row.bytes, row.modified,
                  std::as_bytes(std::span(hash)), row.unit, row.importing ? 1 : 0, row.parts,
                  row.triangles, row.generation, row.parts_sum, std::string(to_string(row.up)),
                  std::string(to_string(row.world_up)), row.asked, row.notes, row.checksum())
            .run();
    }

    void add_job() {
        prepare_job_tables(database_);
        JobRow job;
        job.question = add_question(database_, ClashOptions());
        job.models = {{1, 0}};
        job.candidates = 1, job.planned = choices_.chance(0.5);
        distort(job.candidates);
        distort(job.run);
        put_job(database_, job);
        ClashRow clash;
        clash.parts = {1, 2};
        distort(clash.parts.first);
        distort(clash.clash.distance);
        distort(clash.clash.triangle_pairs);
        add_clashes(database_, job.job, {clash});
        std::vector<std::vector<RowPair>> units(1);
        for (int count = choices_.integer(1, 4); count > 0; --count) {
            auto& [a, b] = units[0].emplace_back(1, 2);
            distort(a);
            distort(b);
        }
        add_units(database_, job.job, units);
    }

    ByteChoices& choices_;
    Database database_;
    std::int64_t next_block_ = 1;
    std::uint64_t hash_ = 1;
};

/// Calls work(). An Error is a valid answer if it is one line.
template <typename Work>
void answer_of(const Work& work) {
    try {
        work();
    } catch (const Error& error) {
        require(std::string(error.what()).find('\n') == std::string::npos);
    }
}

void require_sound(const Mesh& mesh) {
    for (const auto& triangle : mesh.triangles)
        for (const std::uint32_t corner : triangle)
            require(corner < mesh.positions.size());
}

void read_all(const std::string& path) {
    answer_of([&] { static_cast<void>(summary(open_store(path))); });
    answer_of([&] { verify(open_store(path)); });
    answer_of([&] {
        StoreFile file(path, true);
        file.for_each_mesh([&](const MeshRow& row) {
            answer_of([&] { require_sound(file.read_mesh(row.mesh)); });
            answer_of([&] {
                for (const BlockRow& block : file.blocks(row))
                    require_sound(file.read_block(block.block).mesh);
            });
        });
        answer_of([&] {
            const ClashOptions options;
            RuleTable rules(options);
            const StoredParts parts = gather_parts(file, &rules);
            for (const StoredPart& part : parts.parts)
                require(part.mesh < parts.meshes.size());
            static_cast<void>(find_candidates(parts, rules, options));
        });
        file.with_connection([&](Database& database) {
            if (!has_job_tables(database))
                return;
            for (const JobRow& job : read_jobs(database)) {
                answer_of([&] { for_each_clash(database, job.job, [](ClashRow&&) {}); });
                answer_of([&] { for_each_pair_left(database, job.job, [](const RowPair&) {}); });
            }
        });
    });
}

void change_bytes(ByteChoices& choices, const std::string& path) {
    std::fstream file(path, std::ios::binary | std::ios::in | std::ios::out);
    const auto size = static_cast<std::int64_t>(std::filesystem::file_size(path));
    while (!choices.is_empty()) {
        const std::int64_t place = (choices.integer(0, 255) << 16 | choices.integer(0, 255) << 8 |
                                    choices.integer(0, 255)) %
                                   size;
        file.seekp(place).put(static_cast<char>(choices.integer(0, 255)));
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const abut::test::Folder folder;
    const std::string path = folder / "store.abut";
    std::filesystem::remove(path);
    ByteChoices choices({data, size});
    const bool changes = choices.chance(0.3);
    try {
        StoreDraft draft(choices, path);
    } catch (const abut::Error&) { // for example two parts with one number
        return 0;
    }
    if (changes)
        change_bytes(choices, path);
    read_all(path);
    return 0;
}
