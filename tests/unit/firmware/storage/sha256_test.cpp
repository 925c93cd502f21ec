#include "firmware/storage/sha256.h"

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "runtime/service/digest.h"

namespace stepwright::storage {
namespace {

std::string hex(const Digest& digest) {
  return service::to_hex(digest);
}

Digest of(const std::string& text) {
  return sha256(std::as_bytes(std::span(text)));
}

// NIST, examples of FIPS 180-4.
TEST(Sha256, Digest_WhenTextIsOfTheStandard_ThenIsItsDigest) {
  EXPECT_EQ(hex(of("")), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(hex(of("abc")), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(hex(of("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq")),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(hex(of(std::string(1'000'000, 'a'))),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

// Every length around the ends of blocks, in pieces of uneven size, against libsodium.
TEST(Sha256, Digest_WhenBytesComeInPieces_ThenIsThatOfLibsodium) {
  std::mt19937 random(1);
  for (std::size_t length = 0; length < 300; ++length) {
    std::vector<std::byte> bytes(length);
    for (std::byte& byte : bytes) byte = static_cast<std::byte>(random());
    Sha256 sum;
    for (std::size_t at = 0; at < length;) {
      const std::size_t part = std::min<std::size_t>(length - at, 1 + random() % 70);
      sum.add(std::span(bytes).subspan(at, part));
      at += part;
    }
    ASSERT_EQ(sum.finish(), service::sha256(bytes)) << length;
  }
}

}  // namespace
}  // namespace stepwright::storage
