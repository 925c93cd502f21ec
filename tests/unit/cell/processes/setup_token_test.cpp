#include "cell/processes/setup_token.h"

#include <gtest/gtest.h>

namespace stepwright::processes {
namespace {

TEST(SetupToken, WhenTheServerSaysIt_ThenItIsFound) {
  EXPECT_EQ(
      setup_token_of("stepwright hmi: set-up token ABCD-EFGH (claims the administrator on the page, once)"),
      "ABCD-EFGH");
}

TEST(SetupToken, WhenALineIsAboutSomethingElse_ThenThereIsNone) {
  EXPECT_FALSE(setup_token_of("the set-up token is on standard error"));
  EXPECT_FALSE(setup_token_of(""));
}

}  // namespace
}  // namespace stepwright::processes
