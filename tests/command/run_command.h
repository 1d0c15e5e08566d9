#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <sys/types.h>
#include <vector>

namespace abut::test {

/// Exit status and output of a finished program.
struct Outcome {
    int status = -1; ///< exit status; 128 + N if signal N ended it, as a shell says it
    std::string out, err;
    /// Processor time of the program and the children that it waited for.
    std::chrono::microseconds processor_time{};

    [[nodiscard]] nlohmann::json json() const { return nlohmann::json::parse(out); }
};

/// Runs a program to its end. watch: called several times a second while the program runs, with its
/// process and its output so far.
using Watch = std::function<void(pid_t process, const Outcome& so_far)>;
Outcome run_program(const std::vector<std::string>& command, const Watch& watch = {});

/// Runs `abut ARGUMENTS` to its end.
Outcome run_abut(const std::vector<std::string>& arguments);

/// Runs `abut ARGUMENTS`, sends the signal once an output contains `sign`, and waits for the end.
/// Fails the test if the program ends before.
Outcome run_abut_and_signal(const std::vector<std::string>& arguments, const std::string& sign,
                            int signal);

/// Runs `abut ARGUMENTS` and kills it (SIGKILL) once it has used this much processor time, unless
/// it has ended. Wall-clock time would depend on the load of the machine.
Outcome run_abut_and_kill(const std::vector<std::string>& arguments,
                          std::chrono::duration<double, std::micro> after);

/// A temporary folder, removed with its contents.
class TemporaryFolder {
public:
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    /// The path of a file in the folder.
    [[nodiscard]] std::string operator/(const std::string& name) const;
    /// Writes a file and returns its path.
    [[nodiscard]] std::string write(const std::string& name, const std::string& content) const;
    /// Sorted relative paths of all contents.
    [[nodiscard]] std::vector<std::string> list() const;

private:
    std::filesystem::path path_;
};

/// While it lives, a folder and its files are read-only. If the tests run as root, programs are run
/// as nobody, because permissions do not bind root.
class ReadOnly {
public:
    explicit ReadOnly(const TemporaryFolder& folder);
    ~ReadOnly();
    ReadOnly(const ReadOnly&) = delete;
    ReadOnly& operator=(const ReadOnly&) = delete;

    /// False if nobody may not run this build, because it lies in a private folder.
    [[nodiscard]] static bool can_run_abut();

private:
    void set_modes(std::filesystem::perms folder, std::filesystem::perms file) const;

    std::filesystem::path folder_;
};

std::string read_file(const std::string& path);

/// The clashes of a JSON report, without the keys that only a store adds, and without their groups:
/// a store remembers the groups of earlier jobs.
nlohmann::json clashes_of(const Outcome& outcome);

/// Expects refused input: status 2, nothing on standard output, and one line on standard error that
/// contains every word.
void expect_refused(const Outcome& outcome, const std::vector<std::string>& words);

} // namespace abut::test
