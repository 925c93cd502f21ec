#pragma once

// A plant that somebody has described in a file, as the runtime knows plants. CVODE integrates between
// events; an event, a terminal or a fault changes modes of components.
//
// Thread rule and meaning of terminals: core::Plant. Reproducible as the built-in plants are: the state at an
// instant depends on the file, the seed and the instants at which terminals and faults change, bit for bit,
// however finely advance_to() slices the time.
//
//   auto plant = ModelPlant::load("plant.toml", library::catalogue(), {.seed = 7});
//   if (!plant) return forward(plant);

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "plant_models/components/exchange.h"
#include "plant_models/components/model.h"
#include "plant_models/components/model_equations.h"
#include "plant_models/core/plant.h"
#include "plant_models/ode/cvode_solver.h"

namespace stepwright::components {

class ModelPlant final : public core::Plant {
 public:
  // Fails with everything that read_model() and assemble() find, or with C0331 (solver). `left`: numbers that
  // keep() wrote, to go on from; those of another plant are not taken.
  [[nodiscard]] static result::Result<std::unique_ptr<ModelPlant>> load(
      const std::filesystem::path& file, Catalogue catalogue, const ModelOptions& options,
      std::optional<std::span<const double>> left = std::nullopt);

  std::span<const core::Port> actuators() const override { return model_->actuators; }
  std::span<const core::Port> sensors() const override { return model_->sensors; }
  std::span<const core::Quantity> truths() const override { return model_->truths; }
  std::span<const core::Quantity> faults() const override { return model_->faults; }
  core::FaultRange fault_range(std::size_t fault) const override;
  // Its parts that are processes.
  [[nodiscard]] result::Result<void> start() override;
  bool failed() const override;
  // With the component that has its trouble.
  std::string trouble() override;
  // Liquid that came from nowhere or went to nowhere.
  std::string violation() const override;
  const core::PlantDescription& description() const override { return description_; }
  const Model& model() const { return *model_; }

  std::chrono::nanoseconds now() const override { return now_; }
  void set_actuator(core::ActuatorId id, std::int16_t value) override;
  core::PlantStatus advance_to(std::chrono::nanoseconds time) override;
  std::int16_t sensor(core::SensorId id) const override;
  double truth(core::TruthId id) const override;
  [[nodiscard]] result::Result<void> inject_fault(std::string_view name, double value) override;
  [[nodiscard]] result::Result<void> clear_fault(std::string_view name) override;

  // The states, in the order of the components, and then what makes sure that they are of the same plant. One
  // with parts that are processes does not go on from them: those begin anew.
  std::size_t kept_size() const override { return model_->states + 1; }
  void keep(std::span<double> numbers) const override;

  ode::CvodeStatistics statistics() const { return solver_ ? solver_->statistics() : ode::CvodeStatistics{}; }
  std::span<const double> state() const { return y_; }
  // It has failed for a process, and not for its equations. Any thread.
  bool lost_process() const { return exchange_.failed(); }

 private:
  explicit ModelPlant(std::unique_ptr<Model> model);

  Frame frame(double t_s);
  [[nodiscard]] result::Result<void> follow_processes();
  void settle(double t_s);
  void remember();
  bool follow_jumps(double t_s);
  bool is_endless(double t_s);
  bool restart(double t_s);
  core::PlantStatus advance_alone(std::chrono::nanoseconds time);
  bool give_inputs();
  bool run_to(double t_s);
  bool handle_event();
  bool go_on_from(double t_s);
  bool is_unseen();
  enum class Sampled : std::uint8_t { Nothing, Shown, All };
  void sample(Sampled wanted) const;
  Frame sampled_frame() const;
  double all_liquid() const;
  // Whose state changes fastest, beside its tolerance: where a solver that gives up has its trouble.
  std::uint32_t stiffest_component();
  core::PlantStatus give_up();
  double mark() const;
  void set_fault(std::size_t fault, double si);

  static constexpr std::chrono::nanoseconds kNever{-1};
  std::unique_ptr<Model> model_;
  std::unique_ptr<ModelEquations> equations_;
  std::unique_ptr<ode::CvodeSolver> solver_;  // null for a plant without states
  Exchange exchange_;
  core::PlantDescription description_;
  std::vector<double> y_;       // at now_
  std::vector<double> before_;  // derivatives around an event
  std::vector<double> after_;
  std::vector<std::uint32_t> jumping_;               // components that follow jumps
  std::chrono::nanoseconds remembered_at_ = kNever;  // they have been told then what was before
  std::vector<std::int16_t> actuators_;              // as commanded
  mutable std::vector<double> sampled_;              // values of the ports at now_, as far as `sampled_now_`
  mutable Sampled sampled_now_ = Sampled::Nothing;
  std::chrono::nanoseconds now_{0};
  double mark_ = 0.0;
  double liquid_at_start_ = 0.0;  // m3
  bool changed_ = false;          // an actuator, a fault or an answer may have changed at now_
  bool held_changed_ = false;     // a fault or an answer of a process has
  bool event_pending_ = false;    // the solver stands at a root that has not been handled
  bool failed_ = false;
  bool endless_events_ = false;
  int events_ = 0;  // since events_since_s_
  double events_since_s_ = 0.0;
  const Loop* unsolved_loop_ = nullptr;
  const std::string* unseen_event_ = nullptr;  // that was passed without being seen
  double event_at_s_ = -1.0;                   // the last one
  std::uint32_t last_event_component_ = 0;
  std::uint32_t failed_component_ = 0;
  std::atomic<bool> trouble_known_{false};  // then time and component of the failure do not change any more
};

}  // namespace stepwright::components
