#include "store/database/folder_lock.h"

#include <cerrno>
#include <fcntl.h>
#include <filesystem>
#include <sys/file.h>
#include <unistd.h>

namespace abut {

FolderLock::FolderLock(const std::string& store, Wait wait) {
    const std::string folder = std::filesystem::path(store).parent_path().string();
    folder_ = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (folder_ < 0)
        return;
    int status = 0;
    do
        status = flock(folder_, wait == Wait::yes ? LOCK_EX : LOCK_EX | LOCK_NB);
    while (status != 0 && errno == EINTR);
    is_taken_ = status != 0 && errno == EWOULDBLOCK;
}

FolderLock::~FolderLock() {
    if (folder_ >= 0)
        close(folder_);
}

} // namespace abut
