#include "core/uuid.h"

#include <array>
#include <bit>
#include <cctype>
#include <cstddef>
#include <cstdint>

namespace abut {

namespace {

constexpr std::size_t kBlock = 64;
constexpr std::string_view kDigits = "0123456789abcdef";

using Sha1State = std::array<std::uint32_t, 5>;

std::uint32_t big_endian(std::string_view bytes) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i)
        value = value << 8 | static_cast<unsigned char>(bytes[i]);
    return value;
}

/// Adds a block of 64 bytes to the state [FIPS 180-4, 6.1.2].
void add_sha1_block(Sha1State& state, std::string_view block) {
    constexpr std::size_t kRounds = 80;
    std::array<std::uint32_t, kRounds> w{};
    for (std::size_t t = 0; t < 16; ++t)
        w[t] = big_endian(block.substr(4 * t, 4));
    for (std::size_t t = 16; t < kRounds; ++t)
        w[t] = std::rotl(w[t - 3] ^ w[t - 8] ^ w[t - 14] ^ w[t - 16], 1);
    auto [a, b, c, d, e] = state;
    for (std::size_t t = 0; t < kRounds; ++t) {
        std::uint32_t f = b ^ c ^ d, k = 0xca62c1d6U;
        if (t < 20)
            f = (b & c) | (~b & d), k = 0x5a827999U;
        else if (t < 40)
            k = 0x6ed9eba1U;
        else if (t < 60)
            f = (b & c) | (b & d) | (c & d), k = 0x8f1bbcdcU;
        const std::uint32_t next = std::rotl(a, 5) + f + e + k + w[t];
        e = d, d = c, c = std::rotl(b, 30), b = a, a = next;
    }
    state[0] += a, state[1] += b, state[2] += c, state[3] += d, state[4] += e;
}

std::array<unsigned char, 20> sha1(std::string text) {
    const std::uint64_t bits = std::uint64_t{text.size()} * 8;
    text.push_back('\x80');
    text.resize((text.size() + 8 + kBlock - 1) / kBlock * kBlock - 8, '\0');
    for (unsigned shift = 64; shift > 0; shift -= 8)
        text.push_back(static_cast<char>(bits >> (shift - 8) & 0xffU));
    Sha1State state{0x67452301U, 0xefcdab89U, 0x98badcfeU, 0x10325476U, 0xc3d2e1f0U};
    for (std::size_t at = 0; at < text.size(); at += kBlock)
        add_sha1_block(state, std::string_view(text).substr(at, kBlock));
    std::array<unsigned char, 20> digest{};
    for (std::size_t i = 0; i < digest.size(); ++i)
        digest.at(i) = static_cast<unsigned char>(state.at(i / 4) >> (24 - 8 * (i % 4)) & 0xffU);
    return digest;
}

/// The 16 bytes of a UUID.
std::string bytes_of_uuid(std::string_view text) {
    std::string bytes;
    unsigned value = 0, digits = 0;
    for (const char c : text) {
        const std::size_t digit =
            kDigits.find(static_cast<char>(std::tolower(static_cast<unsigned char>(c))));
        if (digit == std::string_view::npos)
            continue;
        value = value << 4 | static_cast<unsigned>(digit);
        if (++digits % 2 == 0)
            bytes.push_back(static_cast<char>(value & 0xffU));
    }
    return bytes;
}

} // namespace

std::string uuid_of_name(std::string_view space, std::string_view name) {
    auto digest = sha1(bytes_of_uuid(space) + std::string(name));
    digest[6] = static_cast<unsigned char>((digest[6] & 0x0fU) | 0x50U);
    digest[8] = static_cast<unsigned char>((digest[8] & 0x3fU) | 0x80U);
    std::string text;
    for (std::size_t i = 0; i < 16; ++i) {
        if (i == 4 || i == 6 || i == 8 || i == 10)
            text.push_back('-');
        text.push_back(kDigits[digest.at(i) >> 4]);
        text.push_back(kDigits[digest.at(i) & 0x0fU]);
    }
    return text;
}

bool is_uuid(std::string_view text) {
    constexpr std::size_t kLength = 36;
    if (text.size() != kLength)
        return false;
    for (std::size_t i = 0; i < kLength; ++i)
        if (i == 8 || i == 13 || i == 18 || i == 23
                ? text[i] != '-'
                : std::isxdigit(static_cast<unsigned char>(text[i])) == 0)
            return false;
    return true;
}

std::string lower_uuid(std::string uuid) {
    for (char& c : uuid)
        c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    return uuid;
}

} // namespace abut
