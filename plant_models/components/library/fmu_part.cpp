#include "plant_models/components/library/fmu_part.h"

#include <cmath>
#include <utility>

#include "plant_models/core/names.h"

namespace stepwright::components::library {
namespace {

class FmuPart final : public ProcessPart {
 public:
  explicit FmuPart(std::shared_ptr<const FmuSetup> setup) : setup_(std::move(setup)) {
    for (const FmuPort& each : setup_->outputs) held_.push_back(each.start);
    fresh_.resize(held_.size());
  }

  void evaluate(std::uint32_t, const Frame& f) const override {
    for (std::size_t i = 0; i < held_.size(); ++i) across(f, setup_->inputs.size() + i) = held_[i];
  }

  result::Result<void> start(const Frame& sampled) override {
    stepped::StepCommand command = setup_->command;
    for (std::size_t i = 0; i < setup_->inputs.size(); ++i)
      command.first_actuators.push_back(input(sampled, i));
    auto link = stepped::StepLink::start(
        {core::names_of(setup_->inputs), core::names_of(setup_->outputs), {}, core::names_of(setup_->faults)},
        setup_->seed, command);
    if (!link) return result::forward(link);
    link_ = std::move(*link);
    if (take() == Answer::Lost) return result::fail("R0155", command.where, trouble());
    return {};
  }

  bool ask(const Frame& sampled, std::int64_t time_ns, std::int64_t step_ns) override {
    const stepped::StepArea& area = link_->area();
    for (std::size_t i = 0; i < setup_->inputs.size(); ++i) area.set_actuator(i, input(sampled, i));
    for (std::size_t i = 0; i < setup_->faults.size(); ++i)
      area.set_fault(i, fault(i) / setup_->faults[i].unit.factor);
    return link_->ask(time_ns, step_ns);
  }

  Answer finish() override { return link_->finish() ? take() : Answer::Lost; }
  bool failed() const override { return link_ && link_->failed(); }
  std::string trouble() override {
    const std::string said = link_ ? link_->trouble() : std::string();
    return said.empty() ? said : "'" + setup_->name + "': " + said;
  }

 private:
  // In the unit of the FMU.
  double input(const Frame& sampled, std::size_t port) const {
    const FmuPort& of = setup_->inputs[port];
    const double value = across(sampled, port);
    return of.is_switch ? (value >= 0.5 ? 1.0 : 0.0) : of.unit.from_si(value);
  }

  // All numbers or none.
  Answer take() {
    const stepped::StepArea& area = link_->area();
    bool changed = false;
    for (std::size_t i = 0; i < fresh_.size(); ++i) {
      const FmuPort& of = setup_->outputs[i];
      const double number = area.sensor(i);
      if (!std::isfinite(number)) {
        link_->refuse_number(of.name);
        return Answer::Lost;
      }
      fresh_[i] = of.is_switch ? (number != 0.0 ? 1.0 : 0.0) : of.unit.to_si(number);
      changed = changed || fresh_[i] != held_[i];
    }
    held_.swap(fresh_);
    return changed ? Answer::Changed : Answer::Same;
  }

  std::shared_ptr<const FmuSetup> setup_;  // shared with the type, which makes such parts
  std::vector<double> held_;               // outputs, SI
  std::vector<double> fresh_;
  std::unique_ptr<stepped::StepLink> link_;
};

}  // namespace

std::unique_ptr<Component> make_fmu_part(std::shared_ptr<const FmuSetup> setup) {
  return std::make_unique<FmuPart>(std::move(setup));
}

}  // namespace stepwright::components::library
