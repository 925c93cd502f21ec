#include "runtime/dds/internal/request_queue.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "runtime/service/codec.h"

namespace stepwright::dds::internal {
namespace {

bool push(RequestQueue& queue, const service::Request& request) {
  std::vector<std::byte> bytes;
  return service::encode(request, bytes) && queue.push(request.body, bytes);
}

// Of the next request.
std::optional<std::uint64_t> pop(RequestQueue& queue) {
  const auto bytes = queue.pop();
  if (!bytes) return std::nullopt;
  return std::get<service::Request>(service::decode(*bytes).value()).id;
}

std::string order_of(RequestQueue& queue) {
  std::string order;
  while (auto id = pop(queue)) order += static_cast<char>('a' + *id);
  return order;
}

TEST(RequestQueue_WhenAStopComes, ThenItGoesAheadOfAllButWhatWasStartedBefore) {
  RequestQueue queue;
  EXPECT_TRUE(push(queue, {1, 0, service::DownloadChunk{}}));
  EXPECT_TRUE(push(queue, {1, 1, service::Start{}}));
  EXPECT_TRUE(push(queue, {1, 2, service::DownloadChunk{}}));
  EXPECT_TRUE(push(queue, {2, 3, service::Stop{"first"}}));
  EXPECT_TRUE(push(queue, {1, 4, service::Start{}}));
  EXPECT_TRUE(push(queue, {1, 5, service::Write{}}));
  EXPECT_TRUE(push(queue, {2, 6, service::Stop{"second"}}));
  EXPECT_TRUE(push(queue, {2, 7, service::Stop{"third"}}));
  EXPECT_EQ(order_of(queue), "abdceghf");
}

TEST(RequestQueue_WhenNothingStarts, ThenAStopIsFirst) {
  RequestQueue queue;
  for (std::uint64_t id = 0; id < 3; ++id) EXPECT_TRUE(push(queue, {1, id, service::DownloadChunk{}}));
  EXPECT_TRUE(push(queue, {1, 3, service::Stop{}}));
  EXPECT_EQ(order_of(queue), "dabc");
}

TEST(RequestQueue_WhenItIsFull, ThenAStopFindsRoom) {
  RequestQueue queue;
  std::size_t taken = 0;
  while (push(queue, {1, 0, service::DownloadChunk{}})) ++taken;
  EXPECT_EQ(taken, kMaxQueuedRequests);
  for (std::size_t i = 0; i < kRoomForStops; ++i) EXPECT_TRUE(push(queue, {1, 1, service::Stop{}}));
  EXPECT_FALSE(push(queue, {1, 1, service::Stop{}}));
  for (std::size_t i = 0; i < kRoomForStops; ++i) EXPECT_EQ(pop(queue), 1u);
  EXPECT_EQ(pop(queue), 0u);
}

}  // namespace
}  // namespace stepwright::dds::internal
