#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace abut::command {

/// Files of one folder that appear together or not at all.
///
/// Before the work: the constructor proves that the folder can be written (or created) and leaves
/// no trace. After it: stage() each file, then commit(). Without a commit() everything is taken
/// back, folders that were created included; files of an earlier run stay as they are.
class OutputFiles {
public:
    /// Errors      Error{cannot_write}, naming the folder or the file.
    OutputFiles(std::filesystem::path folder, std::vector<std::string> names);
    ~OutputFiles();
    OutputFiles(const OutputFiles&) = delete;
    OutputFiles& operator=(const OutputFiles&) = delete;

    /// The final path of a file.
    [[nodiscard]] std::string path(const std::string& name) const;

    /// Calls write(path) with a path beside the final one; errors of `write` are made to name the
    /// final path.
    void stage(const std::string& name, const std::function<void(const std::string&)>& write);

    void stage_text(const std::string& name, const std::string& text);

    /// Moves all staged files to their places, while no other process does so in this folder.
    ///
    /// Errors      Error{cannot_write}, naming the file; all files are again as they were before.
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
