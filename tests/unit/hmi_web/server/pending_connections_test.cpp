#include "hmi_web/server/pending_connections.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace stepwright::server {
namespace {

class WaitingRoomTest : public testing::Test {
 protected:
  WaitingRoom::Ticket enter(const std::string& address, const std::string& name) {
    return room_.enter(address, [this, name] { out_ += name; });
  }

  WaitingRoom room_;
  std::string out_;
};

TEST_F(WaitingRoomTest, WhenNobodyWaits_ThenThereIsNoRoom) {
  EXPECT_FALSE(room_.turn_one_out());
  room_.leave(enter("a", "1"));
  EXPECT_FALSE(room_.turn_one_out());
  room_.leave(0);
  EXPECT_EQ(out_, "");
}

TEST_F(WaitingRoomTest, WhenOneAddressHasMost_ThenItsOldestGoes) {
  enter("person", "p");
  for (const char* name : {"1", "2", "3"}) enter("crowd", name);
  EXPECT_TRUE(room_.turn_one_out());
  EXPECT_TRUE(room_.turn_one_out());
  EXPECT_EQ(out_, "12");
  EXPECT_TRUE(room_.turn_one_out());
  EXPECT_TRUE(room_.turn_one_out());
  EXPECT_EQ(out_.size(), 4u);
  EXPECT_FALSE(room_.turn_one_out());
}

TEST_F(WaitingRoomTest, WhenOneLeavesAndComesBack_ThenItIsTheNewest) {
  const auto first = enter("a", "1");
  enter("a", "2");
  room_.leave(first);
  enter("a", "1");
  EXPECT_TRUE(room_.turn_one_out());
  EXPECT_EQ(out_, "2");
}

}  // namespace
}  // namespace stepwright::server
