#include "plant_models/components/dependencies.h"

#include <algorithm>
#include <iterator>

namespace stepwright::components {
namespace {

using States = std::vector<std::uint32_t>;

void add(States& to, const States& more) {
  States sum;
  std::set_union(to.begin(), to.end(), more.begin(), more.end(), std::back_inserter(sum));
  to = std::move(sum);
}

class Tracer {
 public:
  explicit Tracer(const Model& model) : model_(model), of_value_(model.values.size()) {}

  std::vector<States> trace() {
    run(model_.order);
    std::vector<States> rows(model_.states);
    for (const std::uint32_t c : model_.with_states) {
      States all = own(c);
      const ComponentType& type = *model_.types[c];
      for (std::size_t i = 0; i < type.ports.size(); ++i) {
        visit(type.ports[i], model_.components[c]->ports()[i],
              [&](std::uint32_t value) { add(all, of_value_[value]); });
      }
      for (std::size_t s = 0; s < model_.components[c]->state_count(); ++s)
        rows[model_.first_state[c] + s] = all;
    }
    return rows;
  }

 private:
  States own(std::uint32_t component) const {
    States states;
    for (std::size_t s = 0; s < model_.components[component]->state_count(); ++s)
      states.push_back(model_.first_state[component] + static_cast<std::uint32_t>(s));
    return states;
  }
  // All values of a port, read or written.
  template <typename Each>
  static void visit(const PortSpec& spec, const PortSlots& slots, Each each) {
    for (std::uint32_t i = 0; i < across_size(spec.kind); ++i) each(slots.across + i);
    for (std::uint32_t i = 0; i < through_size(spec.kind); ++i) each(slots.through + i);
  }

  void run(const std::vector<Step>& steps) {
    for (const Step& step : steps) {
      switch (step.kind) {
        case StepKind::Evaluate:
          evaluate(step);
          break;
        case StepKind::Gather: {
          const Gathering& gathering = model_.gatherings[step.index];
          for (const std::uint32_t from : gathering.from) add(of_value_[gathering.to], of_value_[from]);
          break;
        }
        case StepKind::Solve:
          solve(model_.loops[step.index]);
          break;
      }
    }
  }
  void evaluate(const Step& step) {
    const ComponentType& type = *model_.types[step.index];
    const auto& slots = model_.components[step.index]->ports();
    States read = own(step.index);
    for (std::size_t i = 0; i < type.ports.size(); ++i) {
      const PortSpec& port = type.ports[i];
      if (port.reads > step.stage) continue;
      if (port.role == Role::Branch)
        for (std::uint32_t k = 0; k < across_size(port.kind); ++k) add(read, of_value_[slots[i].across + k]);
      else
        for (std::uint32_t k = 0; k < through_size(port.kind); ++k)
          add(read, of_value_[slots[i].through + k]);
    }
    for (std::size_t i = 0; i < type.ports.size(); ++i) {
      const PortSpec& port = type.ports[i];
      if (port.stage != step.stage) continue;
      if (port.role == Role::Node)
        for (std::uint32_t k = 0; k < across_size(port.kind); ++k) add(of_value_[slots[i].across + k], read);
      else
        for (std::uint32_t k = 0; k < through_size(port.kind); ++k)
          add(of_value_[slots[i].through + k], read);
    }
  }
  // All that is in a loop depends on all that comes into it.
  void solve(const Loop& loop) {
    run(loop.steps);
    States all;
    for (const std::uint32_t residual : loop.residuals) add(all, of_value_[residual]);
    for (const std::uint32_t unknown : loop.unknowns) add(of_value_[unknown], all);
    run(loop.steps);
  }

  const Model& model_;
  std::vector<States> of_value_;
};

}  // namespace

std::vector<States> dependencies_of(const Model& model) {
  return Tracer(model).trace();
}

}  // namespace stepwright::components
