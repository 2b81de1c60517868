// SHA-256 gives the digests that FIPS 180-4 publishes, however the bytes are cut into pieces.

#include "solver/base/sha256.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace penumbra {
namespace {

std::string Digest(std::string_view bytes, std::size_t piece) {
  Sha256 digest;
  for (std::size_t at = 0; at < bytes.size(); at += piece) digest.Update(bytes.substr(at, piece));
  return digest.Finish();
}

TEST(Sha256, GivesThePublishedDigests) {
  const std::string million(1'000'000, 'a');
  for (const std::size_t piece : {1, 7, 63, 64, 65, 1'000'000}) {
    EXPECT_EQ(Digest("", piece), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    EXPECT_EQ(Digest("abc", piece), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    EXPECT_EQ(Digest("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq", piece),
              "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
    EXPECT_EQ(Digest(million, piece), "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
  }
}

}  // namespace
}  // namespace penumbra
