#include "io/file/fault.h"
#include "io/gltf/gltf_geometry.h"
#include "io/process/decode_geometry.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <span>

namespace abut {

namespace {

/// The fewest bytes that some elements can be compressed to, less a few for the stream's frame. A
/// count beyond it is refused before memory is taken for it.
///
/// Source      EXT_meshopt_compression: two bits for 16 equal bytes; a byte for a triangle; one for
///             an index.
std::uint64_t least_bytes(const GlbDocument::Compressed& compressed) {
    using Mode = GlbDocument::Compressed::Mode;
    return compressed.mode == Mode::attributes  ? compressed.count * compressed.stride / 64
           : compressed.mode == Mode::triangles ? compressed.count / 3
                                                : compressed.count;
}

decode_request::Job job_of(const GlbDocument::Compressed& compressed) {
    using Mode = GlbDocument::Compressed::Mode;
    using Filter = GlbDocument::Compressed::Filter;
    const std::uint32_t stride = compressed.stride;
    const bool is_index = compressed.mode != Mode::attributes;
    const bool fits = is_index ? stride == 2 || stride == 4 : stride > 0 && stride % 4 == 0;
    const bool filter_fits =
        compressed.filter == Filter::none ||
        (!is_index && (compressed.filter == Filter::octahedral   ? stride == 4 || stride == 8
                       : compressed.filter == Filter::quaternion ? stride == 8
                       : compressed.filter == Filter::color      ? false // of no position
                                                                 : true));
    if (!fits || !filter_fits || compressed.count > kLargestGltfSize ||
        least_bytes(compressed) > compressed.bytes ||
        (compressed.mode == Mode::triangles && compressed.count % 3 != 0))
        malformed("a compressed buffer view has an impossible size");
    decode_request::Job job;
    job.kind = compressed.mode == Mode::attributes  ? decode_request::Kind::meshopt_attributes
               : compressed.mode == Mode::triangles ? decode_request::Kind::meshopt_triangles
                                                    : decode_request::Kind::meshopt_indices;
    job.filter = static_cast<decode_request::Filter>(compressed.filter);
    job.stride = stride;
    job.count = compressed.count;
    return job;
}

/// Refuses attributes in the codec's version 1. Only KHR_meshopt_compression allows it.
///
/// In          input: the compressed bytes, of which there is one at least.
void check_codec(const DecodeJobs::Input& input) {
    constexpr std::byte kVersionOne{0xa1};
    std::byte header{};
    input(0, std::span(&header, 1));
    if (header == kVersionOne)
        throw Fault(ErrorCode::unsupported, "is compressed by version 1 of meshoptimizer's vertex "
                                            "codec; only version 0 is supported");
}

} // namespace

/// Collects the jobs that decode the compressed geometry of a document.
class GltfGeometry::Decoding {
public:
    static constexpr std::size_t kNoJob = std::numeric_limits<std::size_t>::max();

    explicit Decoding(const GltfGeometry& geometry)
        : job_of_view(geometry.document_.compressed.size(), kNoJob),
          job_of_draco(geometry.document_.draco.size(), kNoJob), geometry_(geometry),
          document_(geometry.document_) {}

    void add_primitive(const GlbDocument::Primitive& primitive) {
        using Mode = GlbDocument::Primitive::Mode;
        if (primitive.mode == Mode::other)
            return;
        if (!geometry_.is_decoded_primitive(primitive)) {
            add_accessor(primitive.position);
            add_accessor(primitive.indices);
            return;
        }
        if (primitive.mode != Mode::triangles)
            throw Fault(ErrorCode::unsupported, "has strips or fans compressed by Draco");
        const GlbDocument::Draco& draco = document_.draco[primitive.draco];
        const GlbDocument::View& from = geometry_.view(draco.view);
        const GlbDocument::Accessor& asked = geometry_.accessor(primitive.position);
        decode_request::Job job;
        job.kind = decode_request::Kind::draco;
        job.attribute = draco.position;
        job.component = asked.component;
        job.stride = static_cast<std::uint32_t>(3 * component_bytes(asked.component));
        job.count = asked.count;
        job.corners = geometry_.accessor(primitive.indices).count;
        job_of_draco[primitive.draco] = add(job, from.buffer, from.offset, from.bytes);
    }

    /// In          index: none adds nothing.
    void add_accessor(std::uint32_t index) {
        if (index == GlbDocument::kNone)
            return;
        const GlbDocument::Accessor& asked = geometry_.accessor(index);
        add_view(asked.view);
        if (asked.sparse != GlbDocument::kNone) {
            add_view(document_.sparse[asked.sparse].index_view);
            add_view(document_.sparse[asked.sparse].value_view);
        }
    }

    DecodeJobs jobs;
    std::vector<std::size_t> job_of_view;  ///< by GlbDocument::compressed
    std::vector<std::size_t> job_of_draco; ///< by GlbDocument::draco

private:
    void add_view(std::uint32_t index) {
        if (index == GlbDocument::kNone)
            return;
        const GlbDocument::View& asked = geometry_.view(index);
        if (!geometry_.is_decoded_view(asked) || job_of_view[asked.compressed] != kNoJob)
            return;
        const GlbDocument::Compressed& compressed = document_.compressed[asked.compressed];
        job_of_view[asked.compressed] =
            add(job_of(compressed), compressed.buffer, compressed.offset, compressed.bytes);
    }

    std::size_t add(const decode_request::Job& job, std::uint32_t buffer, std::uint64_t offset,
                    std::uint64_t bytes) {
        if (std::max(job.count, job.corners) > kLargestGltfSize / 256)
            malformed("compressed geometry has an impossible size");
        const Place from = geometry_.place(buffer, offset, bytes);
        const auto input = [from](std::uint64_t at, std::span<std::byte> to) {
            if (from.file != nullptr)
                from.file->read(from.at + at, to);
            else
                from.temporary->read(from.at + at, to);
        };
        if (job.kind == decode_request::Kind::meshopt_attributes && bytes > 0)
            check_codec(input);
        return jobs.add(job, bytes, input);
    }

    const GltfGeometry& geometry_;
    const GlbDocument& document_;
};

void GltfGeometry::decode(const std::string& path, const SourceOptions& options) {
    Decoding decoding(*this);
    for (const GlbDocument::Primitive& primitive : document_.primitives)
        decoding.add_primitive(primitive);
    for (const GlbDocument::Instances& instances : document_.instances)
        for (const std::uint32_t index :
             {instances.translation, instances.rotation, instances.scale})
            decoding.add_accessor(index);
    DecodeJobs& jobs = decoding.jobs;
    if (jobs.empty())
        return;
    decoded_ = jobs.run(path, options);
    decoded_view_.resize(decoding.job_of_view.size());
    for (std::size_t i = 0; i < decoded_view_.size(); ++i)
        if (const std::size_t job = decoding.job_of_view[i]; job != Decoding::kNoJob)
            decoded_view_[i] = jobs.job(job).output;
    decoded_draco_.resize(decoding.job_of_draco.size());
    for (std::size_t i = 0; i < decoded_draco_.size(); ++i)
        if (const std::size_t job = decoding.job_of_draco[i]; job != Decoding::kNoJob)
            decoded_draco_[i] = {jobs.job(job).output, jobs.job(job).corners_output};
}

} // namespace abut
