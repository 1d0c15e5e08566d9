#include "clash/building/packed_building.h"

#include "clash/building/light_mesh.h"
#include "clash/building/triangle_shares.h"
#include "core/parallel.h"
#include "core/progress.h"
#include "math/rounding.h"
#include "math/transform.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <meshoptimizer.h>

namespace abut {

namespace {

/// Lengths in metres, by detail.
constexpr std::array<double, kPartDetails> kStep{0.0001, 0.0005, 0.004};
constexpr std::array<double, kPartDetails> kError{0, 0.004, 0.03};
/// The rest may also differ by this share of the mesh's size.
constexpr double kRestError = 0.02;
constexpr std::size_t kChunkVertices = 1U << 16;

double scale_of_map(const Transform& t) {
    const auto& m = t.m;
    return std::max({length({m[0], m[1], m[2]}), length({m[3], m[4], m[5]}),
                     length({m[6], m[7], m[8]}), 1e-12});
}

template <typename Row>
std::size_t append_rows(std::vector<std::byte>& out, const std::vector<Row>& rows) {
    std::vector<unsigned char> code(meshopt_encodeVertexBufferBound(rows.size(), sizeof(Row)));
    code.resize(meshopt_encodeVertexBuffer(code.data(), code.size(), rows.data(), rows.size(),
                                           sizeof(Row)));
    const auto* const first = reinterpret_cast<const std::byte*>(code.data());
    out.insert(out.end(), first, first + code.size());
    return code.size();
}

std::size_t append_indices(std::vector<std::byte>& out, const std::vector<std::uint32_t>& indices,
                           std::size_t vertices) {
    std::vector<unsigned char> code(meshopt_encodeIndexBufferBound(indices.size(), vertices));
    code.resize(
        meshopt_encodeIndexBuffer(code.data(), code.size(), indices.data(), indices.size()));
    const auto* const first = reinterpret_cast<const std::byte*>(code.data());
    out.insert(out.end(), first, first + code.size());
    return code.size();
}

class Packer {
public:
    Packer(const BuildingSource& source, const BuildingRequest& request)
        : source_(source), request_(request),
          shown_(choose_parts(source, request.clashing, request.points, request.most_parts)) {}

    PackedBuilding run(const std::unordered_map<std::uint32_t, std::uint32_t>& number) {
        if (shown_.empty())
            return {};
        for (const ShownPart& shown : shown_) {
            const Box3& box = source_.parts()[shown.part].box;
            extend(result_.bounds, box.lower);
            extend(result_.bounds, box.upper);
        }
        result_.origin = 0.5 * result_.bounds.lower + 0.5 * result_.bounds.upper;
        gather_meshes();
        const auto shares =
            share_triangles(source_, static_cast<double>(request_.most_bytes), meshes_);
        result_.clash_share = shares[0];
        lighten();
        append_chunks();
        append_parts(number);
        result_.left_out = source_.parts().size() - shown_.size();
        return std::move(result_);
    }

private:
    void gather_meshes() {
        std::map<std::pair<PartDetail, std::uint32_t>, std::uint32_t> place;
        transforms_.resize(shown_.size());
        parallel_for(shown_.size(), 64, [&](std::size_t i) {
            transforms_[i] = source_.world_from_mesh(shown_[i].part);
        });
        for (std::size_t i = 0; i < shown_.size(); ++i) {
            const std::uint32_t mesh = source_.parts()[shown_[i].part].mesh;
            const auto [entry, is_new] = place.try_emplace(
                {shown_[i].detail, mesh}, static_cast<std::uint32_t>(meshes_.size()));
            if (is_new)
                meshes_.push_back({mesh, shown_[i].detail, 0, 0, 1});
            ShownMesh& row = meshes_[entry->second];
            ++row.uses;
            row.scale = std::max(row.scale, scale_of_map(transforms_[i]));
            mesh_of_part_.push_back(entry->second);
        }
    }

    LightMeshTerms terms_of(const ShownMesh& mesh) const {
        const auto detail = static_cast<std::size_t>(mesh.detail);
        const Box3& box = source_.meshes()[mesh.mesh].box;
        const double extent = std::max(max_abs(box.upper - box.lower), 1e-30);
        // The grid has at most 2^30 points along an axis.
        const double step = std::max(kStep.at(detail) / mesh.scale, extent / 0x1p30);
        double error = kError.at(detail) / mesh.scale;
        if (mesh.detail == PartDetail::rest)
            error = std::max(error, kRestError * extent);
        return {step, error, mesh.share};
    }

    void lighten() {
        light_.resize(meshes_.size());
        ProgressMeter meter(request_.progress, "report", meshes_.size());
        parallel_for(meshes_.size(), 4, [&](std::size_t i) {
            LightMeshBuilder builder(source_.meshes()[meshes_[i].mesh].box.lower,
                                     terms_of(meshes_[i]));
            source_.for_each_piece(meshes_[i].mesh, [&](const Mesh& piece) { builder.add(piece); });
            light_[i] = builder.take();
            meter.advance();
        });
    }

