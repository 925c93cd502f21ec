#include "ladder/exchange/st_assignments.h"

#include <gtest/gtest.h>

namespace stepwright::exchange {
namespace {

TEST(StAssignments, WhenTextIsAssignments_ThenTheyAreTakenApart) {
  const auto list = assignments_of(" a := b + 1;\n m.x[2] := f(c) ; ");
  ASSERT_TRUE(list);
  ASSERT_EQ(list->size(), 2U);
  EXPECT_EQ((*list)[0].target, "a");
  EXPECT_EQ((*list)[0].expression, "b + 1");
  EXPECT_EQ((*list)[1].target, "m.x[2]");
  EXPECT_EQ((*list)[1].expression, "f(c)");
  EXPECT_TRUE(assignments_of("")->empty());
}

TEST(StAssignments, WhenTextHoldsMore_ThenThereIsNoAnswer) {
  for (const char* text : {"IF a THEN b := 1; END_IF", "t(IN := a);", "a := 'x;y';", "a := b (* c *);",
                           "RETURN;", "a := b := c;", "a", "FOR i := 1 TO 3 DO x := i; END_FOR", "a := ;"}) {
    EXPECT_FALSE(assignments_of(text)) << text;
  }
}

}  // namespace
}  // namespace stepwright::exchange
