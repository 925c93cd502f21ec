#pragma once

// Watches a plant at rest while its next plan is made: nothing may move away from the state that the plan
// starts in. Raw counts are noisy, so levels are judged by the mean of the last readings.
//
//   RestWatch rest(binding, tare, start);
//   if (auto news = rest.see(reader.values(snapshot.image), snapshot.scan)) plan_again(*news);
//
// Threads: one thread uses an object; the binding must outlive it.

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>

#include "supervisor/model/planned_run.h"
#include "supervisor/translate/binding.h"
#include "supervisor/translate/sensor_condition.h"

namespace stepwright::executive {

class RestWatch {
 public:
  RestWatch(const translate::Binding& binding, translate::Tare tare, model::NamedState start);

  // `values` of the tags by name, after scan number `scan`; one scan counts once. A sentence when something
  // has changed.
  std::optional<std::string> see(const std::map<std::string, double>& values, std::uint64_t scan);

 private:
  std::optional<std::string> changed_fact(const std::map<std::string, double>& values);
  std::optional<std::string> changed_level(const std::map<std::string, double>& values);

  const translate::Binding& binding_;
  translate::Tare tare_;
  model::NamedState start_;
  std::map<std::string, std::deque<double>> readings_;  // by sensor
  std::string suspect_;                                 // a fact that was different the last time, too
  std::optional<std::uint64_t> seen_;
};

}  // namespace stepwright::executive
