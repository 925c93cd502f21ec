#include "ladder/semantics/types/type.h"

#include <gtest/gtest.h>

#include "ladder/semantics/types/constant.h"

namespace {

using namespace stepwright::semantics;

// Integer types: a conversion is implicit exactly if the range of the target holds that of the source.
TEST(Widens, Integers_WhenTheRangeIsHeld_ThenAndOnlyThen) {
  const TypeTable types;
  for (int from = static_cast<int>(ElementaryType::Sint); from <= static_cast<int>(ElementaryType::Ulint);
       ++from) {
    for (int to = static_cast<int>(ElementaryType::Sint); to <= static_cast<int>(ElementaryType::Ulint);
         ++to) {
      const auto source = static_cast<ElementaryType>(from);
      const auto target = static_cast<ElementaryType>(to);
      const bool holds =
          range_of(target).low <= range_of(source).low && range_of(target).high >= range_of(source).high;
      EXPECT_EQ(widens(*types.elementary(source), *types.elementary(target)), holds)
          << types.elementary(source)->name << " to " << types.elementary(target)->name;
    }
  }
}

TEST(Widens, Others_WhenCompared_ThenOnlyWhatLosesNothing) {
  const TypeTable types;
  const auto test = [&](ElementaryType from, ElementaryType to) {
    return widens(*types.elementary(from), *types.elementary(to));
  };
  using enum ElementaryType;
  EXPECT_TRUE(test(Int, Real));
  EXPECT_TRUE(test(Dint, Lreal));
  EXPECT_FALSE(test(Dint, Real));
  EXPECT_FALSE(test(Lint, Lreal));
  EXPECT_TRUE(test(Bool, Byte));
  EXPECT_TRUE(test(Byte, Lword));
  EXPECT_FALSE(test(Byte, Usint));
  EXPECT_FALSE(test(Lreal, Real));
  EXPECT_FALSE(test(Time, Lint));
}

TEST(TypeTable, Array_WhenShapedAlike_ThenIsOneType) {
  TypeTable types;
  const Type* real = types.elementary(ElementaryType::Real);
  const Type* first = types.array(real, {{1, 3}, {0, 1}});
  EXPECT_EQ(first, types.array(real, {{1, 3}, {0, 1}}));
  EXPECT_NE(first, types.array(real, {{1, 3}}));
  EXPECT_EQ(first->size, 24u);
  EXPECT_EQ(first->name, "ARRAY[1..3,0..1] OF REAL");
}

}  // namespace
