#include "hmi_web/server/pending_connections.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace stepwright::server {
namespace {

class PendingConnectionsTest : public testing::Test {
 protected:
  PendingConnections::Ticket add(const std::string& address, const std::string& name) {
    return pending_.add(address, [this, name] { out_ += name; });
  }

  PendingConnections pending_;
  std::string out_;
};

TEST_F(PendingConnectionsTest, WhenNobodyWaits_ThenThereIsNoRoom) {
  EXPECT_FALSE(pending_.close_one());
  pending_.remove(add("a", "1"));
  EXPECT_FALSE(pending_.close_one());
  pending_.remove(0);
  EXPECT_EQ(out_, "");
}

TEST_F(PendingConnectionsTest, WhenOneAddressHasMost_ThenItsOldestGoes) {
  add("person", "p");
  for (const char* name : {"1", "2", "3"}) add("crowd", name);
  EXPECT_TRUE(pending_.close_one());
  EXPECT_TRUE(pending_.close_one());
  EXPECT_EQ(out_, "12");
  EXPECT_TRUE(pending_.close_one());
  EXPECT_TRUE(pending_.close_one());
  EXPECT_EQ(out_.size(), 4u);
  EXPECT_FALSE(pending_.close_one());
}

TEST_F(PendingConnectionsTest, WhenOneLeavesAndComesBack_ThenItIsTheNewest) {
  const auto first = add("a", "1");
  add("a", "2");
  pending_.remove(first);
  add("a", "1");
  EXPECT_TRUE(pending_.close_one());
  EXPECT_EQ(out_, "2");
}

}  // namespace
}  // namespace stepwright::server
