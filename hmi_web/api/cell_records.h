#pragma once

// Interface of the routes to the records of the cell: values over months, alarms and their journal.
// hmi_web/recorder implements it; a server without it keeps nothing.
//
//   records.trend({{"tags", "points/a1.level"}, {"columns", "600"}});       // hmi_web/doc/records.md
//   records.act({.alarm = "a1.high", .event = "acknowledge", .user = "anna"});
//
// Threads: every function from any; each reads files or waits for the disk. Parameters are those of a query,
// from anybody. Diagnostics: H0060 a parameter is missing or wrong, H0061 the answer would be too long, C0606
// the alarm's state or definition does not allow it, C0607 there is no such alarm, S0001 to S0007 the file.

#include <chrono>
#include <map>
#include <string>

#include "hmi_web/api/route.h"
#include "runtime/ground/result/result.h"

namespace stepwright::api {

struct AlarmAction {
  std::string alarm;  // its name
  std::string event;  // as the journal names it: "acknowledge", "remove from service" ...
  std::string user;
  std::string comment;
  std::chrono::minutes shelve_for{0};  // "shelve": above 0
};

// States before and after, as the list of alarms names them.
struct AlarmChange {
  std::string before;
  std::string after;
};

class CellRecords {
 public:
  using Parameters = std::map<std::string, std::string, std::less<>>;

  virtual ~CellRecords() = default;

  virtual Answer tags(const Parameters& given) const = 0;
  virtual Answer trend(const Parameters& given) const = 0;
  virtual Answer samples_csv(const Parameters& given) const = 0;
  virtual Answer alarms(const Parameters& given) const = 0;
  virtual Answer journal(const Parameters& given) const = 0;
  virtual Answer journal_csv(const Parameters& given) const = 0;

  // Returns when it is in the journal.
  [[nodiscard]] virtual result::Result<AlarmChange> act(const AlarmAction& action) = 0;

  // The machine's calendar, which has jumped far ahead, is right. False: it is believed already.
  virtual bool accept_calendar() = 0;
};

}  // namespace stepwright::api
