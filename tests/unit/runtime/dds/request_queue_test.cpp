#include "runtime/dds/internal/request_queue.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>

namespace stepwright::dds::internal {
namespace {

std::string order_of(RequestQueue& queue) {
  std::string order;
  while (auto request = queue.pop()) order += static_cast<char>('a' + request->id);
  return order;
}

TEST(RequestQueue_WhenAStopComes, ThenItGoesAheadOfAllButWhatWasStartedBefore) {
  RequestQueue queue;
  EXPECT_TRUE(queue.push({1, 0, service::DownloadChunk{}}));
  EXPECT_TRUE(queue.push({1, 1, service::Start{}}));
  EXPECT_TRUE(queue.push({1, 2, service::DownloadChunk{}}));
  EXPECT_TRUE(queue.push({2, 3, service::Stop{"first"}}));
  EXPECT_TRUE(queue.push({1, 4, service::Start{}}));
  EXPECT_TRUE(queue.push({1, 5, service::Write{}}));
  EXPECT_TRUE(queue.push({2, 6, service::Stop{"second"}}));
  EXPECT_TRUE(queue.push({2, 7, service::Stop{"third"}}));
  EXPECT_EQ(order_of(queue), "abdceghf");
}

TEST(RequestQueue_WhenNothingStarts, ThenAStopIsFirst) {
  RequestQueue queue;
  for (std::uint64_t id = 0; id < 3; ++id) EXPECT_TRUE(queue.push({1, id, service::DownloadChunk{}}));
  EXPECT_TRUE(queue.push({1, 3, service::Stop{}}));
  EXPECT_EQ(order_of(queue), "dabc");
}

TEST(RequestQueue_WhenItIsFull, ThenAStopFindsRoom) {
  RequestQueue queue;
  std::size_t taken = 0;
  while (queue.push({1, 0, service::DownloadChunk{}})) ++taken;
  EXPECT_EQ(taken, kMaxQueuedRequests);
  for (std::size_t i = 0; i < kRoomForStops; ++i) EXPECT_TRUE(queue.push({1, 1, service::Stop{}}));
  EXPECT_FALSE(queue.push({1, 1, service::Stop{}}));
  for (std::size_t i = 0; i < kRoomForStops; ++i) EXPECT_EQ(queue.pop()->id, 1u);
  EXPECT_EQ(queue.pop()->id, 0u);
}

}  // namespace
}  // namespace stepwright::dds::internal
