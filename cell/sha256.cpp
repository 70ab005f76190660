#include "cell/sha256.hpp"

#include <bit>
#include <cstddef>
#include <string>

namespace xr3 {
namespace {

using Word = std::uint32_t;

constexpr std::size_t kBlock = 64;  // bytes
constexpr std::size_t kLength = 8;  // bytes of the length, at the end of the last block
constexpr std::size_t kRounds = 64;

/// Section 4.2.2: the fractional parts of the cube roots of the first 64 primes.
constexpr std::array<Word, kRounds> kConstants{
    0x428a2f98, 0x71374491, 0xb5c0fbcf, 0xe9b5dba5, 0x3956c25b, 0x59f111f1, 0x923f82a4, 0xab1c5ed5,
    0xd807aa98, 0x12835b01, 0x243185be, 0x550c7dc3, 0x72be5d74, 0x80deb1fe, 0x9bdc06a7, 0xc19bf174,
    0xe49b69c1, 0xefbe4786, 0x0fc19dc6, 0x240ca1cc, 0x2de92c6f, 0x4a7484aa, 0x5cb0a9dc, 0x76f988da,
    0x983e5152, 0xa831c66d, 0xb00327c8, 0xbf597fc7, 0xc6e00bf3, 0xd5a79147, 0x06ca6351, 0x14292967,
    0x27b70a85, 0x2e1b2138, 0x4d2c6dfc, 0x53380d13, 0x650a7354, 0x766a0abb, 0x81c2c92e, 0x92722c85,
    0xa2bfe8a1, 0xa81a664b, 0xc24b8b70, 0xc76c51a3, 0xd192e819, 0xd6990624, 0xf40e3585, 0x106aa070,
    0x19a4c116, 0x1e376c08, 0x2748774c, 0x34b0bcb5, 0x391c0cb3, 0x4ed8aa4a, 0x5b9cca4f, 0x682e6ff3,
    0x748f82ee, 0x78a5636f, 0x84c87814, 0x8cc70208, 0x90befffa, 0xa4506ceb, 0xbef9a3f7, 0xc67178f2};

/// Section 5.3.3: the fractional parts of the square roots of the first eight primes.
using Hash = std::array<Word, 8>;
constexpr Hash kInitial{0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                        0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};

Word word_at(std::string_view bytes, std::size_t at) {
  Word word = 0;
  for (std::size_t i = 0; i < sizeof word; ++i)
    word = word << 8U | static_cast<std::uint8_t>(bytes[at + i]);
  return word;
}

/// Section 6.2.2, step 1.
std::array<Word, kRounds> schedule(std::string_view block) {
  std::array<Word, kRounds> w{};
  for (std::size_t t = 0; t < 16; ++t) w[t] = word_at(block, t * sizeof(Word));
  for (std::size_t t = 16; t < kRounds; ++t) {
    const Word a = w[t - 15];
    const Word b = w[t - 2];
    w[t] = w[t - 16] + (std::rotr(a, 7) ^ std::rotr(a, 18) ^ a >> 3U) + w[t - 7] +
           (std::rotr(b, 17) ^ std::rotr(b, 19) ^ b >> 10U);
  }
  return w;
}

/// Section 6.2.2, steps 2 to 4.
void add_block(Hash& hash, std::string_view block) {
  const auto w = schedule(block);
  auto [a, b, c, d, e, f, g, h] = hash;
  for (std::size_t t = 0; t < kRounds; ++t) {
    const Word one = h + (std::rotr(e, 6) ^ std::rotr(e, 11) ^ std::rotr(e, 25)) +
                     ((e & f) ^ (~e & g)) + kConstants[t] + w[t];
    const Word two =
        (std::rotr(a, 2) ^ std::rotr(a, 13) ^ std::rotr(a, 22)) + ((a & b) ^ (a & c) ^ (b & c));
    h = g, g = f, f = e, e = d + one, d = c, c = b, b = a, a = one + two;
  }
  const Hash sum{a, b, c, d, e, f, g, h};
  for (std::size_t i = 0; i < hash.size(); ++i) hash[i] += sum[i];
}

/// Section 5.1.1: the bytes after the last whole block, a one, zeros, and the length in bits.
std::string padded(std::string_view rest, std::uint64_t bytes) {
  std::string end(rest);
  end.push_back('\x80');
  const std::size_t blocks = (end.size() + kLength + kBlock - 1) / kBlock;
  end.resize(blocks * kBlock - kLength);
  for (int shift = 56; shift >= 0; shift -= 8)
    end.push_back(static_cast<char>(bytes * 8 >> static_cast<unsigned>(shift)));
  return end;
}

void add_blocks(Hash& hash, std::string_view blocks) {
  for (std::size_t at = 0; at < blocks.size(); at += kBlock)
    add_block(hash, blocks.substr(at, kBlock));
}

}  // namespace

Sha256 sha256_bytes(std::string_view text) {
  const std::size_t whole = text.size() / kBlock * kBlock;
  Hash hash = kInitial;
  add_blocks(hash, text.substr(0, whole));
  add_blocks(hash, padded(text.substr(whole), text.size()));
  Sha256 digest{};
  for (std::size_t i = 0; i < digest.size(); ++i)
    digest[i] = static_cast<std::uint8_t>(hash[i / 4] >> (24 - i % 4 * 8));
  return digest;
}

}  // namespace xr3
