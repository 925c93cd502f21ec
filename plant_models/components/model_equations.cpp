#include "plant_models/components/model_equations.h"

#include <algorithm>

#include "plant_models/components/dependencies.h"

namespace stepwright::components {
namespace {

constexpr int kMostSettlings = 16;  // modes that change modes

}  // namespace

result::Result<std::unique_ptr<ModelEquations>> ModelEquations::create(const Model& model) {
  std::unique_ptr<ModelEquations> equations(new ModelEquations(model));
  for (const Loop& loop : model.loops) {
    auto solver = LoopSolver::create(
        loop,
        [](const void* context, const Loop& of, const Frame& frame) {
          static_cast<const ModelEquations*>(context)->run(of.steps, frame);
        },
        equations.get());
    if (!solver) return result::forward(solver);
    equations->loops_.push_back(std::move(*solver));
  }
  return equations;
}

void ModelEquations::run(const std::vector<Step>& steps, const Frame& frame) const {
  for (const Step& step : steps) {
    switch (step.kind) {
      case StepKind::Evaluate:
        model_.components[step.index]->evaluate(step.stage, frame);
        break;
      case StepKind::Gather: {
        const Gathering& gathering = model_.gatherings[step.index];
        double sum = 0.0;
        for (const std::uint32_t from : gathering.from) sum += frame.v[from];
        frame.v[gathering.to] = sum;
        break;
      }
      case StepKind::Solve:
        loops_[step.index].solve(frame);
        break;
    }
  }
}

const Loop* ModelEquations::unsolved() const {
  for (std::size_t i = 0; i < loops_.size(); ++i)
    if (!loops_[i].solved()) return &model_.loops[i];
  return nullptr;
}

void ModelEquations::evaluate(const Frame& frame) const {
  run(model_.order, frame);
}

void ModelEquations::evaluate_shown(const Frame& frame) const {
  run(model_.shown, frame);
}

void ModelEquations::derivatives(const Frame& frame) const {
  for (const std::uint32_t component : model_.with_states) model_.components[component]->derivative(frame);
}

void ModelEquations::settle(const Frame& frame) const {
  for (int round = 0; round < kMostSettlings; ++round) {
    evaluate(frame);
    bool changed = false;
    for (const auto& component : model_.components) changed = component->settle(frame) || changed;
    if (!changed) return;
  }
}

std::vector<std::vector<std::uint32_t>> ModelEquations::dependencies() const {
  return dependencies_of(model_);
}

void ModelEquations::derivative(double t, std::span<const double> y, std::span<double> dydt) const {
  const Frame frame{.t_s = t, .y = y.data(), .v = values_.data(), .dydt = dydt.data()};
  evaluate(frame);
  derivatives(frame);
}

void ModelEquations::roots(double t, std::span<const double> y, std::span<double> g) const {
  const Frame frame{.t_s = t, .y = y.data(), .v = values_.data()};
  run(model_.watched, frame);
  for (const std::uint32_t component : model_.with_roots)
    model_.components[component]->roots(frame, g.data() + model_.first_root[component]);
}

}  // namespace stepwright::components
