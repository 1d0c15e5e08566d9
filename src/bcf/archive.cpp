#include "bcf/archive.h"

#include <abut/error.h>

#include "clash/report/clash_text.h"

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <unordered_set>
#include <zip.h>

namespace abut {

namespace {

/// 1980-01-01, the first day that zip knows.
constexpr zip_uint16_t kFixedDate = 0x21;
constexpr zip_uint32_t kPlainFile = 0100644U << 16U;
constexpr std::size_t kChunk = std::size_t{1} << 16;

struct CloseArchive {
    void operator()(zip_t* archive) const { zip_discard(archive); }
};
struct CloseEntry {
    void operator()(zip_file_t* entry) const { zip_fclose(entry); }
};
struct FreeSource {
    void operator()(zip_source_t* source) const { zip_source_free(source); }
};
using Archive = std::unique_ptr<zip_t, CloseArchive>;

std::string words_of(zip_error_t& error) {
    std::string words = zip_error_strerror(&error);
    zip_error_fini(&error);
    return words;
}

Archive open_archive(const std::string& bytes, const std::string& file) {
    zip_error_t error;
    zip_error_init(&error);
    zip_source_t* source = zip_source_buffer_create(bytes.data(), bytes.size(), 0, &error);
    if (source == nullptr)
        throw Error(ErrorCode::malformed, file, words_of(error));
    Archive archive(zip_open_from_source(source, ZIP_RDONLY, &error));
    if (archive == nullptr) {
        zip_source_free(source);
        throw Error(ErrorCode::malformed, file, "not a zip archive: " + words_of(error));
    }
    return archive;
}

/// A name as errors show it: one line of valid text.
std::string shown_name(std::string_view name) {
    std::string text = valid_utf8(name.substr(0, 200));
    for (char& c : text)
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
            c = '?';
    return text;
}

/// Returns the name with forward slashes, which some programs do not write.
std::string checked_name(const char* raw, const std::string& file) {
    std::string name = raw == nullptr ? "" : raw;
    std::ranges::replace(name, '\\', '/');
    const bool is_plain =
        !name.empty() && name == valid_utf8(name) &&
        std::ranges::none_of(name, [](unsigned char c) { return c < 0x20 || c == 0x7f; });
    const bool is_folder = !name.empty() && name.back() == '/';
    const std::string path = is_folder ? name.substr(0, name.size() - 1) : name;
    if (!is_plain || path.find(':') != std::string::npos || entry_of("", path) != path)
        throw Error(ErrorCode::malformed, file,
                    "the name '" + shown_name(name) + "' leads out of the archive");
    return name;
}

std::string read_entry(zip_t& archive, const zip_stat_t& stat, const std::string& file,
                       const std::string& name, std::uint64_t most) {
    const auto fail = [&](const std::string& what) {
        throw Error(ErrorCode::malformed, file, name + ": " + what);
    };
    if ((stat.valid & ZIP_STAT_ENCRYPTION_METHOD) != 0 && stat.encryption_method != ZIP_EM_NONE)
        fail("is encrypted");
    if ((stat.valid & ZIP_STAT_COMP_METHOD) != 0 && stat.comp_method != ZIP_CM_STORE &&
        stat.comp_method != ZIP_CM_DEFLATE)
        fail("is compressed in a way that BCF does not use");
    const std::unique_ptr<zip_file_t, CloseEntry> entry(zip_fopen_index(&archive, stat.index, 0));
    if (entry == nullptr)
        fail(zip_strerror(&archive));
    std::string bytes;
    std::array<char, kChunk> chunk{};
    while (true) {
        const zip_int64_t count = zip_fread(entry.get(), chunk.data(), chunk.size());
        if (count < 0)
            fail(std::string("damaged: ") + zip_file_strerror(entry.get()));
        if (count == 0)
            return bytes;
        if (bytes.size() + static_cast<std::uint64_t>(count) > most)
            fail("unpacks to more bytes than are allowed");
        bytes.append(chunk.data(), static_cast<std::size_t>(count));
    }
}

bool is_compressed(const std::string& name) {
    return name.ends_with(".png") || name.ends_with(".jpg") || name.ends_with(".jpeg");
}

void add_entry(zip_t& archive, const BcfEntry& entry) {
    zip_source_t* source = zip_source_buffer(&archive, entry.bytes.data(), entry.bytes.size(), 0);
    const zip_int64_t index =
        source == nullptr ? -1
                          : zip_file_add(&archive, entry.name.c_str(), source, ZIP_FL_ENC_UTF_8);
    if (index < 0) {
        zip_source_free(source);
        throw Error(ErrorCode::bad_argument, entry.name + ": " + zip_strerror(&archive));
    }
    const auto at = static_cast<zip_uint64_t>(index);
    zip_set_file_compression(&archive, at,
                             is_compressed(entry.name) ? ZIP_CM_STORE : ZIP_CM_DEFLATE, 6);
    zip_file_set_dostime(&archive, at, 0, kFixedDate, 0);
    zip_file_set_external_attributes(&archive, at, 0, ZIP_OPSYS_UNIX, kPlainFile);
}

std::string bytes_of(zip_source_t& source) {
    zip_stat_t stat;
    zip_stat_init(&stat);
    std::string bytes;
    if (zip_source_stat(&source, &stat) == 0 && zip_source_open(&source) == 0) {
        bytes.resize(stat.size);
        const zip_int64_t count = zip_source_read(&source, bytes.data(), bytes.size());
        zip_source_close(&source);
        if (count == static_cast<zip_int64_t>(bytes.size()))
            return bytes;
    }
    throw Error(ErrorCode::cannot_write, "the archive cannot be made in memory");
}

} // namespace

std::optional<std::string> entry_of(std::string_view folder, std::string_view path) {
    if (path.starts_with('/') || path.starts_with('\\'))
        return std::nullopt;
    std::vector<std::string_view> steps;
    for (const std::string_view all : {folder, path})
        for (std::size_t from = 0; from < all.size();) {
            const std::size_t end = std::min(all.find_first_of("/\\", from), all.size());
            const std::string_view step = all.substr(from, end - from);
            from = end + 1;
            if (step.empty() || step == ".")
                continue;
            if (step != "..")
                steps.push_back(step);
            else if (steps.empty())
                return std::nullopt;
            else
                steps.pop_back();
        }
    std::string name;
    for (const std::string_view step : steps)
        name.append(name.empty() ? "" : "/").append(step);
    return name;
}

std::vector<BcfEntry> unpack_archive(const std::string& bytes, const std::string& file,
                                     const BcfLimits& limits) {
    if (bytes.empty())
        throw Error(ErrorCode::malformed, file, "is empty");
    const Archive archive = open_archive(bytes, file);
    const zip_int64_t count = zip_get_num_entries(archive.get(), 0);
    if (count < 0 || static_cast<std::uint64_t>(count) > limits.entries)
        throw Error(ErrorCode::malformed, file, "the archive has too many entries");
    std::vector<BcfEntry> entries;
    std::unordered_set<std::string> names;
    std::uint64_t left = limits.bytes;
    for (zip_int64_t i = 0; i < count; ++i) {
        zip_stat_t stat;
        zip_stat_init(&stat);
        if (zip_stat_index(archive.get(), static_cast<zip_uint64_t>(i), 0, &stat) != 0)
            throw Error(ErrorCode::malformed, file, zip_strerror(archive.get()));
        stat.index = static_cast<zip_uint64_t>(i);
        const std::string name = checked_name(stat.name, file);
        if (!names.insert(name).second)
            throw Error(ErrorCode::malformed, file, "two entries have the name '" + name + "'");
        if (name.back() == '/')
            continue;
        entries.push_back({name, read_entry(*archive, stat, file, name, left)});
        left -= entries.back().bytes.size();
    }
    std::ranges::sort(entries, {}, &BcfEntry::name);
    return entries;
}

std::string pack_archive(std::vector<BcfEntry> entries) {
    std::ranges::sort(entries, {}, &BcfEntry::name);
    for (std::size_t i = 0; i < entries.size(); ++i) {
        const std::string& name = entries[i].name;
        if (name.empty() || entry_of("", name) != name || name != valid_utf8(name))
            throw Error(ErrorCode::bad_argument,
                        "'" + shown_name(name) + "' cannot be the name of an entry");
        if (i > 0 && name == entries[i - 1].name)
            throw Error(ErrorCode::bad_argument, "two entries have the name '" + name + "'");
    }
    zip_error_t error;
    zip_error_init(&error);
    const std::unique_ptr<zip_source_t, FreeSource> source(
        zip_source_buffer_create(nullptr, 0, 0, &error));
    if (source == nullptr)
        throw Error(ErrorCode::cannot_write, words_of(error));
    Archive archive(zip_open_from_source(source.get(), ZIP_TRUNCATE, &error));
    if (archive == nullptr)
        throw Error(ErrorCode::cannot_write, words_of(error));
    zip_source_keep(source.get());
    for (const BcfEntry& entry : entries)
        add_entry(*archive, entry);
    if (zip_close(archive.get()) != 0)
        throw Error(ErrorCode::cannot_write, zip_strerror(archive.get()));
    static_cast<void>(archive.release()); // NOLINT(bugprone-unused-return-value): closed above
    return bytes_of(*source);
}

} // namespace abut
