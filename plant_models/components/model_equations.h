#pragma once

// The differential equations of a model, for CVODE: works out the values in their order, then the
// derivatives.
//
// Thread rule: one thread at a time; after create() nothing allocates. The model must outlive it and must not
// move.

#include <memory>
#include <span>
#include <vector>

#include "plant_models/components/loop_solver.h"
#include "plant_models/components/model.h"
#include "plant_models/ode/ode_system.h"
#include "runtime/ground/result/result.h"

namespace stepwright::components {

class ModelEquations final : public ode::OdeSystem {
 public:
  // Fails with C0331 when a loop cannot be set up.
  [[nodiscard]] static result::Result<std::unique_ptr<ModelEquations>> create(const Model& model);

  std::size_t state_size() const override { return model_.states; }
  std::size_t root_count() const override { return model_.roots; }
  void derivative(double t, std::span<const double> y, std::span<double> dydt) const override;
  void roots(double t, std::span<const double> y, std::span<double> g) const override;

  std::vector<std::vector<std::uint32_t>> dependencies() const override;

  // Values of the ports as the solver last worked them out, which a terminal's are among.
  double* values() { return values_.data(); }
  // Works out all values in `frame.v`, which has as many places as the model's own.
  void evaluate(const Frame& frame) const;
  // Only what the program's inputs come from.
  void evaluate_shown(const Frame& frame) const;
  void derivatives(const Frame& frame) const;
  // A loop of which the newest values are none; null if all are solved.
  const Loop* unsolved() const;
  // Works out all values and the modes that follow from them, until no mode changes another one.
  void settle(const Frame& frame) const;

 private:
  explicit ModelEquations(const Model& model) : model_(model), values_(model.values) {}
  void run(const std::vector<Step>& steps, const Frame& frame) const;

  const Model& model_;
  mutable std::vector<double> values_;
  mutable std::vector<LoopSolver> loops_;
};

}  // namespace stepwright::components
