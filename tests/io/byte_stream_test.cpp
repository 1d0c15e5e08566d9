// A file read buffer by buffer gives the same bytes as in memory.

#include "io/file/byte_stream.h"
#include "io/file/text_scan.h"
#include "tests/io/support.h"
#include "tests/support/random.h"

#include <algorithm>

namespace abut::test {
namespace {

/// The buffer size of ByteStream.
constexpr std::size_t kBlock = std::size_t{1} << 18;

/// A text of blanks, line ends and words; some are longer than one or two buffers.
std::string random_text(Random& random, std::size_t bytes) {
    static constexpr std::string_view kBlanks = " \t\n\r", kLetters = "abc-0.";
    std::string text;
    bool blank = random.chance(0.5);
    for (; text.size() < bytes; blank = !blank) {
        const std::string_view of = blank ? kBlanks : kLetters;
        const int longest = random.chance(0.0005) ? 900'000 : 60;
        const int length = random.integer(1, longest);
        for (int i = 0; i < length; ++i)
            text += of[static_cast<std::size_t>(random.bits() % of.size())];
    }
    text.resize(bytes);
    return text;
}

std::vector<std::string> words(ByteStream stream) {
    std::vector<std::string> all;
    for (std::string_view word = take_word(stream); !word.empty(); word = take_word(stream))
        all.emplace_back(word);
    return all;
}

std::vector<std::string> lines(ByteStream stream) {
    std::vector<std::string> all;
    LineScan scan(stream);
    for (std::string_view line; scan.next(line);)
        all.emplace_back(line);
    EXPECT_EQ(scan.number(), all.size());
    return all;
}

TEST(ByteStreams, AFileReadByBuffersEqualsTheFileInMemory) {
    Random random(1);
    const TemporaryFolder folder;
    std::size_t long_words = 0;
    for (int round = 0; round < 24; ++round) {
        // Every other file ends at a buffer's border, or one byte beside it.
        const std::size_t bytes =
            round % 2 == 0
                ? static_cast<std::size_t>(random.integer(1, 5)) * kBlock - 1 + random.bits() % 3
                : static_cast<std::size_t>(random.integer(1, 1'500'000));
        const std::string text = random_text(random, bytes);
        const std::string path = folder.file("text", text);
        EXPECT_EQ(ByteStream::open(path).left(), text.size());
        const auto expected = words(ByteStream(text));
        EXPECT_EQ(words(ByteStream::open(path)), expected);
        EXPECT_EQ(lines(ByteStream::open(path)), lines(ByteStream(text)));
        long_words += static_cast<std::size_t>(
            std::count_if(expected.begin(), expected.end(),
                          [](const std::string& word) { return word.size() > kBlock; }));

        ByteStream stream = ByteStream::open(path);
        std::string taken;
        while (stream.has(1)) {
            const std::size_t wanted = 1 + random.bits() % (2 * kBlock);
            const std::size_t count = stream.has(wanted) ? wanted : stream.ahead().size();
            taken += stream.ahead().substr(0, count);
            stream.take(count);
            EXPECT_EQ(stream.left(), text.size() - taken.size());
        }
        EXPECT_EQ(taken, text);
    }
    EXPECT_GT(long_words, 0U);
}

} // namespace
} // namespace abut::test
