// solver/base/sha256.h
//
// The hash function SHA-256 (FIPS 180-4), by which damaged data are detected.

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace penumbra {

// Computes the SHA-256 digest of a sequence of bytes, which is passed in one or more parts.
class Sha256 {
 public:
  Sha256& Update(std::string_view bytes);
  // Returns the digest of all bytes passed to Update(), as 64 lower-case hexadecimal digits. After Finish(),
  // no function of the object may be called.
  std::string Finish();

 private:
  void Process(const unsigned char* block);

  std::array<std::uint32_t, 8> state_ = {0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                                         0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
  std::array<unsigned char, 64> pending_ = {};
  std::size_t pending_size_ = 0;
  std::uint64_t length_ = 0;  // the number of bytes that have been passed to Update() so far
};

}  // namespace penumbra
