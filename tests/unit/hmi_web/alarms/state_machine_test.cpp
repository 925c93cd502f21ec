#include "hmi_web/alarms/state_machine.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <vector>

namespace stepwright::alarms {
namespace {

using enum AlarmState;
using enum AlarmEvent;

constexpr std::string_view kLetters = "ABCDEFGHI";

// The transitions between the annunciated states, letter by letter: the state, the event (r raise, n return,
// a acknowledge, x reset) and the state behind it. What has no row is refused and changes nothing.
struct Table {
  AlarmTraits traits;
  std::vector<std::string> rows;
};
const std::array<Table, 4> kTables = {{
    {{false, false}, {"ArB", "BaC", "BnD", "CnA", "DaA", "DrB"}},
    {{false, true}, {"ArB", "BaC", "BnA", "CnA"}},
    {{true, false}, {"ArB", "BaC", "BnE", "CnF", "EaF", "ErB", "FxA", "FrB"}},
    {{true, true}, {"ArB", "BaC", "BnF", "CnF", "FxA", "FrB"}},
}};

AlarmStatus status_of(char letter) {
  AlarmStatus status;
  status.annunciated = static_cast<AlarmState>(kLetters.find(letter));
  status.active = letter == 'B' || letter == 'C';
  return status;
}
char letter_of(const AlarmStatus& status) {
  return kLetters[static_cast<std::size_t>(status.state())];
}

// Every status that events can lead to.
std::vector<AlarmStatus> all_statuses(AlarmTraits traits) {
  std::vector<AlarmStatus> found = {AlarmStatus{}};
  for (std::size_t i = 0; i < found.size(); ++i)
    for (std::uint8_t event = 0; event < kAlarmEvents; ++event) {
      const AlarmStatus next = apply(found[i], static_cast<AlarmEvent>(event), traits).status;
      if (std::find(found.begin(), found.end(), next) == found.end()) found.push_back(next);
    }
  return found;
}

TEST(AlarmStateMachine, WhenNothingIsHidden_ThenItIsTheStandardsTable) {
  const std::array<std::pair<char, AlarmEvent>, 4> events = {
      {{'r', Raise}, {'n', Return}, {'a', Acknowledge}, {'x', Reset}}};
  for (const Table& table : kTables) {
    for (const char from : std::string("ABCDEF")) {
      for (const auto& [sign, event] : events) {
        std::string row;
        for (const std::string& one : table.rows)
          if (one[0] == from && one[1] == sign) row = one;
        const AlarmStatus before = status_of(from);
        const bool reachable = table.traits.latching ? from != 'D' : from != 'E' && from != 'F';
        if (!reachable || (table.traits.acknowledge_on_return && (from == 'D' || from == 'E'))) continue;
        const Step step = apply(before, event, table.traits);
        EXPECT_EQ(letter_of(step.status), row.empty() ? from : row[2]) << from << sign;
        EXPECT_EQ(step.refusal == Refusal::None, !row.empty()) << from << sign;
        if (row.empty()) {
          EXPECT_EQ(step.status, before);
        } else {
          EXPECT_EQ(step.status.active, sign == 'r' || (sign != 'n' && before.active)) << row;
        }
      }
    }
  }
}

TEST(AlarmStateMachine, WhenHiddenAndShown_ThenStrengthAndReturnAreThoseOfTheStandard) {
  struct Fact {
    AlarmEvent hide, show;
    bool AlarmStatus::*fact;
    AlarmState state;
  };
  const std::array<Fact, 3> facts = {
      {{RemoveFromService, ReturnToService, &AlarmStatus::out_of_service, OutOfService},
       {Suppress, Unsuppress, &AlarmStatus::suppressed, SuppressedByDesign},
       {Shelve, Unshelve, &AlarmStatus::shelved, Shelved}}};
  for (const Table& table : kTables) {
    for (const AlarmStatus& before : all_statuses(table.traits)) {
      for (const Fact& fact : facts) {
        const Step hidden = apply(before, fact.hide, table.traits);
        EXPECT_EQ(hidden.refusal, before.*fact.fact ? Refusal::AlreadySo : Refusal::None);
        EXPECT_TRUE(hidden.status.*fact.fact);
        EXPECT_EQ(hidden.status.active, before.active) << "hiding changes nothing of the process";
        EXPECT_EQ(hidden.status.annunciated, Normal);
        const Step shown = apply(before, fact.show, table.traits);
        EXPECT_EQ(shown.refusal, before.*fact.fact ? Refusal::None : Refusal::NotSo);
        if (shown.refusal != Refusal::None) {
          EXPECT_EQ(shown.status, before);
        } else if (!shown.status.is_hidden()) {
          EXPECT_EQ(shown.status.state(), before.active ? Unacknowledged : Normal);
        } else {
          EXPECT_EQ(shown.status.annunciated, Normal) << "another one still hides it";
        }
      }
      AlarmState strongest = before.annunciated;
      for (std::size_t i = facts.size(); i-- > 0;)
        if (before.*facts[i].fact) strongest = facts[i].state;
      EXPECT_EQ(before.state(), strongest);
    }
  }
}

TEST(AlarmStateMachine, WhenHidden_ThenTheProcessIsFollowedAndPeopleAreRefused) {
  for (const Table& table : kTables) {
    for (const AlarmStatus& before : all_statuses(table.traits)) {
      if (!before.is_hidden()) continue;
      const Step raised = apply(before, Raise, table.traits), returned = apply(before, Return, table.traits);
      EXPECT_TRUE(raised.status.active);
      EXPECT_FALSE(returned.status.active);
      EXPECT_EQ(raised.status.state(), before.state());
      EXPECT_EQ(returned.status.state(), before.state());
      EXPECT_NE(apply(before, Acknowledge, table.traits).refusal, Refusal::None);
      EXPECT_NE(apply(before, Reset, table.traits).refusal, Refusal::None);
    }
  }
}

TEST(AlarmStateMachine, WhenAllStatusesAreReached_ThenTheyAreAsManyAsTheFactsAllow) {
  // 7 combinations of hiding facts, each active or not, and the annunciated states: A to D; without D; A, B,
  // C, E, F; without E.
  const std::array<std::size_t, 4> annunciated = {4, 3, 5, 4};
  for (std::size_t i = 0; i < kTables.size(); ++i)
    EXPECT_EQ(all_statuses(kTables[i].traits).size(), 14 + annunciated[i]);
}

TEST(AlarmStateMachine, WhenALatchIsResetTooEarly_ThenTheReasonIsTold) {
  constexpr AlarmTraits kLatching = {true, false};
  EXPECT_EQ(apply(status_of('B'), Reset, kLatching).refusal, Refusal::StillActive);
  EXPECT_EQ(apply(status_of('E'), Reset, kLatching).refusal, Refusal::Unacknowledged);
  EXPECT_EQ(apply(status_of('A'), Reset, kLatching).refusal, Refusal::NotLatched);
  EXPECT_EQ(apply(status_of('C'), Reset, {}).refusal, Refusal::NotLatched);
  EXPECT_EQ(apply(status_of('C'), Acknowledge, {}).refusal, Refusal::Acknowledged);
}

TEST(AlarmStateMachine, WhenPrinted_ThenEveryWordIsDifferent) {
  std::set<std::string> words;
  for (std::uint8_t i = 0; i < kAlarmStates; ++i) words.insert(to_string(static_cast<AlarmState>(i)));
  for (std::uint8_t i = 0; i < kAlarmEvents; ++i) words.insert(to_string(static_cast<AlarmEvent>(i)));
  EXPECT_EQ(words.size(), static_cast<std::size_t>(kAlarmStates + kAlarmEvents));
}

}  // namespace
}  // namespace stepwright::alarms
