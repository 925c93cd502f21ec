// Bringing a program to run: by an online change from the program that runs, so that the plant is never
// without control, or by download and start.

#include <utility>

#include "supervisor/executive/executive.h"
#include "supervisor/translate/monitors.h"
#include "supervisor/translate/sensor_program.h"

namespace stepwright::executive {

result::Result<run::ImageReader> Executive::reader_of(const PreparedPlan& prepared, Kind kind) const {
  std::vector<std::string> variables;
  for (const translate::Sensor& sensor : planning_.binding().sensors) {
    variables.push_back(translate::filtered_variable(sensor));
    variables.push_back(sensor.tag);
    if (kind != Kind::Observer) continue;
    variables.push_back(translate::half_variable(sensor));
    if (sensor.max_rate > 0.0) variables.push_back(translate::leaping_variable(sensor));
  }
  for (const translate::ObservedFact& fact : planning_.binding().facts) variables.push_back(fact.tag);
  return run::ImageReader::create(prepared.container, prepared.translation.instance, variables);
}

// The readers of a program; gives up if it lacks what they need.
bool Executive::read_program(const PreparedPlan& prepared, Kind kind) {
  auto reader = reader_of(prepared, kind);
  if (!reader) return give_up("the program cannot be read", reader.error());
  reader_ = std::move(*reader);
  alarm_reader_.reset();
  if (kind == Kind::Observer || prepared.translation.monitors.empty()) return true;
  std::vector<std::string> alarms = {translate::kAlarmCount};
  for (std::size_t i = 0; i < prepared.translation.monitors.size(); ++i) {
    alarms.push_back(translate::alarm_scan_variable(i));
    alarms.push_back(translate::alarm_value_variable(i));
  }
  auto alarm_reader = run::ImageReader::create(prepared.container, prepared.translation.instance, alarms);
  if (!alarm_reader) return give_up("the program cannot be read", alarm_reader.error());
  alarm_reader_ = std::move(*alarm_reader);
  return true;
}

// False if the runtime is lost (phase unchanged) or refuses (phase Safe).
bool Executive::install(const PreparedPlan& prepared, Kind kind) {
  alarms_seen_ = 0;
  alarms_told_.clear();
  // The first plan starts the trace of the first run from nothing. Every other program takes over from the
  // one before: what the programs of people have latched (an emergency stop, until somebody resets it) stays.
  const bool relieves = !record_.replans.empty() || another_run_;
  return (relieves && runs() && take_over(prepared, kind)) ||
         (record_.phase != run::Phase::Safe && download_and_start(prepared, kind));
}

// False if it is refused, or if no news of it came: then the program is installed as if none ran.
bool Executive::take_over(const PreparedPlan& prepared, Kind kind) {
  if (!change(prepared.container)) {
    (void)controller_.stop("the next program cannot take over");
    return false;
  }
  return read_program(prepared, kind) && await_event(host::EventKind::Changed);
}

bool Executive::download_and_start(const PreparedPlan& prepared, Kind kind) {
  return download(prepared.container) && read_program(prepared, kind) && start();
}

}  // namespace stepwright::executive
