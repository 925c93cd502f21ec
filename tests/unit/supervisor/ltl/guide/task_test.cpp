#include "supervisor/ltl/guide/task.h"

#include <gtest/gtest.h>

namespace stepwright::ltl {
namespace {

const std::vector<std::string> kPlaces = {"press", "wash", "rack one"};

TEST(Task, WhenItNamesPlaces_ThenLettersAreTheFloorsLabels) {
  const auto task = read_task("visit \"rack one\" then visit press", kPlaces);
  ASSERT_TRUE(task);
  EXPECT_EQ(task->automaton.propositions, kPlaces);
  const Automaton& automaton = task->automaton;
  const std::uint32_t racked = automaton.next(automaton.initial, 0b100);
  EXPECT_NE(racked, automaton.initial);
  EXPECT_EQ(automaton.next(automaton.initial, 0b001), automaton.initial);
  EXPECT_TRUE(automaton.accepting(automaton.next(racked, 0b001)));
  EXPECT_TRUE(automaton.accepting(automaton.next(automaton.initial, 0b111))) << "a letter may be shared";
}

TEST(Task, WhenANameIsNoPlace_ThenItIsToldWithItsPlaceAndTheNearestOne) {
  const auto task = read_task("visit press,\n never pres before wsh", kPlaces, "job.ltl");
  ASSERT_FALSE(task);
  ASSERT_EQ(task.error().size(), 2u);
  EXPECT_EQ(task.error()[0].code, "L0311");
  EXPECT_EQ(task.error()[0].where.line, 2u);
  EXPECT_EQ(task.error()[0].where.column, 8u);
  EXPECT_EQ(task.error()[0].hint, "did you mean 'press'?");
  EXPECT_EQ(task.error()[1].message, "the floor has no place 'wsh'");
}

TEST(Task, WhenItHasADeadline_ThenThatIsToldWithItsPlace) {
  for (const char* text : {"visit wash, visit press within T#5s", "visit wash, F (press for T#5s)"}) {
    const auto task = read_task(text, kPlaces, "job.ltl");
    ASSERT_FALSE(task) << text;
    ASSERT_EQ(task.error().size(), 1u);
    EXPECT_EQ(task.error()[0].code, "L0312");
    EXPECT_NE(task.error()[0].message.find("T#5s"), std::string::npos);
    EXPECT_EQ(task.error()[0].where.line, 1u);
    EXPECT_GE(task.error()[0].where.column, 13u) << text;
    EXPECT_NE(task.error()[0].hint, "");
  }
}

TEST(Task, WhenItIsNotCoSafe_ThenItIsRefusedWithThePartToBlame) {
  const auto task = read_task("visit press, never wash", kPlaces);
  ASSERT_FALSE(task);
  EXPECT_EQ(task.error()[0].code, "L0011");
  EXPECT_EQ(task.error()[0].where.column, 14u);
}

}  // namespace
}  // namespace stepwright::ltl