    void append_chunks() {
        std::vector<std::pair<std::size_t, std::size_t>> ranges;
        std::size_t first = 0, vertices = 0;
        for (std::size_t i = 0; i < light_.size(); ++i) {
            vertices += light_[i].vertices.size();
            if (vertices < kChunkVertices && i + 1 < light_.size())
                continue;
            ranges.emplace_back(first, i + 1);
            first = i + 1;
            vertices = 0;
        }
        std::vector<std::vector<std::byte>> codes(ranges.size());
        result_.chunks.resize(ranges.size());
        parallel_for(ranges.size(), 1, [&](std::size_t c) {
            std::vector<std::array<std::uint32_t, 3>> points;
            std::vector<std::uint32_t> indices;
            for (std::size_t i = ranges[c].first; i < ranges[c].second; ++i) {
                const auto before = static_cast<std::uint32_t>(points.size());
                points.insert(points.end(), light_[i].vertices.begin(), light_[i].vertices.end());
                for (const std::uint32_t index : light_[i].indices)
                    indices.push_back(before + index);
            }
            PackedBuilding::Chunk& chunk = result_.chunks[c];
            chunk.vertices = points.size();
            chunk.indices = indices.size();
            chunk.vertex_bytes = append_rows(codes[c], points);
            chunk.index_bytes = append_indices(codes[c], indices, points.size());
        });
        for (const std::vector<std::byte>& code : codes)
            result_.bytes.insert(result_.bytes.end(), code.begin(), code.end());
        std::vector<std::array<std::uint32_t, 2>> rows;
        for (const LightMesh& mesh : light_)
            rows.push_back({static_cast<std::uint32_t>(mesh.vertices.size()),
                            static_cast<std::uint32_t>(mesh.indices.size())});
        result_.meshes = rows.size();
        result_.mesh_bytes = append_rows(result_.bytes, rows);
    }

    /// The map from the grid of a part's mesh to metres about the origin.
    [[nodiscard]] std::array<float, 12> grid_transform(std::size_t i) const {
        const LightMesh& mesh = light_[mesh_of_part_[i]];
        Transform t = transforms_[i];
        const Vec3 at = apply(t, mesh.lower) - result_.origin;
        t.m[9] = at.x, t.m[10] = at.y, t.m[11] = at.z;
        std::array<float, 12> row{};
        for (std::size_t k = 0; k < 12; ++k)
            row.at(k) = to_float(k < 9 ? t.m.at(k) * mesh.step : t.m.at(k));
        return row;
    }

    void append_parts(const std::unordered_map<std::uint32_t, std::uint32_t>& number) {
        std::vector<std::array<std::uint32_t, 3>> rows;
        std::vector<std::array<float, 12>> maps;
        for (std::size_t i = 0; i < shown_.size(); ++i) {
            const auto found = number.find(shown_[i].part);
            const std::uint32_t model = source_.parts()[shown_[i].part].model;
            rows.push_back({mesh_of_part_[i], found == number.end() ? 0xffffffff : found->second,
                            model | static_cast<std::uint32_t>(shown_[i].detail) << 16U});
            maps.push_back(grid_transform(i));
            result_.triangles += light_[mesh_of_part_[i]].indices.size() / 3;
        }
        result_.parts = rows.size();
        result_.part_bytes = append_rows(result_.bytes, rows);
        result_.transform_bytes = append_rows(result_.bytes, maps);
    }

    const BuildingSource& source_;
    const BuildingRequest& request_;
    std::vector<ShownPart> shown_;
    std::vector<Transform> transforms_;       ///< by shown part
    std::vector<std::uint32_t> mesh_of_part_; ///< index in meshes_, by shown part
    std::vector<ShownMesh> meshes_;
    std::vector<LightMesh> light_; ///< by mesh
    PackedBuilding result_;
};

} // namespace

PackedBuilding pack_building(const BuildingSource& source, const BuildingRequest& request,
                             const std::unordered_map<std::uint32_t, std::uint32_t>& number) {
    return Packer(source, request).run(number);
}

std::string base64(std::span<const std::byte> bytes) {
    constexpr const char* kDigits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t rest = std::min<std::size_t>(3, bytes.size() - i);
        std::uint32_t word = 0;
        for (std::size_t k = 0; k < 3; ++k)
            word = word << 8U | (k < rest ? std::to_integer<std::uint32_t>(bytes[i + k]) : 0U);
        for (std::size_t k = 0; k < 4; ++k)
            text += k <= rest ? kDigits[word >> (18 - 6 * k) & 63U] : '=';
    }
    return text;
}

} // namespace abut
