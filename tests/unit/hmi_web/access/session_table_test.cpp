#include "hmi_web/access/session_table.h"

#include <gtest/gtest.h>

namespace stepwright::access {
namespace {

using namespace std::chrono_literals;

class SessionTableTest : public testing::Test {
 protected:
  std::chrono::steady_clock::time_point now_{};
  SessionTable sessions_{{.idle = 10min, .absolute = 60min, .most = 3}, [this] { return now_; }};
};

TEST_F(SessionTableTest, WhenItIsOpen_ThenItsTokenFindsIt) {
  const auto opened = sessions_.open("ada", Role::Operator, "10.0.0.7");
  EXPECT_EQ(opened.token.size(), 43u);
  EXPECT_NE(opened.token, opened.csrf);
  const auto session = sessions_.use(opened.token);
  ASSERT_TRUE(session);
  EXPECT_EQ(session->user, "ada");
  EXPECT_EQ(session->role, Role::Operator);
  EXPECT_EQ(session->csrf, opened.csrf);
  EXPECT_EQ(session->address, "10.0.0.7");
}

TEST_F(SessionTableTest, WhenTheTokenIsForged_ThenThereIsNone) {
  auto token = sessions_.open("ada", Role::Operator, "").token;
  token[5] = token[5] == 'A' ? 'B' : 'A';
  EXPECT_FALSE(sessions_.use(token));
  EXPECT_FALSE(sessions_.use(""));
}

TEST_F(SessionTableTest, WhenItIsIdle_ThenItExpires) {
  const auto token = sessions_.open("ada", Role::Operator, "").token;
  now_ += 9min;
  EXPECT_TRUE(sessions_.use(token));
  now_ += 9min;
  EXPECT_TRUE(sessions_.use(token));
  now_ += 10min;
  EXPECT_FALSE(sessions_.use(token));
}

TEST_F(SessionTableTest, WhenItIsOnlyListenedTo_ThenItIsIdle) {
  const auto token = sessions_.open("ada", Role::Operator, "").token;
  now_ += 9min;
  EXPECT_TRUE(sessions_.find(token));
  now_ += 1min;
  EXPECT_FALSE(sessions_.find(token));
}

TEST_F(SessionTableTest, WhenItIsUsedAllTheTime_ThenItExpiresAllTheSame) {
  const auto token = sessions_.open("ada", Role::Operator, "").token;
  for (int i = 0; i < 11; ++i) {
    now_ += 5min;
    EXPECT_TRUE(sessions_.use(token)) << i;
  }
  now_ += 5min;
  EXPECT_FALSE(sessions_.use(token));
}

TEST_F(SessionTableTest, WhenItIsClosed_ThenItsTokenIsWorthNothing) {
  const auto token = sessions_.open("ada", Role::Operator, "").token;
  sessions_.close(token);
  EXPECT_FALSE(sessions_.use(token));
}

TEST_F(SessionTableTest, WhenAUsersSessionsAreClosed_ThenTheKeptOneAndThoseOfOthersGoOn) {
  const auto one = sessions_.open("ada", Role::Operator, "").token;
  const auto two = sessions_.open("ada", Role::Operator, "").token;
  const auto other = sessions_.open("bob", Role::Operator, "").token;
  sessions_.close_user("ada", two);
  EXPECT_FALSE(sessions_.use(one));
  EXPECT_TRUE(sessions_.use(two));
  EXPECT_TRUE(sessions_.use(other));
}

TEST_F(SessionTableTest, WhenOneIsRevokedByItsId_ThenOnlyThatOneEnds) {
  const auto one = sessions_.open("ada", Role::Operator, "").token;
  const auto two = sessions_.open("ada", Role::Operator, "").token;
  const std::string id = sessions_.find(one)->id;
  EXPECT_TRUE(sessions_.close_id(id));
  EXPECT_FALSE(sessions_.close_id(id));
  EXPECT_FALSE(sessions_.use(one));
  EXPECT_TRUE(sessions_.use(two));
}

TEST_F(SessionTableTest, WhenThereAreTooMany_ThenTheOneThatWasIdleLongestGivesWay) {
  const auto first = sessions_.open("a", Role::Viewer, "").token;
  now_ += 1s;
  const auto second = sessions_.open("b", Role::Viewer, "").token;
  now_ += 1s;
  sessions_.open("c", Role::Viewer, "");
  now_ += 1s;
  EXPECT_TRUE(sessions_.use(first));
  sessions_.open("d", Role::Viewer, "");
  EXPECT_TRUE(sessions_.find(first));
  EXPECT_FALSE(sessions_.find(second));
  EXPECT_EQ(sessions_.all().size(), 3u);
}

}  // namespace
}  // namespace stepwright::access
