// The parts of the service that need no socket.

#include <gtest/gtest.h>

#include "runtime/host/limits.h"
#include "runtime/service/digest.h"
#include "runtime/service/internal/downloads.h"
#include "runtime/service/internal/event_history.h"
#include "runtime/service/internal/reply_cache.h"
#include "runtime/service/internal/supervisor_watch.h"

namespace stepwright::service::internal {
namespace {

using namespace std::chrono_literals;

std::vector<std::byte> pattern(std::size_t size) {
  std::vector<std::byte> bytes(size);
  for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<std::byte>(i * 31 >> 2);
  return bytes;
}

DownloadChunk chunk(const std::vector<std::byte>& bytes, std::size_t number) {
  const std::size_t at = number * host::kMaxChunkBytes;
  const auto first = bytes.begin() + static_cast<std::ptrdiff_t>(at);
  const auto size = std::min(host::kMaxChunkBytes, bytes.size() - at);
  return {at, {first, first + static_cast<std::ptrdiff_t>(size)}};
}

TEST(Sha256, WhenTheTextIsAbc_ThenItIsTheStandardsValue) {  // FIPS 180-4, example
  const std::string abc = "abc";
  EXPECT_EQ(to_hex(sha256(std::as_bytes(std::span(abc)))),
            "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

TEST(Downloads, WhenChunksComeInAnyOrderAndTwice_ThenTheContainerIsWhole) {
  Downloads downloads;
  const auto bytes = pattern(2 * host::kMaxChunkBytes + 5);
  ASSERT_TRUE(downloads.begin(1, {bytes.size(), sha256(bytes)}));
  for (const std::size_t number : {2u, 0u, 2u, 1u}) ASSERT_TRUE(downloads.add(1, chunk(bytes, number)));
  const auto whole = downloads.commit(1, {bytes.size(), sha256(bytes)});
  ASSERT_TRUE(whole);
  EXPECT_EQ(*whole, bytes);
  EXPECT_FALSE(downloads.commit(1, {bytes.size(), sha256(bytes)}));
}

TEST(Downloads, WhenAChunkIsMissing_ThenTheDownloadIsCut) {
  Downloads downloads;
  const auto bytes = pattern(3 * host::kMaxChunkBytes);
  ASSERT_TRUE(downloads.begin(1, {bytes.size(), sha256(bytes)}));
  ASSERT_TRUE(downloads.add(1, chunk(bytes, 0)));
  ASSERT_TRUE(downloads.add(1, chunk(bytes, 2)));
  const auto cut = downloads.commit(1, {bytes.size(), sha256(bytes)});
  ASSERT_FALSE(cut);
  EXPECT_EQ(cut.error().front().code, "R0003");
  EXPECT_NE(cut.error().front().message.find("2 of 3"), std::string::npos);
}

TEST(Downloads, WhenBytesChangedOnTheWay_ThenTheyAreRefused) {
  Downloads downloads;
  auto bytes = pattern(100);
  const Sha256 digest = sha256(bytes);
  ASSERT_TRUE(downloads.begin(1, {bytes.size(), digest}));
  bytes[50] ^= std::byte{1};
  ASSERT_TRUE(downloads.add(1, chunk(bytes, 0)));
  EXPECT_EQ(downloads.commit(1, {bytes.size(), digest}).error().front().code, "R0003");
}

TEST(Downloads, WhenRequestsDoNotFit_ThenTheyAreRefused) {
  Downloads downloads;
  const auto bytes = pattern(host::kMaxChunkBytes + 10);
  EXPECT_EQ(downloads.add(1, chunk(bytes, 0)).error().front().code, "R0003");
  EXPECT_EQ(downloads.begin(1, {0, {}}).error().front().code, "R0004");
  EXPECT_EQ(downloads.begin(1, {host::kMaxContainerBytes + 1, {}}).error().front().code, "R0004");
  ASSERT_TRUE(downloads.begin(1, {bytes.size(), sha256(bytes)}));
  DownloadChunk wrong = chunk(bytes, 0);
  wrong.offset = 1;
  EXPECT_EQ(downloads.add(1, wrong).error().front().code, "R0004");
  wrong.offset = ~0ull - host::kMaxChunkBytes + 1;
  EXPECT_EQ(downloads.add(1, wrong).error().front().code, "R0004");
  wrong = chunk(bytes, 1);
  wrong.data.push_back(std::byte{0});
  EXPECT_EQ(downloads.add(1, wrong).error().front().code, "R0004");
  EXPECT_EQ(downloads.add(2, chunk(bytes, 0)).error().front().code, "R0003");
  EXPECT_EQ(downloads.commit(1, {bytes.size(), {}}).error().front().code, "R0003");
}

TEST(Downloads, WhenManyClientsBegin_ThenTheOldestGivesWay) {
  Downloads downloads;
  const auto bytes = pattern(10);
  for (std::uint64_t client = 0; client <= Downloads::kMaxDownloads; ++client) {
    ASSERT_TRUE(downloads.begin(client, {bytes.size(), sha256(bytes)}));
  }
  EXPECT_FALSE(downloads.add(0, chunk(bytes, 0)));
  EXPECT_TRUE(downloads.add(1, chunk(bytes, 0)));
}

TEST(ReplyCache, WhenManyClientsAsk_ThenTheNewestAreRemembered) {
  ReplyCache cache;
  for (std::uint64_t client = 1; client <= ReplyCache::kClients + 1; ++client) {
    for (std::uint64_t id = 1; id <= ReplyCache::kReplies + 1; ++id) {
      Reply reply;
      reply.client = client;
      reply.id = id;
      reply.digest = std::to_string(client * 1'000 + id);
      cache.add(reply);
    }
  }
  EXPECT_EQ(cache.find(1, 5), nullptr);
  EXPECT_EQ(cache.find(2, 1), nullptr);
  ASSERT_NE(cache.find(2, 2), nullptr);
  EXPECT_EQ(cache.find(2, 2)->digest, "2002");
}

host::StepEvent event(std::uint64_t sequence, std::size_t image_bytes = 1) {
  host::StepEvent event;
  event.sequence = sequence;
  event.image.resize(image_bytes);
  return event;
}

TEST(EventHistory, WhenEventsAreForgotten_ThenTheNextOneHeldIsFound) {
  EventHistory history;
  EXPECT_EQ(history.at_or_after(0), nullptr);
  for (std::uint64_t i = 1; i <= EventHistory::kMaxEvents + 10; ++i) history.append(event(i));
  ASSERT_NE(history.at_or_after(1), nullptr);
  EXPECT_EQ(history.at_or_after(1)->sequence, 11u);
  EXPECT_EQ(history.at_or_after(20)->sequence, 20u);
  EXPECT_EQ(history.at_or_after(history.last() + 1), nullptr);
}

TEST(EventHistory, WhenImagesAreLarge_ThenMemoryIsBounded) {
  EventHistory history;
  constexpr std::size_t kImage = 1u << 20;
  for (std::uint64_t i = 1; i <= 100; ++i) history.append(event(i, kImage));
  EXPECT_GE(history.at_or_after(0)->sequence, 100 - EventHistory::kMaxBytes / kImage + 1);
}

TEST(SupervisorWatch, WhenItIsSilent_ThenItIsLostOnceAndComesBack) {
  using Change = SupervisorWatch::Change;
  SupervisorWatch watch(1s);
  const SupervisorWatch::Clock::time_point begin{};
  EXPECT_EQ(watch.check(begin + 1h), Change::None);  // never there, never lost
  watch.heard(begin + 2h);
  EXPECT_EQ(watch.check(begin + 2h), Change::Came);
  EXPECT_EQ(watch.check(begin + 2h + 1s), Change::None);
  EXPECT_EQ(watch.check(begin + 2h + 1001ms), Change::Lost);
  EXPECT_EQ(watch.check(begin + 3h), Change::None);
  watch.heard(begin + 3h);
  EXPECT_EQ(watch.check(begin + 3h), Change::Came);
  watch.repeat();
  EXPECT_EQ(watch.check(begin + 3h), Change::Came);
}

}  // namespace
}  // namespace stepwright::service::internal
