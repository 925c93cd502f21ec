#include "runtime/dds/internal/event_order.h"

#include <gtest/gtest.h>

namespace stepwright::dds::internal {
namespace {

RuntimeStatus status(std::uint64_t incarnation, std::uint64_t last_event, bool waiting = false) {
  RuntimeStatus status;
  status.incarnation = incarnation;
  status.last_event = last_event;
  status.waiting_for_supervisor = waiting;
  return status;
}

StepEvent event(std::uint64_t sequence, std::uint64_t incarnation = 1) {
  StepEvent event;
  event.incarnation = incarnation;
  event.sequence = sequence;
  return event;
}

TEST(EventOrder, WhenEventsComeOutOfOrderAndTwice_ThenTheyLeaveInOrderOnce) {
  EventOrder order;
  order.observe(status(1, 0));
  for (const std::uint64_t sequence : {2u, 1u, 2u, 3u, 1u}) order.add(event(sequence));
  for (const std::uint64_t sequence : {1u, 2u, 3u}) {
    const auto next = order.take();
    ASSERT_TRUE(next);
    EXPECT_EQ(next->sequence, sequence);
  }
  EXPECT_FALSE(order.take());
}

TEST(EventOrder, WhenClientJoinsLate_ThenItStartsAfterTheNewestEvent) {
  EventOrder order;
  order.observe(status(1, 10));
  order.add(event(10));
  EXPECT_FALSE(order.take());
  EXPECT_FALSE(order.missing());
  order.add(event(11));
  EXPECT_EQ(order.take()->sequence, 11u);
}

TEST(EventOrder, WhenClientJoinsWhileRuntimeWaits_ThenItStartsWithThePendingEvent) {
  EventOrder order;
  order.observe(status(1, 10, true));
  EXPECT_EQ(order.missing(), 10u);
}

TEST(EventOrder, WhenStatusNamesAnEventThatNeverCame_ThenItIsMissing) {
  EventOrder order;
  order.observe(status(1, 0));
  order.add(event(1));
  order.observe(status(1, 3));
  EXPECT_FALSE(order.missing());
  order.take();
  EXPECT_EQ(order.missing(), 2u);
  order.add(event(3));
  EXPECT_EQ(order.missing(), 2u);
}

TEST(EventOrder, WhenRuntimeForgotEvents_ThenTheyAreSkipped) {
  EventOrder order;
  order.observe(status(1, 0));
  order.add(event(9));
  order.skip_to(8);
  EXPECT_EQ(order.missing(), 8u);
  order.add(event(8));
  EXPECT_EQ(order.take()->sequence, 8u);
  EXPECT_EQ(order.take()->sequence, 9u);
}

TEST(EventOrder, WhenRuntimeRestarts_ThenItsEventsStartAnewAndOldOnesAreDropped) {
  EventOrder order;
  order.observe(status(1, 5));
  order.add(event(6));
  order.observe(status(2, 1));
  order.add(event(7));
  EXPECT_EQ(order.missing(), 1u);
  order.add(event(1, 2));
  EXPECT_EQ(order.take()->sequence, 1u);
  EXPECT_FALSE(order.take());
}

TEST(EventOrder, WhenNobodyTakesEvents_ThenTheNumberHeldIsBounded) {
  EventOrder order;
  order.observe(status(1, 0));
  for (std::uint64_t i = 2; i < 3 * EventOrder::kMaxHeld; ++i) order.add(event(i));
  order.add(event(1));
  std::size_t taken = 0;
  while (order.take()) ++taken;
  EXPECT_EQ(taken, EventOrder::kMaxHeld + 1);
  EXPECT_EQ(order.missing(), EventOrder::kMaxHeld + 2);
}

}  // namespace
}  // namespace stepwright::dds::internal
