#include "runtime/record/byte_ring.h"

#include <gtest/gtest.h>

#include <numeric>
#include <thread>

#include "runtime/record/recording_format.h"

namespace stepwright::record {
namespace {

std::vector<std::byte> pattern(std::size_t size, unsigned seed) {
  std::vector<std::byte> bytes(size);
  for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<std::byte>(seed + i * 7);
  return bytes;
}

TEST(ByteRing, WhenRecordsOfAllSizesPass_ThenTheyComeOutAsTheyWentIn) {
  ByteRing ring(257);
  std::vector<std::byte> out;
  for (unsigned i = 0; i < 2'000; ++i) {
    const auto head = pattern(i % 11, i);
    const auto body = pattern(i % 113, i + 1);
    ASSERT_TRUE(ring.push({head, body}));
    ASSERT_TRUE(ring.pop(out));
    auto whole = head;
    whole.insert(whole.end(), body.begin(), body.end());
    ASSERT_EQ(out, whole);
  }
  EXPECT_FALSE(ring.pop(out));
}

TEST(ByteRing, WhenItIsFull_ThenARecordIsRefusedWhole) {
  ByteRing ring(64);
  const auto record = pattern(20, 1);
  EXPECT_TRUE(ring.push({record}));
  EXPECT_TRUE(ring.push({record}));
  EXPECT_EQ(ring.room(), 64u - 2 * 24 - 4);
  EXPECT_FALSE(ring.push({record}));
  std::vector<std::byte> out;
  EXPECT_TRUE(ring.pop(out));
  EXPECT_EQ(out, record);
  EXPECT_TRUE(ring.push({record}));
}

TEST(ByteRing, WhenTwoThreadsUseIt_ThenNoRecordIsTornOrLost) {
  ByteRing ring(4'096);
  constexpr unsigned kRecords = 100'000;
  std::thread producer([&] {
    for (unsigned i = 0; i < kRecords;) {
      if (ring.push({std::as_bytes(std::span(&i, 1)), pattern(i % 40, i)})) {
        ++i;
      } else {
        std::this_thread::yield();
      }
    }
  });
  std::vector<std::byte> out;
  for (unsigned expected = 0; expected < kRecords;) {
    if (!ring.pop(out)) {
      std::this_thread::yield();
      continue;
    }
    auto whole = pattern(expected % 40, expected);
    const auto number = std::as_bytes(std::span(&expected, 1));
    whole.insert(whole.begin(), number.begin(), number.end());
    if (out != whole) {
      ADD_FAILURE() << "record " << expected;
      break;
    }
    ++expected;
  }
  producer.join();
}

TEST(Encoder, WhenNumbersOfAllSizesAreWritten_ThenTheyReadTheSame) {
  std::vector<std::byte> buffer(16);
  for (unsigned shift = 0; shift < 64; ++shift) {
    for (const std::uint64_t value : {(std::uint64_t{1} << shift) - 1, std::uint64_t{1} << shift}) {
      Encoder out(buffer);
      out.put_varint(value);
      base::ByteReader in(out.bytes());
      std::uint64_t read = 0;
      EXPECT_TRUE(read_varint(in, read));
      EXPECT_EQ(read, value);
      EXPECT_TRUE(in.at_end());
      const auto number = static_cast<std::int64_t>(value);
      EXPECT_EQ(unzigzag(zigzag(number)), number);
      const auto negative = static_cast<std::int64_t>(0 - value);
      EXPECT_EQ(unzigzag(zigzag(negative)), negative);
    }
  }
}

TEST(Encoder, WhenTheBufferIsTooSmall_ThenItSaysSoAndWritesNothing) {
  std::vector<std::byte> buffer(4);
  Encoder out(buffer);
  EXPECT_TRUE(out.put(std::uint32_t{1}).good());
  EXPECT_FALSE(out.put(std::uint8_t{1}).good());
  EXPECT_EQ(out.bytes().size(), 4u);
}

// The check value of CRC-32C: of "123456789".
TEST(ChunkCrc, WhenItIsOfAKnownText_ThenItHasTheKnownValue) {
  ChunkHeader header;
  header.sequence = 0x34333231;  // "1234"
  header.bytes = 0x38373635;     // "5678"
  const char last = '9';
  EXPECT_EQ(chunk_crc(header, std::as_bytes(std::span(&last, 1))), 0xE3069283u);
}

}  // namespace
}  // namespace stepwright::record
