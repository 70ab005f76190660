// Vectors of FIPS 180-4 (NIST's examples), and a comparison with nettle.
#include "cell/sha256.hpp"

#include <gtest/gtest.h>
#include <nettle/sha2.h>
#include <rapidcheck/gtest.h>

#include <string>

#include "cell/digest.hpp"

namespace xr3 {
namespace {

Sha256 by_nettle(const std::string& text) {
  sha256_ctx context;
  sha256_init(&context);
  sha256_update(&context, text.size(), reinterpret_cast<const std::uint8_t*>(text.data()));
  Sha256 digest{};
  sha256_digest(&context, digest.size(), digest.data());
  return digest;
}

TEST(Sha256Test, OfExamples) {
  EXPECT_EQ(sha256(""), "sha256:e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256("abc"),
            "sha256:ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "sha256:248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
}

TEST(Sha256Test, OfEachLengthUpToThreeBlocks) {
  std::string text;
  for (int i = 0; i <= 192; ++i, text.push_back(static_cast<char>(i * 7)))
    EXPECT_EQ(sha256_bytes(text), by_nettle(text)) << text.size();
}

RC_GTEST_PROP(Sha256Test, EqualsNettle, (const std::string& text)) {
  RC_ASSERT(sha256_bytes(text) == by_nettle(text));
}

}  // namespace
}  // namespace xr3
