#include "io/file/companion_file.h"

#include "io/file/fault.h"

#include <algorithm>
#include <filesystem>

namespace abut {

namespace {

namespace fs = std::filesystem;

bool is_within(const fs::path& path, const fs::path& folder) {
    const auto [end, at] = std::mismatch(folder.begin(), folder.end(), path.begin(), path.end());
    return end == folder.end() && at != path.end();
}

} // namespace

std::string companion_path(const std::string& model, const std::string& reference,
                           bool allow_outside) {
    const fs::path folder = fs::path(model).parent_path();
    const fs::path path = folder / reference;
    if (allow_outside)
        return path;
    std::error_code error;
    const fs::path real_folder = fs::canonical(folder.empty() ? fs::path(".") : folder, error);
    // If the file or a folder on its path is missing, the caller that opens it reports that.
    const fs::path real = error ? fs::path() : fs::weakly_canonical(path, error);
    if (error || !is_within(real, real_folder))
        throw Fault(ErrorCode::unsupported,
                    "refers to " + reference.substr(0, 200) +
                        ", which lies outside its folder and must be allowed explicitly");
    return real;
}

} // namespace abut
