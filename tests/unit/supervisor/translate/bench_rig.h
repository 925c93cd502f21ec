#pragma once

// A chart running on a very simple bench: pumps move levels at a constant speed, the vehicle drives at a
// constant speed, sensors are exact. Enough to see that a generated chart does what its plan says.

#include <map>
#include <string>
#include <vector>

#include "supervisor/translate/progress.h"
#include "supervisor/translate/translation.h"
#include "tests/support/sfc_reference.h"

namespace stepwright::translate::testing {

class BenchRig {
 public:
  BenchRig(const Translation& translation, const Binding& binding, const Tare& bias = {});

  // Scans until DONE or a Failed step is active, or `seconds` have passed. Returns the step's name, else "".
  std::string run(double seconds);
  // One scan of 10 ms.
  void scan();

  bool active(const std::string& step) const;
  bool output(const std::string& name) const;
  std::vector<bool> active_steps() const;
  double time_s() const { return static_cast<double>(scans_) * 0.01; }

  // Free to change between scans. Position: a1 at -1, f1 at 0, a2 at +1.
  double position = 0.0;
  std::map<std::string, double> levels = {{"(lev v1)", 2}, {"(level a1)", 2}, {"(level a2)", 2}};
  std::map<std::string, double> stuck;  // tag -> value that it shows whatever happens
  double pump_speed = 0.8;              // levels per second; customer pumps half of it
  double run_out = 0.23;  // levels that still flow when a pump is off; customer pumps half of it

 private:
  double input(const std::string& name) const;
  void move_plant();
  void pump(const std::string& name, double amount);

  const Translation& translation_;
  const Binding& binding_;
  Tare bias_;
  support::SfcReference chart_;
  std::map<std::string, bool> pumping_;
  long scans_ = 0;
};

}  // namespace stepwright::translate::testing
