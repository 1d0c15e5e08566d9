#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace abut::command {

/// Files of one folder that appear together or not at all.
///
/// The constructor is called before the work. It proves that the folder can be written or created,
/// and leaves no trace. After the work, call stage() for each file, then commit(). Without
/// commit(), the destructor removes everything, including folders that were created. Files of an
/// earlier run then stay as they are.
class OutputFiles {
public:
    /// Errors      Error{cannot_write}, naming the folder or the file.
    OutputFiles(std::filesystem::path folder, std::vector<std::string> names);
    ~OutputFiles();
    OutputFiles(const OutputFiles&) = delete;
    OutputFiles& operator=(const OutputFiles&) = delete;

    /// The final path of a file.
    [[nodiscard]] std::string path(const std::string& name) const;

    /// Calls write(path) with the path of a temporary file. Errors of `write` that name it are
    /// changed to name the final path.
    void stage(const std::string& name, const std::function<void(const std::string&)>& write);

    void stage_text(const std::string& name, const std::string& text);

    /// Moves all staged files to their places. A lock excludes other processes that do so in this
    /// folder.
    ///
    /// Errors      Error{cannot_write}, naming the file; all files are restored first.
    void commit();

private:
    void prepare();
    void move(const std::string& name);
    void move_back(const std::string& name) noexcept;

    std::filesystem::path folder_;
    std::vector<std::string> names_;
    std::vector<std::filesystem::path> created_; ///< folders, outermost first
    std::filesystem::path staging_;              ///< empty until the first stage()
};

} // namespace abut::command
