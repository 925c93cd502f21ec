#include "ladder/semantics/types/constant.h"

#include <gtest/gtest.h>

namespace {

using namespace stepwright::semantics;
using stepwright::syntax::Operator;

class ConstantTest : public testing::Test {
 protected:
  std::int64_t whole(Operator op, std::int64_t left, std::int64_t right, ElementaryType type) {
    return static_cast<std::int64_t>(evaluate(op, {left}, {right}, *types_.elementary(type))->integer);
  }

  TypeTable types_;
};

TEST_F(ConstantTest, Evaluate_WhenAnIntegerOverflows_ThenWrapsToItsType) {
  EXPECT_EQ(whole(Operator::Add, 127, 1, ElementaryType::Sint), -128);
  EXPECT_EQ(whole(Operator::Subtract, 0, 1, ElementaryType::Uint), 65535);
  EXPECT_EQ(whole(Operator::Multiply, 1 << 30, 4, ElementaryType::Dint), 0);
  EXPECT_EQ(whole(Operator::Multiply, -1, INT64_MIN, ElementaryType::Lint), INT64_MIN);
  EXPECT_EQ(whole(Operator::Divide, -7, 2, ElementaryType::Int), -3);
}

TEST_F(ConstantTest, Evaluate_WhenDividingByZero_ThenHasNoValue) {
  EXPECT_FALSE(evaluate(Operator::Divide, {1}, {0}, *types_.elementary(ElementaryType::Int)));
  EXPECT_FALSE(evaluate(Operator::Modulo, {1}, {0}, *types_.elementary(ElementaryType::Int)));
}

TEST_F(ConstantTest, Evaluate_WhenReal_ThenIsSinglePrecision) {
  const auto sum =
      evaluate(Operator::Add, {0, 16777216.0}, {0, 1.0}, *types_.elementary(ElementaryType::Real));
  EXPECT_EQ(sum->real, 16777216.0);
  const auto wide =
      evaluate(Operator::Add, {0, 16777216.0}, {0, 1.0}, *types_.elementary(ElementaryType::Lreal));
  EXPECT_EQ(wide->real, 16777217.0);
}

TEST_F(ConstantTest, StoreAndLoad_WhenRoundTripped_ThenTheValueIsKept) {
  for (const auto which :
       {ElementaryType::Sint, ElementaryType::Int, ElementaryType::Dint, ElementaryType::Lint}) {
    const Type& type = *types_.elementary(which);
    std::vector<std::byte> bytes(type.size);
    store({-5}, type, bytes);
    EXPECT_EQ(static_cast<int>(load(type, bytes).integer), -5) << type.name;
  }
}

TEST_F(ConstantTest, Fits_WhenAtTheLimits_ThenExactly) {
  EXPECT_TRUE(fits({-32768}, *types_.elementary(ElementaryType::Int)));
  EXPECT_FALSE(fits({32768}, *types_.elementary(ElementaryType::Int)));
  EXPECT_FALSE(fits({-1}, *types_.elementary(ElementaryType::Word)));
  EXPECT_TRUE(fits({1}, *types_.boolean()));
  EXPECT_FALSE(fits({2}, *types_.boolean()));
}

}  // namespace
