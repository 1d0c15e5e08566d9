#include <abut/elementary_impact.h>
#include <abut/error.h>

#include "io/file/byte_stream.h"
#include "io/file/fault.h"
#include "io/file/text_scan.h"
#include "math/integer_polynomial.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <string_view>

namespace abut {

namespace {

constexpr std::size_t kRowsOfPair = 8;
/// More than the digits of the longest numerator or denominator that a double needs.
constexpr std::size_t kMostDigits = 1100;

std::optional<BigInt> parse_integer(std::string_view text) {
    const bool negative = !text.empty() && text.front() == '-';
    if (negative)
        text.remove_prefix(1);
    if (text.empty() || text.size() > kMostDigits ||
        !std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isdigit(c); }))
        return std::nullopt;
    // A leading zero would mean octal digits.
    text.remove_prefix(std::min(text.find_first_not_of('0'), text.size() - 1));
    const BigInt value{std::string(text)};
    return negative ? BigInt(-value) : value;
}

/// Returns the double that equals numerator / denominator, if there is one. In: denominator is not
/// 0.
std::optional<double> exact_double(BigInt numerator, BigInt denominator) {
    if (numerator.is_zero())
        return 0;
    if (denominator.sign() < 0)
        numerator = -numerator, denominator = -denominator;
    const BigInt common = gcd(abs(numerator), denominator);
    numerator /= common;
    denominator /= common;
    const unsigned zeros = lsb(abs(numerator)), halvings = lsb(denominator);
    const BigInt odd = numerator >> zeros;
    if (msb(denominator) != halvings || msb(abs(odd)) >= 53)
        return std::nullopt;
    const int exponent = static_cast<int>(zeros) - static_cast<int>(halvings);
    const auto mantissa = static_cast<double>(static_cast<std::int64_t>(odd));
    const double value = std::ldexp(mantissa, exponent);
    // The result is wrong if it is beyond the largest double, or was rounded as a subnormal.
    return std::ldexp(value, -exponent) == mantissa ? std::optional(value) : std::nullopt;
}

/// Finds the kind in a file's name. Words end at characters that are not letters, so that "ee" is
/// not found in "sheep".
std::optional<ElementaryKind> kind_of_name(const std::string& file) {
    std::string name = std::filesystem::path(file).stem().string();
    for (char& c : name)
        c = std::isalpha(static_cast<unsigned char>(c)) != 0
                ? static_cast<char>(std::tolower(static_cast<unsigned char>(c)))
                : '-';
    name = "-" + name + "-";
    const auto has = [&](const char* word) { return name.find(word) != std::string::npos; };
    const bool vertex_face = has("-vertex-face-") || has("-vf-"),
               edge_edge = has("-edge-edge-") || has("-ee-");
    if (vertex_face == edge_edge)
        return std::nullopt;
    return vertex_face ? ElementaryKind::vertex_face : ElementaryKind::edge_edge;
}

class QueryReader {
public:
    QueryReader(const std::string& file, ElementaryKind kind) : file_(file), kind_(kind) {}

    ElementaryQueries read() {
        try {
            ByteStream content = ByteStream::open(file_);
            LineScan lines(content);
            std::string_view line;
            while (lines.next(line)) {
                number_ = lines.number();
                if (!line.empty())
                    add_row(line);
            }
        } catch (const Fault& fault) {
            throw Error(fault.code(), file_, fault.what());
        }
        if (rows_ % kRowsOfPair != 0)
            fail("the last pair has " + std::to_string(rows_ % kRowsOfPair) + " of 8 rows");
        if (rows_ == 0)
            fail("no rows");
        return std::move(queries_);
    }

private:
    [[noreturn]] void fail(const std::string& fault) const {
        throw Error(ErrorCode::malformed, file_, "line " + std::to_string(number_) + ": " + fault);
    }

    void add_row(std::string_view line) {
        const std::vector<std::string_view> words = split(line);
        if (rows_ == 0)
            columns_ = words.size();
        if (words.size() != columns_ || (columns_ != 6 && columns_ != 7))
            fail("has " + std::to_string(words.size()) + " columns, not " +
                 (rows_ == 0 ? "6 or 7" : std::to_string(columns_)));
        const std::size_t row = rows_++ % kRowsOfPair;
        if (row == 0)
            queries_.pairs.push_back({kind_, {}, {}});
        ElementaryPair& pair = queries_.pairs.back();
        auto& points = row < 4 ? pair.start : pair.end;
        points.at(row % 4) = {number(words[0], words[1]), number(words[2], words[3]),
                              number(words[4], words[5])};
        if (columns_ == 7)
            add_truth(words[6], row);
    }

    static std::vector<std::string_view> split(std::string_view line) {
        std::vector<std::string_view> words;
        for (std::size_t begin = 0; begin <= line.size();) {
            const std::size_t comma = std::min(line.find(',', begin), line.size());
            std::string_view word = line.substr(begin, comma - begin);
            word.remove_prefix(std::min(word.find_first_not_of(' '), word.size()));
            word.remove_suffix(word.size() - (word.find_last_not_of(' ') + 1));
            words.push_back(word);
            begin = comma + 1;
        }
        return words;
    }

    [[nodiscard]] double number(std::string_view numerator, std::string_view denominator) const {
        const auto n = parse_integer(numerator), d = parse_integer(denominator);
        if (!n || !d)
            fail("'" + std::string(n ? denominator : numerator) + "' is not an integer");
        if (d->is_zero())
            fail("a denominator is zero");
        const auto value = exact_double(*n, *d);
        if (!value)
            fail(std::string(numerator) + "/" + std::string(denominator) +
                 " is not exactly a double");
        return *value;
    }

    void add_truth(std::string_view word, std::size_t row) {
        if (word != "0" && word != "1")
            fail("the truth is '" + std::string(word) + "', not 0 or 1");
        const bool truth = word == "1";
        if (row == 0)
            queries_.truth.push_back(truth);
        else if (queries_.truth.back() != truth)
            fail("the truth differs from that of the pair's first row");
    }

    const std::string& file_;
    ElementaryKind kind_;
    ElementaryQueries queries_;
    std::uint64_t number_ = 0;
    std::size_t rows_ = 0, columns_ = 0;
};

} // namespace

ElementaryQueries read_elementary_queries(const std::string& file,
                                          std::optional<ElementaryKind> kind) {
    if (!kind)
        kind = kind_of_name(file);
    if (!kind)
        throw Error(ErrorCode::bad_argument, file,
                    "its name contains neither vertex-face nor edge-edge: give the kind");
    return QueryReader(file, *kind).read();
}

} // namespace abut
