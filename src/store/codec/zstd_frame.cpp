#include "store/codec/zstd_frame.h"

#include "io/file/fault.h"

#include <memory>
#include <string>
#include <zstd.h>

namespace abut {

namespace {

/// Most of the possible gain, and fast enough to keep up with a disk.
constexpr int kLevel = 3;

struct FreeContext {
    void operator()(ZSTD_CCtx* context) const { ZSTD_freeCCtx(context); }
    void operator()(ZSTD_DCtx* context) const { ZSTD_freeDCtx(context); }
};

} // namespace

std::vector<std::byte> compress(std::span<const std::byte> raw) {
    thread_local const std::unique_ptr<ZSTD_CCtx, FreeContext> context(ZSTD_createCCtx());
    std::vector<std::byte> frame(ZSTD_compressBound(raw.size()));
    const std::size_t size = ZSTD_compressCCtx(context.get(), frame.data(), frame.size(),
                                               raw.data(), raw.size(), kLevel);
    if (ZSTD_isError(size) != 0)
        throw Fault(ErrorCode::cannot_write,
                    std::string("a block cannot be compressed: ") + ZSTD_getErrorName(size));
    frame.resize(size);
    frame.shrink_to_fit();
    return frame;
}

std::uint64_t content_bytes(std::span<const std::byte> frame) {
    return ZSTD_getFrameContentSize(frame.data(), frame.size());
}

std::vector<std::byte> decompress(std::span<const std::byte> frame, std::uint64_t raw_bytes) {
    std::vector<std::byte> raw(raw_bytes);
    thread_local const std::unique_ptr<ZSTD_DCtx, FreeContext> context(ZSTD_createDCtx());
    const std::size_t size =
        ZSTD_decompressDCtx(context.get(), raw.data(), raw.size(), frame.data(), frame.size());
    raw.resize(ZSTD_isError(size) != 0 ? 0 : size);
    return raw;
}

} // namespace abut
