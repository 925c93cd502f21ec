#pragma once

// Records that remember what they were asked, and let every action happen unless they are told otherwise.
//
// Threads: one at a time.

#include <string>
#include <utility>
#include <vector>

#include "hmi_web/api/cell_records.h"

namespace stepwright::api {

class FakeRecords : public CellRecords {
 public:
  Answer tags(const Parameters& given) const override { return note("tags", given); }
  Answer trend(const Parameters& given) const override { return note("trend", given); }
  Answer samples_csv(const Parameters& given) const override { return note("samples", given); }
  Answer alarms(const Parameters& given) const override { return note("alarms", given); }
  Answer journal(const Parameters& given) const override { return note("journal", given); }
  Answer journal_csv(const Parameters& given) const override { return note("table", given); }
  result::Result<AlarmChange> act(const AlarmAction& action) override {
    if (action.alarm == refused_alarm) return result::fail("C0606", {}, "as the test wants it");
    if (!failure.empty()) return result::fail(failure, {}, "as the test wants it");
    actions.push_back(action);
    return AlarmChange{"unacknowledged", "acknowledged"};
  }

  bool accept_calendar() override { return std::exchange(doubted, false); }

  std::vector<AlarmAction> actions;
  bool doubted = true;                     // the calendar
  std::string failure;                     // the code with which every action fails; empty: none does
  std::string refused_alarm;               // the one that does not allow anything
  mutable std::vector<std::string> asked;  // "trend columns=5 tags=a"

 private:
  Answer note(std::string what, const Parameters& given) const {
    for (const auto& [name, value] : given) what += " " + name + "=" + value;
    asked.push_back(what);
    return {};
  }
};

}  // namespace stepwright::api
