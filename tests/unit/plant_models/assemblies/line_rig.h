#pragma once

// A sorting line operated by hand, terminal by terminal.

#include <functional>
#include <memory>
#include <string>

#include "plant_models/assemblies/sorting_line.h"

namespace stepwright::assemblies {

class LineRig {
 public:
  explicit LineRig(LineParameters parameters = {});

  SortingLine& plant() { return *line_; }
  void set(const std::string& actuator, bool on);
  double read(const std::string& sensor) const;
  double truth(const std::string& name) const;
  void fault(const std::string& name, double value);
  double time_s() const;

  void run(double seconds);
  // Scans of 10 ms until it holds; false after `limit_s`.
  bool run_until(const std::function<bool()>& holds, double limit_s);

  // Acts as the plan of a cell: the outputs are on until the sensor has the value, then off.
  bool drive(const std::vector<std::string>& outputs, const std::string& sensor, double value,
             double limit_s = 10);
  bool feed() { return drive({"belt_in"}, "eye_in", 1); }
  bool convey(const std::string& from, const std::string& to) {
    return drive({"belt_" + from, "belt_" + to}, "eye_" + to, 1);
  }
  // From a diverter's belt into its chute; waits until the pusher is back.
  bool divert(int diverter);
  // Over the end of the line.
  bool run_off(int chute);
  // From the end of the line through the lane back to the reader.
  bool recirculate();

 private:
  bool push_back_home(const std::string& pusher);
  std::unique_ptr<SortingLine> line_;
};

}  // namespace stepwright::assemblies
