#include "plant_models/fmu/fmu_plant.h"

#include <optional>

#include "plant_models/fmu/fmu_file.h"
#include "plant_models/fmu/fmu_wiring.h"
#include "plant_models/fmu/model_instance.h"

namespace stepwright::fmu {
namespace {

class FmuPlant {
 public:
  explicit FmuPlant(stepped::StepPeer& peer) : area_(peer.area()) {}

  result::Result<void> load(const FmuOptions& options) {
    auto file = FmuFile::open(options.file);
    if (!file) return result::forward(file);
    file_.emplace(std::move(*file));
    auto library = file_->unpack(std::filesystem::absolute(options.folder));
    if (!library) return result::forward(library);
    auto found = find_all(options);
    if (!found) return result::forward(found);
    auto instance = make_instance(file_->description(), *library, std::filesystem::absolute(options.folder));
    if (!instance) return result::forward(instance);
    instance_ = std::move(*instance);
    return initialize(options);
  }

  std::string step(std::int64_t time_ns, std::int64_t step_ns) {
    constexpr double kSeconds = 1e-9;
    for (std::size_t i = 0; i < actuators_.size(); ++i) {
      if (!instance_->set(*actuators_[i], area_.actuator(i))) return refused(*actuators_[i]);
    }
    for (std::size_t i = 0; i < faults_.size(); ++i) {
      const double fault = area_.fault(i);
      if (fault == known_faults_[i]) continue;
      known_faults_[i] = fault;
      if (!instance_->set(*faults_[i], fault == 0.0 ? faults_[i]->start : fault)) return refused(*faults_[i]);
    }
    const double from_s = static_cast<double>(time_ns - step_ns) * kSeconds;
    if (!instance_->step(from_s, static_cast<double>(step_ns) * kSeconds))
      return "the FMU makes no step" + words();
    return sample();
  }

 private:
  result::Result<void> find_all(const FmuOptions& options) {
    const stepped::StepNames names = area_.names();
    std::vector<WantedVariable> wanted;
    for (const std::string& name : names.actuators) wanted.push_back({name, VariableUse::Actuator});
    for (const std::string& name : names.sensors) wanted.push_back({name, VariableUse::Sensor});
    for (const std::string& name : names.values) wanted.push_back({name, VariableUse::Sensor});
    for (const std::string& name : names.faults) wanted.push_back({name, VariableUse::Fault});
    for (const auto& [name, value] : options.parameters) wanted.push_back({name, VariableUse::Parameter});
    auto found = find_variables(file_->description(), wanted);
    if (!found) return result::forward(found);
    auto next = found->begin();
    const auto take = [&next](std::size_t count) {
      std::vector<const ModelVariable*> list(next, next + static_cast<std::ptrdiff_t>(count));
      next += static_cast<std::ptrdiff_t>(count);
      return list;
    };
    actuators_ = take(names.actuators.size());
    sensors_ = take(names.sensors.size());
    values_ = take(names.values.size());
    faults_ = take(names.faults.size());
    parameters_ = take(options.parameters.size());
    known_faults_.resize(faults_.size());
    return {};
  }

  // Start values are set before and in the initialization, as the standard has it for parameters and inputs.
  result::Result<void> initialize(const FmuOptions& options) {
    const auto fail = [](const std::string& why) { return result::fail("C0334", {}, why); };
    for (std::size_t i = 0; i < parameters_.size(); ++i) {
      if (!instance_->set(*parameters_[i], options.parameters[i].second))
        return fail(refused(*parameters_[i]));
    }
    if (!instance_->begin_initialization()) return fail("the FMU cannot be initialized" + words());
    for (std::size_t i = 0; i < actuators_.size(); ++i) {
      if (!instance_->set(*actuators_[i], area_.actuator(i))) return fail(refused(*actuators_[i]));
    }
    if (!instance_->finish_initialization()) return fail("the FMU cannot be initialized" + words());
    if (const std::string why = sample(); !why.empty()) return fail(why);
    return {};
  }

  std::string sample() {
    double number = 0.0;
    for (std::size_t i = 0; i < sensors_.size(); ++i) {
      if (!instance_->get(*sensors_[i], number)) return refused(*sensors_[i]);
      area_.set_sensor(i, number);
    }
    for (std::size_t i = 0; i < values_.size(); ++i) {
      if (!instance_->get(*values_[i], number)) return refused(*values_[i]);
      area_.set_value(i, number);
    }
    return {};
  }

  std::string words() const { return instance_->said().empty() ? "" : ": " + instance_->said(); }
  std::string refused(const ModelVariable& variable) const {
    return "the FMU refuses its variable '" + variable.name + "'" + words();
  }

  stepped::StepArea& area_;
  std::optional<FmuFile> file_;
  std::unique_ptr<ModelInstance> instance_;
  std::vector<const ModelVariable*> actuators_;
  std::vector<const ModelVariable*> sensors_;
  std::vector<const ModelVariable*> values_;
  std::vector<const ModelVariable*> faults_;
  std::vector<const ModelVariable*> parameters_;
  std::vector<double> known_faults_;
};

}  // namespace

int run_fmu(stepped::StepPeer& peer, const FmuOptions& options) {
  FmuPlant plant(peer);
  if (auto loaded = plant.load(options); !loaded) {
    const result::Diagnostic& first = loaded.error().front();
    return peer.refuse(first.code + ": " + first.message);
  }
  return peer.serve(
      [&plant](std::int64_t time_ns, std::int64_t step_ns) { return plant.step(time_ns, step_ns); });
}

}  // namespace stepwright::fmu
