#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <sys/types.h>
#include <vector>

namespace abut::test {

/// What a finished program left.
struct Outcome {
    int status = -1; ///< exit status; 128 + N if signal N ended it, as a shell says it
    std::string out, err;
    /// The processor time that it used, with that of the children it waited for.
    std::chrono::microseconds processor_time{};

    [[nodiscard]] nlohmann::json json() const { return nlohmann::json::parse(out); }
};

/// Runs a program with its arguments to its end. watch: called some times a second while it runs,
/// with its process and what it has printed so far.
using Watch = std::function<void(pid_t process, const Outcome& so_far)>;
Outcome run_program(const std::vector<std::string>& command, const Watch& watch = {});

/// Runs `abut ARGUMENTS` to its end.
Outcome run_abut(const std::vector<std::string>& arguments);

/// Runs `abut ARGUMENTS`, sends the signal as soon as one of its outputs holds `sign`, and waits for
/// its end.
///
/// A run that ends before fails the test.
Outcome run_abut_and_signal(const std::vector<std::string>& arguments, const std::string& sign,
                            int signal);

/// Runs `abut ARGUMENTS` and kills it (SIGKILL) once it has used this much processor time, unless it
/// has ended by then. Processor time, since the load of a machine moves the clock on the wall
/// without any work.
Outcome run_abut_and_kill(const std::vector<std::string>& arguments,
                          std::chrono::duration<double, std::micro> after);

/// A folder of its own, removed with everything in it.
class TemporaryFolder {
public:
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    /// The path of a file in it.
    [[nodiscard]] std::string operator/(const std::string& name) const;
    /// Writes a file and returns its path.
    [[nodiscard]] std::string write(const std::string& name, const std::string& content) const;
    /// Sorted paths of all that it holds, relative to it.
    [[nodiscard]] std::vector<std::string> list() const;

private:
    std::filesystem::path path_;
};

/// While it lives, a folder and its files are read-only, and programs are run by someone whom that binds:
/// by nobody, where the tests run as root.
class ReadOnly {
public:
    explicit ReadOnly(const TemporaryFolder& folder);
    ~ReadOnly();
    ReadOnly(const ReadOnly&) = delete;
    ReadOnly& operator=(const ReadOnly&) = delete;

    /// False where nobody may not run this build: it lies in somebody's own folder.
    [[nodiscard]] static bool can_run_abut();

private:
    void set_modes(std::filesystem::perms folder, std::filesystem::perms file) const;

    std::filesystem::path folder_;
};

std::string read_file(const std::string& path);

/// The clashes of a JSON report, without what a store alone knows of them.
nlohmann::json clashes_of(const Outcome& outcome);

/// Refused input: status 2, nothing on standard output, one line on standard error that holds every
/// word.
void expect_refused(const Outcome& outcome, const std::vector<std::string>& words);

} // namespace abut::test
