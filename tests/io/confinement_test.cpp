// A reader's process can open only its file, and can reach neither the network nor other programs.
// Forked processes test the function that takes these rights away. Then a Node.js script tries the
// same through the library.

#include "io/process/scene_stream.h"
#include "io/reader/confine.h"
#include "tests/io/sample_files.h"
#include "tests/io/support.h"

#include <cerrno>
#include <csignal>
#include <cstdint>
#include <fcntl.h>
#include <functional>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <thread>

namespace abut::test {
namespace {

constexpr int kDenied = 0, kAllowed = 1, kOtherFault = 2, kNotEnforced = 3;

/// Whether a call was allowed, refused for lack of rights, or failed otherwise.
int judged(std::int64_t result) {
    if (result >= 0)
        return kAllowed;
    return errno == EPERM || errno == EACCES || errno == ENOSYS ? kDenied : kOtherFault;
}

/// The result of an action in a process that is confined first.
template <typename Confine>
int in_confined_process(const Confine& confine, bool Confinement::*needed,
                        const std::function<int()>& action) {
    const pid_t child = fork();
    if (child == 0) {
        const Confinement enforced = confine();
        _exit(enforced.*needed ? action() : kNotEnforced);
    }
    int status = 0;
    EXPECT_EQ(waitpid(child, &status, 0), child);
    EXPECT_TRUE(WIFEXITED(status)) << "signal " << WTERMSIG(status);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

class ConfinementOfReaders : public testing::Test {
protected:
    TemporaryFolder folder_;
    std::string model_ = folder_.file("model.obj", "v 0 0 0\n");
    std::string other_ = folder_.file("other.obj", "v 1 1 1\n");
};

#define ABUT_EXPECT_OR_SKIP(outcome, expected)                                                     \
    do {                                                                                           \
        const int judgement = (outcome);                                                           \
        if (judgement == kNotEnforced)                                                             \
            GTEST_SKIP() << "this kernel does not enforce it";                                     \
        EXPECT_EQ(judgement, expected);                                                            \
    } while (false)

TEST_F(ConfinementOfReaders, OnlyTheModelIsOpened) {
    const auto confine = [&] { return confine_reader(model_); };
    const auto opens = [&](const std::string& path, int flags) {
        return in_confined_process(confine, &Confinement::files,
                                   [&] { return judged(open(path.c_str(), flags, 0600)); });
    };
    ABUT_EXPECT_OR_SKIP(opens(model_, O_RDONLY), kAllowed);
    EXPECT_EQ(opens(other_, O_RDONLY), kDenied);
    EXPECT_EQ(opens("/etc/passwd", O_RDONLY), kDenied);
    EXPECT_EQ(opens(folder_.path(""), O_RDONLY | O_DIRECTORY), kDenied);
    EXPECT_EQ(opens(model_, O_RDWR), kDenied);
    EXPECT_EQ(opens(folder_.path("new.obj"), O_WRONLY | O_CREAT), kDenied);
    EXPECT_FALSE(std::filesystem::exists(folder_.path("new.obj")));
}

TEST_F(ConfinementOfReaders, WritingIsRefusedEvenWithoutRulesOfFiles) {
    const auto confine = [&] { return confine_reader(model_); };
    const auto opens = [&](int flags) {
        return in_confined_process(confine, &Confinement::calls,
                                   [&] { return judged(open(model_.c_str(), flags, 0600)); });
    };
    ABUT_EXPECT_OR_SKIP(opens(O_RDONLY), kAllowed);
    for (const int flags : {O_WRONLY, O_RDWR, O_RDONLY | O_CREAT, O_RDONLY | O_TRUNC})
        EXPECT_EQ(opens(flags), kDenied) << flags;
}

TEST_F(ConfinementOfReaders, DecodersOpenNothingAtAll) {
    const auto confine = [] { return confine_reader(""); };
    ABUT_EXPECT_OR_SKIP(in_confined_process(confine, &Confinement::calls,
                                            [&] { return judged(open(model_.c_str(), O_RDONLY)); }),
                        kDenied);
}

TEST_F(ConfinementOfReaders, NoSocketNoProgramNoOtherProcess) {
    const pid_t parent = getpid();
    for (const bool is_program : {false, true}) {
        SCOPED_TRACE(is_program);
        const auto denied = [&](const std::function<std::int64_t()>& call) {
            return in_confined_process(
                [&] {
                    return is_program ? confine_program("/bin/true", {}) : confine_reader(model_);
                },
                &Confinement::calls, [&] { return judged(call()); });
        };
        ABUT_EXPECT_OR_SKIP(denied([] { return socket(AF_INET, SOCK_STREAM, 0); }), kDenied);
        EXPECT_EQ(denied([] { return socket(AF_UNIX, SOCK_STREAM, 0); }), kDenied);
        EXPECT_EQ(denied([] { return fork(); }), kDenied);
        EXPECT_EQ(denied([&] { return kill(parent, 0); }), kDenied);
        EXPECT_EQ(denied([&] { return kill(getpid(), 0); }), is_program ? kAllowed : kDenied);
        if (!is_program) {
            EXPECT_EQ(denied([] { return execl("/bin/true", "true", nullptr); }), kDenied);
            EXPECT_EQ(denied([] {
                          return mmap(nullptr, 4096, PROT_READ | PROT_EXEC,
                                      MAP_PRIVATE | MAP_ANONYMOUS, -1, 0) == MAP_FAILED
                                     ? -1
                                     : 0;
                      }),
                      kDenied);
        }
    }
}

TEST_F(ConfinementOfReaders, AProgramReadsWhatItIsGiven) {
    const std::string inside = folder_.path("inside");
    std::filesystem::create_directory(inside);
    (void)folder_.file("inside/script", "text");
    const auto opens = [&](const std::string& path, int flags) {
        return in_confined_process(
            [&] {
                return confine_program("/bin/true", {inside, model_});
            },
            &Confinement::files, [&] { return judged(open(path.c_str(), flags, 0600)); });
    };
    ABUT_EXPECT_OR_SKIP(opens(model_, O_RDONLY), kAllowed);
    EXPECT_EQ(opens(inside + "/script", O_RDONLY), kAllowed);
    EXPECT_EQ(opens(other_, O_RDONLY), kDenied);
    EXPECT_EQ(opens("/etc/passwd", O_RDONLY), kDenied);
    EXPECT_EQ(opens(inside + "/script", O_WRONLY), kDenied);
    EXPECT_EQ(opens(inside + "/new", O_WRONLY | O_CREAT), kDenied);
}

TEST_F(ConfinementOfReaders, AProgramMayHaveThreads) {
    const int said =
        in_confined_process([] { return confine_program("/bin/true", {}); }, &Confinement::calls,
                            [] {
                                bool ran = false;
                                std::thread([&] { ran = true; }).join();
                                return ran ? kAllowed : kOtherFault;
                            });
    ABUT_EXPECT_OR_SKIP(said, kAllowed);
}

/// Runs a converter for IFC that tries what a hostile file might make a reader do, and reports what
/// happened in its result.
TEST_F(ConfinementOfReaders, TheReaderOfIfcIsConfined) {
    if (in_confined_process([] { return confine_program("/bin/true", {}); }, &Confinement::files,
                            [] { return kAllowed; }) == kNotEnforced)
        GTEST_SKIP() << "this kernel has no Landlock";
    if (std::system("node --version > /dev/null 2>&1") != 0) // NOLINT: one thread
        GTEST_SKIP() << "Node.js is not installed";
    std::filesystem::create_directories(folder_.path("converter/node_modules/web-ifc"));
    const std::string ifc = folder_.file("model.ifc", "ISO-10303-21;\n");
    (void)folder_.file("converter/package.json", R"({"type": "module"})");
    std::string script = R"(
import fs from 'node:fs';
import net from 'node:net';
import child from 'node:child_process';
const tried = action => { try { action(); return 'done'; } catch (error) { return error.code ?? 'fault'; } };
const said = [
    'model ' + tried(() => fs.readFileSync(process.argv[2])),
    'passwd ' + tried(() => fs.readFileSync('/etc/passwd')),
    'sibling ' + tried(() => fs.readFileSync('OTHER')),
    'write ' + tried(() => fs.writeFileSync('NEW', 'x')),
    'spawn ' + tried(() => { const {error} = child.spawnSync('/bin/true'); if (error) throw error; }),
];
const end = text => {
    const header = Buffer.alloc(HEADER_BYTES);
    Buffer.from('MAGIC').copy(header);
    header.writeUInt32LE(STATUS, 8);
    header.writeUInt32LE(text.length, 12);
    fs.writeSync(3, Buffer.concat([header, Buffer.from(text)]));
    process.exit(0);
};
const socket = net.connect(9, '127.0.0.1');
socket.on('error', error => end(said.concat('socket ' + error.code).join(', ')));
socket.on('connect', () => end(said.concat('socket done').join(', ')));
)";
    const auto replace = [&](const std::string& word, const std::string& with) {
        script.replace(script.find(word), word.size(), with);
    };
    replace("OTHER", other_);
    replace("NEW", folder_.path("new"));
    replace("HEADER_BYTES", std::to_string(sizeof(scene_stream::Header)));
    replace("MAGIC", std::string(scene_stream::kMagic, sizeof scene_stream::kMagic));
    replace("STATUS", std::to_string(1 + static_cast<int>(ErrorCode::malformed)));
    (void)folder_.file("converter/convert.mjs", script);
    const Environment converter("ABUT_IFC_CONVERTER", folder_.path("converter"));
    const std::string text = error_of(ifc, ErrorCode::malformed);
    EXPECT_NE(text.find("model done, passwd EACCES, sibling EACCES, write EACCES, spawn E"),
              std::string::npos)
        << text;
    EXPECT_EQ(text.find("spawn done"), std::string::npos) << text;
    EXPECT_EQ(text.find("socket done"), std::string::npos) << text;
    EXPECT_EQ(text.find("ECONNREFUSED"), std::string::npos) << text; // it reached the network
    EXPECT_NE(text.find("socket E"), std::string::npos) << text;
    EXPECT_FALSE(std::filesystem::exists(folder_.path("new")));
}

} // namespace
} // namespace abut::test
