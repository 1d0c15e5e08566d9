// A reader that crashes, hangs, lies or takes too much memory gives an error that names the file.

#include "io/process/scene_stream.h"
#include "tests/io/sample_files.h"
#include "tests/io/support.h"
#include "tests/support/paths.h"

#include <atomic>
#include <chrono>
#include <csignal>
#include <sys/resource.h>
#include <sys/wait.h>
#include <thread>

namespace abut::test {
namespace {

class Isolation : public testing::Test {
protected:
    std::string fail_with(const std::string& script, ErrorCode code,
                          const ReadOptions& options = {}) {
        const Environment reader("ABUT_READER", folder_.script("reader", script));
        return error_of(model_, code, options);
    }
    /// A reader that returns these bytes.
    std::string fail_with_stream(const std::string& bytes, ErrorCode code) {
        return fail_with("cat '" + folder_.file("stream", bytes) + "' >&3\n", code);
    }
    TemporaryFolder folder_;
    std::string model_ = folder_.file("model.dae", sample_files().at("sample.dae"));
};

TEST_F(Isolation, ACrashIsAnError) {
    EXPECT_TRUE(contains(fail_with("kill -SEGV $$\n", ErrorCode::reader_failed), "crashed"));
    EXPECT_TRUE(contains(fail_with("kill -ABRT $$\n", ErrorCode::reader_failed), "crashed"));
    EXPECT_TRUE(contains(fail_with("kill -KILL $$\n", ErrorCode::reader_failed), "crashed"));
}

TEST_F(Isolation, AnExitStatusIsAnError) {
    EXPECT_TRUE(contains(fail_with("exit 3\n", ErrorCode::reader_failed), "status 3"));
    EXPECT_TRUE(contains(fail_with("exit 12\n", ErrorCode::reader_failed), "memory"));
}

TEST_F(Isolation, AHangIsStopped) {
    ReadOptions options;
    options.time_limit = 0.25;
    EXPECT_TRUE(
        contains(fail_with("sleep 1000\n", ErrorCode::reader_failed, options), "after 0.25 s"));
    // A reader that ignores signals is stopped too, and one that closes its outputs.
    fail_with("trap '' TERM INT HUP\nwhile :; do sleep 1000; done\n", ErrorCode::reader_failed,
              options);
    fail_with("exec 3>&- 4>&-\nsleep 1000\n", ErrorCode::reader_failed, options);
}

TEST_F(Isolation, ChildrenOfAReaderAreKilled) {
    const std::string note = folder_.path("pid");
    fail_with("sleep 1000 & echo $! > '" + note + "'\nexit 0\n", ErrorCode::reader_failed);
    const int left = std::stoi(read_bytes(note));
    // The process now has another parent; give that one time to reap it.
    bool gone = false;
    for (int i = 0; i < 3000 && !gone; ++i) {
        const std::string status = read_bytes("/proc/" + std::to_string(left) + "/stat");
        gone = status.empty() || contains(status, ") Z ") || contains(status, ") X ");
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    EXPECT_TRUE(gone);
}

TEST_F(Isolation, AStopFlagEndsReading) {
    std::atomic<bool> stop = false;
    ReadOptions options;
    options.progress.stop = &stop;
    std::jthread stopper([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
        stop = true;
    });
    fail_with("sleep 1000\n", ErrorCode::interrupted, options);
    error_of(model_, ErrorCode::interrupted, options); // also before anything begins
}

TEST_F(Isolation, NoResultAndDamagedResults) {
    EXPECT_TRUE(contains(fail_with("exit 0\n", ErrorCode::reader_failed), "no result"));
    fail_with_stream("x", ErrorCode::reader_failed);
    fail_with_stream(std::string(4096, '\0'), ErrorCode::reader_failed);
    fail_with_stream(std::string(4096, '\xff'), ErrorCode::reader_failed);
    fail_with("echo chatter\necho more >&2\nexit 0\n", ErrorCode::reader_failed);
}

/// The output of abut-reader for the sample.
std::string sound_stream(const TemporaryFolder& folder, const std::string& model) {
    const std::string copy = folder.path("copy");
    const std::string reader = std::string(ABUT_BINARY_DIR) + "/bin/abut-reader";
    const Environment choice(
        "ABUT_READER", folder.script("tee", "exec 5>&3\nexec 3>'" + copy + "'\nshift\n'" + reader +
                                                "' $$ \"$@\"\ncat '" + copy + "' >&5\n"));
    EXPECT_EQ(read_scene(model).meshes[0].triangles.size(), kFaces.size());
    return read_bytes(copy);
}

TEST_F(Isolation, PrefixesAndSuffixesOfAStreamAreRefused) {
    const std::string stream = sound_stream(folder_, model_);
    ASSERT_GT(stream.size(), 200U);
    for (std::size_t size = 0; size < stream.size(); size += 7)
        fail_with_stream(stream.substr(0, size), ErrorCode::reader_failed);
    fail_with_stream(stream.substr(0, stream.size() - 1), ErrorCode::reader_failed);
    fail_with_stream(stream + '\0', ErrorCode::reader_failed);
}

TEST_F(Isolation, CountsAndIndicesOfAStreamAreNotTrusted) {
    const std::string stream = sound_stream(folder_, model_);
    const std::size_t mesh = sizeof(scene_stream::Header);
    const auto changed = [&](std::size_t offset, auto value) {
        std::string copy = stream;
        std::memcpy(copy.data() + offset, &value, sizeof value);
        return copy;
    };
    for (const std::size_t count : {std::size_t{16}, std::size_t{24}}) {
        fail_with_stream(changed(count, std::uint64_t{0}), ErrorCode::reader_failed);
        fail_with_stream(changed(count, std::uint64_t{1} << 62), ErrorCode::reader_failed);
        fail_with_stream(changed(count, ~std::uint64_t{0}), ErrorCode::reader_failed);
    }
    // The frame's unit, scale and up axis, then the number of notes.
    for (const double value : {-1.0, std::numeric_limits<double>::infinity(),
                               std::numeric_limits<double>::quiet_NaN()}) {
        fail_with_stream(changed(32, value), ErrorCode::reader_failed);
        fail_with_stream(changed(40, value), ErrorCode::reader_failed);
    }
    fail_with_stream(changed(40, 0.0), ErrorCode::reader_failed);
    fail_with_stream(changed(48, std::uint32_t{4}), ErrorCode::reader_failed);
    fail_with_stream(changed(52, std::uint32_t{1}), ErrorCode::reader_failed);
    fail_with_stream(changed(52, ~std::uint32_t{0}), ErrorCode::reader_failed);
    for (const std::size_t field : {mesh, mesh + 4, mesh + 8}) {
        fail_with_stream(changed(field, std::uint32_t{0}), ErrorCode::reader_failed);
        fail_with_stream(changed(field, ~std::uint32_t{0}), ErrorCode::reader_failed);
    }
    const std::uint32_t vertices = kCorners.size();
    const std::size_t indices = mesh + 12 + std::size_t{vertices} * 12;
    fail_with_stream(changed(indices, vertices), ErrorCode::bad_mesh);
    fail_with_stream(changed(indices, scene_stream::kBadIndex), ErrorCode::bad_mesh);
    const std::size_t matrix = indices + std::size_t{4} * 12;
    fail_with_stream(changed(matrix, std::numeric_limits<double>::quiet_NaN()),
                     ErrorCode::bad_mesh);
    fail_with_stream(changed(matrix + 96, std::uint32_t{1}), ErrorCode::reader_failed);
    for (const std::size_t size :
         {std::size_t{100}, std::size_t{104}, std::size_t{108}, std::size_t{112}})
        fail_with_stream(changed(matrix + size, ~std::uint32_t{0}), ErrorCode::reader_failed);
}

TEST_F(Isolation, AnErrorThatAReaderReportsIsPassedOnAsOneLine) {
    std::string stream(scene_stream::kMagic, 8);
    append(stream, std::uint32_t{1 + static_cast<std::uint32_t>(ErrorCode::malformed)});
    append(stream, std::uint32_t{9});
    append(stream, std::array<std::uint64_t, 5>{});
    EXPECT_TRUE(
        contains(fail_with_stream(stream + "two\nlines", ErrorCode::malformed), "two lines"));
    fail_with_stream(stream + "short", ErrorCode::reader_failed);
    stream[8] = 100;
    fail_with_stream(stream + "two\nlines", ErrorCode::reader_failed);
}

TEST_F(Isolation, MemoryIsLimited) {
    // A million triangles take about 300 MB.
    constexpr int kTriangles = 1'000'000;
    std::string indices;
    for (int i = 0; i < kTriangles; ++i)
        indices += "0 1 2 ";
    std::string text = sample_files().at("sample.dae");
    const std::size_t start = text.find("<p>") + 3;
    text.replace(start, text.find("</p>") - start, indices);
    text.replace(text.find("triangles count=\"4\""), 19,
                 "triangles count=\"" + std::to_string(kTriangles) + "\"");
    const std::string large = folder_.file("large.dae", text);
    ReadOptions options;
    options.memory_limit = std::uint64_t{100} << 20;
    EXPECT_TRUE(contains(error_of(large, ErrorCode::reader_failed, options), "memory"));
    EXPECT_EQ(read_scene(model_, options).parts.size(), 1U);
    // A program that does not limit itself is watched from outside.
    options.memory_limit = std::uint64_t{50} << 20;
    options.time_limit = 60;
    EXPECT_TRUE(
        contains(fail_with("exec tail /dev/zero\n", ErrorCode::reader_failed, options), "memory"));
}

TEST_F(Isolation, AReaderThatIsMissing) {
    const Environment reader("ABUT_READER", folder_.path("nothing"));
    EXPECT_TRUE(contains(error_of(model_, ErrorCode::unsupported), "ABUT_READER"));
}

TEST_F(Isolation, AReaderThatCannotBeStarted) {
    const std::string path = folder_.file("reader", "no program");
    std::filesystem::permissions(path, std::filesystem::perms::owner_all);
    const Environment reader("ABUT_READER", path);
    error_of(model_, ErrorCode::unsupported);
}

TEST_F(Isolation, ChildrenAreReapedAndNoDescriptorIsLeftOpen) {
    const auto open_files = [] {
        return std::distance(std::filesystem::directory_iterator("/proc/self/fd"),
                             std::filesystem::directory_iterator());
    };
    (void)read_scene(model_);
    const auto before = open_files();
    for (int i = 0; i < 5; ++i)
        (void)read_scenes({model_, model_, model_});
    fail_with("kill -SEGV $$\n", ErrorCode::reader_failed);
    EXPECT_EQ(open_files(), before);
    EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1); // no child is left
    rusage usage{};
    getrusage(RUSAGE_CHILDREN, &usage);
    EXPECT_GT(usage.ru_maxrss, 1000); // the reader's peak is known
}

TEST_F(Isolation, ProgressEndsAtOne) {
    ReadOptions options;
    double last = -1;
    options.progress.report = [&](std::string_view stage, double fraction) {
        EXPECT_EQ(stage, "import");
        EXPECT_GE(fraction, last);
        last = fraction;
    };
    (void)read_scenes({model_, model_}, options);
    EXPECT_EQ(last, 1);
}

} // namespace
} // namespace abut::test
