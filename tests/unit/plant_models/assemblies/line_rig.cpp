#include "tests/unit/plant_models/assemblies/line_rig.h"

#include <stdexcept>

namespace stepwright::assemblies {

using namespace std::chrono_literals;

LineRig::LineRig(LineParameters parameters) {
  auto line = SortingLine::create(parameters);
  if (!line) throw std::runtime_error(result::to_string(line.error()));
  line_ = std::move(*line);
  set("contactor", true);
  run(0.1);
}

void LineRig::set(const std::string& actuator, bool on) {
  line_->set_actuator(core::find_actuator(*line_, actuator).value(), on);
}

double LineRig::read(const std::string& sensor) const {
  return line_->sensor(core::find_sensor(*line_, sensor).value());
}

double LineRig::truth(const std::string& name) const {
  return line_->truth(core::find_truth(*line_, name).value());
}

void LineRig::fault(const std::string& name, double value) {
  auto injected = line_->inject_fault(name, value);
  if (!injected) throw std::runtime_error(result::to_string(injected.error()));
}

double LineRig::time_s() const {
  return std::chrono::duration<double>(line_->now()).count();
}

void LineRig::run(double seconds) {
  run_until([] { return false; }, seconds);
}

bool LineRig::run_until(const std::function<bool()>& holds, double limit_s) {
  const double end_s = time_s() + limit_s - 0.005;
  while (time_s() < end_s) {
    if (holds()) return true;
    if (line_->advance(10ms) != core::PlantStatus::Good) throw std::runtime_error("the plant has failed");
  }
  return holds();
}

bool LineRig::drive(const std::vector<std::string>& outputs, const std::string& sensor, double value,
                    double limit_s) {
  for (const std::string& output : outputs) set(output, true);
  const bool done = run_until([&] { return read(sensor) == value; }, limit_s);
  for (const std::string& output : outputs) set(output, false);
  run(0.3);
  return done;
}

bool LineRig::push_back_home(const std::string& pusher) {
  return run_until([&] { return read("home_" + pusher) == 1; }, 3.0);
}

bool LineRig::divert(int diverter) {
  const std::string name = std::to_string(diverter);
  const std::string counter = "count_" + name;
  return drive({"push_" + name}, counter, read(counter) + 1) && push_back_home(name);
}

bool LineRig::run_off(int chute) {
  const std::string counter = "count_" + std::to_string(chute);
  return drive({"belt_e"}, counter, read(counter) + 1);
}

bool LineRig::recirculate() {
  return drive({"push_e"}, "eye_t1", 1) && push_back_home("e") && drive({"belt_t"}, "eye_t", 1) &&
         drive({"push_t"}, "eye_r", 1) && push_back_home("t");
}

}  // namespace stepwright::assemblies
