#include "hmi_web/access/access_control.h"

#include <gtest/gtest.h>

#include <atomic>
#include <functional>
#include <future>

#include "tests/support/temporary_folder.h"

namespace stepwright::access {
namespace {

using namespace std::chrono_literals;

class AccessControlTest : public testing::Test {
 protected:
  AccessControlTest() { open(); }
  void open() {
    AccessOptions options;
    options.cost = {1, 8'192};
    options.logins.free_failures = 2;
    auto control = AccessControl::open(folder_.path() / "access", options, [this] { return now_; });
    ASSERT_TRUE(control) << result::to_string(control.error());
    control_ = std::move(*control);
  }
  void claim() { ASSERT_TRUE(control_->claim(*control_->setup_token(), "root", "root's secret", "here")); }
  std::string log_in_code(const std::string& name, const std::string& password,
                          const std::string& from = "") {
    const auto opened = control_->log_in(name, password, from);
    return opened ? "" : opened.error().problems.front().code;
  }
  std::string session_of(const std::string& name, const std::string& password) {
    return control_->log_in(name, password, "here")->token;
  }

  support::TemporaryFolder folder_;
  std::chrono::steady_clock::time_point now_{};
  std::unique_ptr<AccessControl> control_;
};

TEST_F(AccessControlTest, WhenNobodyIsThere_ThenTheSetUpTokenMakesTheAdministratorOnce) {
  const auto token = control_->setup_token();
  ASSERT_TRUE(token);
  EXPECT_EQ(token->size(), 24u);
  EXPECT_EQ(control_->claim("AAAA-BBBB-CCCC-DDDD-EEEE", "root", "root's secret", "").error().problems[0].code,
            "H0028");
  const auto opened = control_->claim(*token, "root", "root's secret", "");
  ASSERT_TRUE(opened);
  EXPECT_EQ(control_->sessions().use(opened->token)->role, Role::Administrator);
  EXPECT_FALSE(control_->setup_token());
  EXPECT_EQ(control_->claim(*token, "second", "another one", "").error().problems[0].code, "H0028");
  open();
  EXPECT_FALSE(control_->setup_token()) << "also after a restart";
}

// The clock is asked while a session is being opened: that is when somebody takes the user away.
TEST_F(AccessControlTest, WhenAUserGoesWhileASessionIsBeingOpened_ThenTheSessionGoesToo) {
  std::function<void()> meanwhile = [] {};
  AccessOptions options;
  options.cost = {1, 8'192};
  auto control = *AccessControl::open(folder_.path() / "race", options, [&] {
    meanwhile();
    return now_;
  });
  ASSERT_TRUE(control->add_user("ada", Role::Engineer, "ada's secret"));
  ASSERT_TRUE(control->add_user("root", Role::Administrator, "root's secret"));
  std::future<void> removed;
  std::atomic<int> asked = 0;
  meanwhile = [&] {
    // Of a log-in: the locks of name and address, then the session.
    if (++asked != 3) return;
    removed = std::async(std::launch::async, [&] { EXPECT_TRUE(control->remove_user("ada")); });
    removed.wait_for(
        std::chrono::milliseconds(300));  // it is done by then, or waits for the session to be opened
  };
  const auto opened = control->log_in("ada", "ada's secret", "here");
  ASSERT_EQ(asked.load() >= 3, true) << "the clock is asked otherwise now: count again";
  removed.wait();
  EXPECT_TRUE(control->sessions().all().empty()) << "a session of nobody";
}

TEST_F(AccessControlTest, WhenTheClaimedPasswordIsPoor_ThenTheTokenIsStillGood) {
  const auto token = control_->setup_token();
  EXPECT_EQ(control_->claim(*token, "root", "short", "").error().problems[0].code, "H0023");
  EXPECT_TRUE(control_->claim(*token, "root", "long enough", ""));
}

// Who has the token shares an address with those who guess it, and does not wait for them.
TEST_F(AccessControlTest, WhenTokensAreGuessed_ThenTheAddressIsLockedForAllButTheRightOne) {
  for (int i = 0; i < 9; ++i) (void)control_->claim("x", "root", "root's secret", "far");
  const auto refused = control_->claim("y", "root", "root's secret", "far");
  EXPECT_EQ(refused.error().problems[0].code, "H0027");
  EXPECT_EQ(refused.error().cause, Refusal::Cause::TooManyAttempts);
  EXPECT_EQ(refused.error().retry_after, 2s);
  EXPECT_TRUE(control_->claim(*control_->setup_token(), "root", "root's secret", "far"));
  EXPECT_EQ(control_->claim("y", "root", "root's secret", "far").error().problems[0].code, "H0027");
}

TEST_F(AccessControlTest, WhenNameOrPasswordIsWrong_ThenTheAnswerIsTheSame) {
  claim();
  EXPECT_EQ(log_in_code("root", "root's secret"), "");
  EXPECT_EQ(log_in_code("root", "wrong"), "H0026");
  EXPECT_EQ(log_in_code("nobody", "wrong"), "H0026");
}

TEST_F(AccessControlTest, WhenItIsLocked_ThenTheRightPasswordDoesNotHelpUntilTheTimeIsOver) {
  claim();
  for (int i = 0; i < 3; ++i) EXPECT_EQ(log_in_code("root", "wrong"), "H0026");
  EXPECT_EQ(log_in_code("root", "root's secret"), "H0027");
  now_ += 2s;
  EXPECT_EQ(log_in_code("root", "root's secret"), "");
}

TEST_F(AccessControlTest, WhenANameIsLocked_ThenOneThatIsNotThereIsLockedAlike) {
  for (int i = 0; i < 3; ++i) EXPECT_EQ(log_in_code("nobody", "wrong"), "H0026");
  EXPECT_EQ(log_in_code("nobody", "wrong"), "H0027");
}

TEST_F(AccessControlTest, WhenOneAddressTriesManyNames_ThenTheAddressIsLocked) {
  claim();
  for (int i = 0; i < 9; ++i) EXPECT_EQ(log_in_code("name" + std::to_string(i), "wrong", "far"), "H0026");
  EXPECT_EQ(log_in_code("root", "root's secret", "far"), "H0027");
  EXPECT_EQ(log_in_code("root", "root's secret", "near"), "");
}

// Somebody who guesses, elsewhere with her name or beside her with others', does not lock the administrator
// out.
TEST_F(AccessControlTest, WhenOthersGuess_ThenWhoHasLoggedInFromThereComesInAllTheSame) {
  claim();
  for (int i = 0; i < 20; ++i) (void)log_in_code("name" + std::to_string(i), "wrong", "here");
  for (int i = 0; i < 20; ++i) (void)log_in_code("root", "wrong", "far");
  EXPECT_EQ(log_in_code("root", "root's secret", "far"), "H0027");
  EXPECT_EQ(log_in_code("root", "root's secret", "elsewhere"), "H0027");
  EXPECT_EQ(log_in_code("root", "root's secret", "here"), "");
  for (int i = 0; i < 3; ++i) EXPECT_EQ(log_in_code("root", "wrong", "here"), "H0026");
  EXPECT_EQ(log_in_code("root", "root's secret", "here"), "H0027") << "her own failures count";
}

TEST_F(AccessControlTest, WhenThePasswordIsChanged_ThenTheUsersOtherSessionsEnd) {
  claim();
  const std::string here = session_of("root", "root's secret");
  const std::string there = session_of("root", "root's secret");
  EXPECT_EQ(control_->change_password("root", "wrong", "fresh secret", here).error().problems[0].code,
            "H0026");
  ASSERT_TRUE(control_->change_password("root", "root's secret", "fresh secret", here));
  EXPECT_TRUE(control_->sessions().use(here));
  EXPECT_FALSE(control_->sessions().use(there));
  EXPECT_EQ(log_in_code("root", "root's secret"), "H0026");
  EXPECT_EQ(log_in_code("root", "fresh secret"), "");
}

TEST_F(AccessControlTest, WhenRightsAreTakenAway_ThenTheSessionsEnd) {
  claim();
  ASSERT_TRUE(control_->add_user("ada", Role::Engineer, "ada's secret"));
  const std::string one = session_of("ada", "ada's secret");
  ASSERT_TRUE(control_->set_role("ada", Role::Viewer));
  EXPECT_FALSE(control_->sessions().use(one));
  const std::string two = session_of("ada", "ada's secret");
  EXPECT_EQ(control_->sessions().use(two)->role, Role::Viewer);
  ASSERT_TRUE(control_->reset_password("ada", "given by root"));
  EXPECT_FALSE(control_->sessions().use(two));
  const std::string three = session_of("ada", "given by root");
  ASSERT_TRUE(control_->remove_user("ada"));
  EXPECT_FALSE(control_->sessions().use(three));
}

TEST_F(AccessControlTest, WhenPasswordsAreStored_ThenAsArgon2idOfTheDefaultCost) {
  const auto hash = hash_password("a password", {});
  ASSERT_TRUE(hash);
  EXPECT_TRUE(hash->starts_with("$argon2id$v=19$m=65536,t=3,p=1$")) << *hash;
  EXPECT_TRUE(password_matches(*hash, "a password"));
  EXPECT_FALSE(password_matches(*hash, "a passwor"));
  EXPECT_FALSE(password_matches("", ""));
}

}  // namespace
}  // namespace stepwright::access
