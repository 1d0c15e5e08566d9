#include "arguments/output_files.h"

#include <abut/error.h>

#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <stdlib.h>
#include <sys/file.h>
#include <system_error>
#include <unistd.h>

namespace abut::command {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void fail(const fs::path& path, const std::string& why) {
    throw Error(ErrorCode::cannot_write, path.string(), "cannot be written: " + why);
}

/// Creates a new hidden folder inside `folder`. Errors: Error{cannot_write} naming `blame`.
fs::path make_staging(const fs::path& folder, const fs::path& blame) {
    std::string name = (folder / ".abut-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr)
        fail(blame, std::strerror(errno));
    return name;
}

/// A lock on a folder for writers of files that belong together. It has no effect on file systems
/// without locks.
class FolderLock {
public:
    explicit FolderLock(const fs::path& folder)
        : descriptor_(open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
        while (descriptor_ >= 0 && flock(descriptor_, LOCK_EX) != 0 && errno == EINTR) {
        }
    }
    ~FolderLock() {
        if (descriptor_ >= 0)
            close(descriptor_);
    }
    FolderLock(const FolderLock&) = delete;
    FolderLock& operator=(const FolderLock&) = delete;

private:
    int descriptor_;
};

/// Exchanges two files. Returns false if one is missing or a folder, or if the file system cannot
/// exchange files.
bool exchange(const fs::path& a, const fs::path& b) {
    std::error_code ignored;
    return !fs::is_directory(a, ignored) && !fs::is_directory(b, ignored) &&
           renameat2(AT_FDCWD, a.c_str(), AT_FDCWD, b.c_str(), RENAME_EXCHANGE) == 0;
}

} // namespace

OutputFiles::OutputFiles(fs::path folder, std::vector<std::string> names)
    : folder_(folder.empty() ? fs::path(".") : std::move(folder)), names_(std::move(names)) {
    std::error_code fault;
    fs::path existing = fs::absolute(folder_, fault).lexically_normal();
    if (fault)
        fail(folder_, fault.message());
    while (!fs::exists(existing, fault) && existing.has_relative_path()) {
        if (fault)
            fail(folder_, fault.message());
        existing = existing.parent_path();
    }
    if (!fs::is_directory(existing, fault))
        fail(folder_, existing.string() + " is not a folder");
    fs::remove(make_staging(existing, folder_), fault);
    for (const std::string& name : names_)
        if (fs::is_directory(folder_ / name, fault))
            fail(folder_ / name, "it is a folder");
}

OutputFiles::~OutputFiles() {
    std::error_code ignored;
    if (!staging_.empty())
        fs::remove_all(staging_, ignored);
    for (auto folder = created_.rbegin(); folder != created_.rend(); ++folder)
        fs::remove(*folder, ignored); // fails, and keeps it, if it is not empty
}

std::string OutputFiles::path(const std::string& name) const {
    return (folder_ / name).string();
}

void OutputFiles::stage(const std::string& name,
                        const std::function<void(const std::string&)>& write) {
    prepare();
    const std::string staged = (staging_ / name).string();
    try {
        write(staged);
    } catch (const Error& error) {
        if (error.file() != staged)
            throw;
        const std::string message = error.what();
        throw Error(error.code(), path(name), message.substr(staged.size() + 2));
    }
}

void OutputFiles::stage_text(const std::string& name, const std::string& text) {
    stage(name, [&](const std::string& staged) {
        std::ofstream file(staged, std::ios::binary);
        file << text;
        file.close();
        if (!file)
            throw Error(ErrorCode::cannot_write, staged,
                        std::string("cannot be written: ") + std::strerror(errno));
    });
}

void OutputFiles::commit() {
    const FolderLock lock(folder_);
    std::size_t moved = 0;
    try {
        for (; moved < names_.size(); ++moved)
            move(names_[moved]);
    } catch (const Error&) {
        while (moved > 0)
            move_back(names_[--moved]);
        throw;
    }
    created_.clear();
}

/// Moves a staged file to its place. A file of an earlier run is exchanged with it and moves to the
/// staging folder.
void OutputFiles::move(const std::string& name) {
    const fs::path staged = staging_ / name, place = folder_ / name;
    if (exchange(staged, place))
        return;
    std::error_code fault;
    fs::rename(staged, place, fault);
    if (fault)
        fail(place, fault.message());
}

void OutputFiles::move_back(const std::string& name) noexcept {
    const fs::path staged = staging_ / name, place = folder_ / name;
    std::error_code ignored;
    if (!exchange(staged, place))
        fs::rename(place, staged, ignored);
}

void OutputFiles::prepare() {
    if (!staging_.empty())
        return;
    fs::path reached;
    for (const fs::path& step : folder_) {
        reached /= step;
        std::error_code fault;
        if (!step.empty() && fs::create_directory(reached, fault))
            created_.push_back(reached);
        if (fault)
            fail(folder_, fault.message());
    }
    staging_ = make_staging(folder_, folder_);
}

} // namespace abut::command
