#include "runtime/ground/result/value_or_throw.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>

namespace stepwright::result {
namespace {

TEST(ValueOrThrow, WhenThereIsAValue_ThenItIsHandedOver) {
  EXPECT_EQ(*value_or_throw(Result<std::unique_ptr<int>>(std::make_unique<int>(7))), 7);
}

TEST(ValueOrThrow, WhenThereIsNone_ThenTheExceptionSaysAllThatIsWrong) {
  const Diagnostics wrong = {{"C0001", Severity::Error, {"a.toml", 2, 1}, "first", ""},
                             {"C0002", Severity::Error, {"a.toml", 3, 1}, "second", ""}};
  try {
    value_or_throw(Result<int>(tl::unexpected(wrong)));
    FAIL() << "nothing was thrown";
  } catch (const std::runtime_error& thrown) {
    EXPECT_EQ(std::string(thrown.what()), to_string(wrong));
  }
}

}  // namespace
}  // namespace stepwright::result
