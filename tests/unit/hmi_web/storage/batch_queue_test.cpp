#include "hmi_web/storage/batch_queue.h"

#include <gtest/gtest.h>

#include <array>
#include <numeric>
#include <thread>
#include <vector>

namespace stepwright::storage {
namespace {

using std::chrono::hours;
using std::chrono::milliseconds;

TEST(BatchQueue, WhenEnoughItemsWait_ThenTheyAreOneBatch) {
  BatchQueue<int> queue({.enough = 3, .capacity = 10, .period = hours(1)});
  for (const int item : {1, 2, 3}) queue.push(item);
  std::vector<int> batch;
  ASSERT_TRUE(queue.take(batch));
  EXPECT_EQ(batch, (std::vector<int>{1, 2, 3}));
}

TEST(BatchQueue, WhenItIsFull_ThenTheRestIsDroppedAndCounted) {
  BatchQueue<int> queue({.enough = 2, .capacity = 4, .period = hours(1)});
  const std::array items = {1, 2, 3, 4, 5, 6};
  EXPECT_EQ(queue.push(items), 4u);
  EXPECT_EQ(queue.dropped(), 2u);
  EXPECT_EQ(queue.pushed(), 4u);
  std::vector<int> batch;
  ASSERT_TRUE(queue.take(batch));
  EXPECT_EQ(batch.back(), 4);
  EXPECT_TRUE(queue.push(7));
}

TEST(BatchQueue, WhenThePeriodIsOver_ThenThereIsABatchWithWhatCame) {
  BatchQueue<int> queue({.enough = 100, .capacity = 100, .period = milliseconds(1)});
  std::vector<int> batch = {9};
  ASSERT_TRUE(queue.take(batch));
  EXPECT_TRUE(batch.empty());
}

TEST(BatchQueue, WhenItIsStopped_ThenWhatWaitsIsTakenBeforeTheEnd) {
  BatchQueue<int> queue({.enough = 100, .capacity = 100, .period = hours(1)});
  queue.push(1);
  queue.stop();
  std::vector<int> batch;
  EXPECT_TRUE(queue.take(batch));
  EXPECT_EQ(batch.size(), 1u);
  queue.done();
  EXPECT_FALSE(queue.take(batch));
}

TEST(BatchQueue, WhenManyThreadsPush_ThenNothingIsLostAndFlushWaitsForAll) {
  BatchQueue<int> queue({.enough = 100, .capacity = 1'000'000, .period = hours(1)});
  std::int64_t sum = 0;
  std::thread writer([&] {
    std::vector<int> batch;
    while (queue.take(batch)) {
      sum = std::accumulate(batch.begin(), batch.end(), sum);
      queue.done();
    }
  });
  std::vector<std::thread> threads;
  for (int thread = 0; thread < 4; ++thread)
    threads.emplace_back([&] {
      for (int i = 0; i < 1000; ++i) queue.push(i);
    });
  for (std::thread& thread : threads) thread.join();
  queue.flush();
  EXPECT_EQ(sum, 4 * 999 * 1000 / 2);
  queue.stop();
  writer.join();
}

}  // namespace
}  // namespace stepwright::storage
