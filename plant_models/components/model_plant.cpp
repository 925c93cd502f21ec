#include "plant_models/components/model_plant.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdio>

#include "plant_models/components/describe.h"
#include "plant_models/components/starts.h"
#include "runtime/base/hash64.h"

namespace stepwright::components {
namespace {

double seconds(std::chrono::nanoseconds time) {
  return static_cast<double>(time.count()) * 1e-9;
}

ode::CvodeSettings settings_of(const Model& model) {
  ode::CvodeSettings settings;
  settings.relative_tolerance = model.text.solver.relative_tolerance;
  settings.max_step_s = model.text.solver.max_step_s;
  settings.absolute_tolerance = model.tolerances();
  settings.implicit = model.text.solver.implicit;
  return settings;
}

}  // namespace

ModelPlant::ModelPlant(std::unique_ptr<Model> model)
    : model_(std::move(model)),
      exchange_(model_->processes,
                std::chrono::nanoseconds(std::llround(model_->text.communication_step_s * 1e9))),
      y_(model_->start()),
      before_(model_->states),
      after_(model_->states),
      actuators_(model_->actuators.size(), 0),
      sampled_(model_->values) {
  for (const std::uint32_t c : model_->with_roots)
    if (model_->components[c]->follows_jumps()) jumping_.push_back(c);
  description_ = describe(*model_);
  mark_ = mark();
}

result::Result<std::unique_ptr<ModelPlant>> ModelPlant::load(const std::filesystem::path& file,
                                                             Catalogue catalogue, const ModelOptions& options,
                                                             std::optional<std::span<const double>> left) {
  auto text = read_model(file, catalogue, options);
  if (!text) return result::forward(text);
  auto model = assemble(std::move(*text));
  if (!model) return result::forward(model);
  if (auto worked_out = work_out_starts(**model); !worked_out) return result::forward(worked_out);
  std::unique_ptr<ModelPlant> plant(new ModelPlant(std::move(*model)));
  auto equations = ModelEquations::create(*plant->model_);
  if (!equations) return result::forward(equations);
  plant->equations_ = std::move(*equations);
  const bool goes_on = left && plant->model_->processes.empty() && left->size() == plant->kept_size() &&
                       left->back() == plant->mark_ &&
                       std::all_of(left->begin(), left->end(), [](double x) { return std::isfinite(x); });
  if (goes_on) std::copy_n(left->begin(), plant->y_.size(), plant->y_.begin());
  plant->liquid_at_start_ = plant->all_liquid();
  plant->settle(0.0);
  if (plant->y_.empty()) return plant;
  auto solver = ode::CvodeSolver::create(*plant->equations_, plant->y_, 0.0, settings_of(*plant->model_));
  if (!solver) return result::forward(solver);
  plant->solver_ = std::make_unique<ode::CvodeSolver>(std::move(*solver));
  return plant;
}

// Names and states of the components as one number.
double ModelPlant::mark() const {
  std::uint64_t hash = model_->states;
  for (std::size_t i = 0; i < model_->names.size(); ++i) {
    hash = base::hash_mix(hash, base::hash_bytes(std::as_bytes(std::span(model_->names[i]))));
    hash = base::hash_mix(hash, base::hash_bytes(std::as_bytes(std::span(model_->types[i]->name))));
  }
  return static_cast<double>(hash >> 12);
}

Frame ModelPlant::frame(double t_s) {
  return {.t_s = t_s, .time_ns = std::llround(t_s * 1e9), .y = y_.data(), .v = equations_->values()};
}

void ModelPlant::set_actuator(core::ActuatorId id, std::int16_t value) {
  assert(id.value < actuators_.size());
  const bool is_bit = model_->actuators[id.value].kind == core::PortKind::Bool;
  const std::int16_t wanted = is_bit ? static_cast<std::int16_t>(value != 0) : value;
  actuators_[id.value] = wanted;
  changed_ = changed_ || equations_->values()[model_->actuator_at[id.value].slot] != wanted;
}

// Modes that follow from inputs, until none changes another one.
void ModelPlant::settle(double t_s) {
  for (std::size_t i = 0; i < actuators_.size(); ++i)
    equations_->values()[model_->actuator_at[i].slot] = actuators_[i];
  equations_->settle(frame(t_s));
}

result::Result<void> ModelPlant::start() {
  result::Result<void> followed;
  remembered_at_ = kNever;
  auto started = exchange_.start([&] {
    if (followed) followed = follow_processes();
    settle(seconds(now_));
    sampled_now_ = Sampled::Nothing;
    return sampled_frame();
  });
  if (started && followed && exchange_.running()) followed = follow_processes();
  sampled_now_ = Sampled::Nothing;
  changed_ = held_changed_ = exchange_.running();
  return followed ? started : followed;
}

// Starts may follow from what the processes have said.
result::Result<void> ModelPlant::follow_processes() {
  if (auto worked_out = work_out_starts(*model_); !worked_out) return worked_out;
  y_ = model_->start();
  liquid_at_start_ = all_liquid();
  return {};
}

core::PlantStatus ModelPlant::advance_to(std::chrono::nanoseconds time) {
  if (time <= now_ || failed_) return failed_ ? core::PlantStatus::Failed : core::PlantStatus::Good;
  while (exchange_.running() && exchange_.end() <= time) {
    if (advance_alone(exchange_.end()) != core::PlantStatus::Good) return core::PlantStatus::Failed;
    remember();
    const Answer answer = exchange_.finish();
    failed_ = answer == Answer::Lost;
    if (failed_) return core::PlantStatus::Failed;
    if (answer == Answer::Changed) changed_ = held_changed_ = true;
    sampled_now_ = Sampled::Nothing;
  }
  return advance_alone(time);
}

// False: a process is lost.
bool ModelPlant::give_inputs() {
  if (!exchange_.due()) return true;
  sampled_now_ = Sampled::Nothing;
  return exchange_.ask(sampled_frame());
}

// With what the processes have answered last.
core::PlantStatus ModelPlant::advance_alone(std::chrono::nanoseconds time) {
  if (time <= now_) return core::PlantStatus::Good;
  if (changed_) {
    // What was set and taken back at the same instant is no change.
    const double* values = equations_->values();
    bool differs = held_changed_;
    for (std::size_t i = 0; i < actuators_.size(); ++i)
      differs = differs || values[model_->actuator_at[i].slot] != actuators_[i];
    if (differs) {
      remember();
      failed_ = !restart(seconds(now_));
      event_pending_ = false;
    }
    changed_ = held_changed_ = false;
  }
  if (!failed_ && !give_inputs()) {
    failed_ = true;
    return core::PlantStatus::Failed;
  }
  failed_ = failed_ || !run_to(seconds(time));
  sampled_now_ = Sampled::Nothing;
  if (failed_) return give_up();
  now_ = time;
  return core::PlantStatus::Good;
}

core::PlantStatus ModelPlant::give_up() {
  unsolved_loop_ = equations_->unsolved();
  failed_component_ =
      endless_events_ || unseen_event_ != nullptr ? last_event_component_ : stiffest_component();
  trouble_known_.store(true, std::memory_order_release);
  return core::PlantStatus::Failed;
}

bool ModelPlant::failed() const {
  return trouble_known_.load(std::memory_order_acquire) || exchange_.failed();
}

std::string ModelPlant::trouble() {
  if (std::string lost = exchange_.trouble(); !lost.empty()) return lost;
  if (!trouble_known_.load(std::memory_order_acquire)) return {};
  std::array<char, 32> at{};
  std::snprintf(at.data(), at.size(), "%.3f", seconds(now_));
  const std::string& name = model_->names[failed_component_];
  if (unseen_event_ != nullptr)
    return "the plant cannot go on at " + std::string(at.data()) + " s: event '" + *unseen_event_ + "' of '" +
           name +
           "' follows itself ever more quickly; its states need a rest, such as a derivative that is 0 there";
  if (endless_events_)
    return "the plant cannot go on at " + std::string(at.data()) + " s: an event of '" + name +
           "' happens again and again without time between";
  if (unsolved_loop_ != nullptr)
    return "the plant cannot go on at " + std::string(at.data()) + " s: where " + unsolved_loop_->names +
           " meet nothing was found that lets out as much as comes in";
  return std::string("the plant's solver gave up at ") + at.data() + " s: no step is small enough" +
         (name.empty() ? std::string() : "; '" + name + "' changes fastest") +
         (model_->text.solver.implicit
              ? ": a state with large values may need a tolerance of its own that is as large"
              : " ([solver] method = \"implicit\" is for stiff plants)");
}

void ModelPlant::sample(Sampled wanted) const {
  if (sampled_now_ >= wanted) return;
  for (std::size_t i = 0; i < actuators_.size(); ++i)
    sampled_[model_->actuator_at[i].slot] = equations_->values()[model_->actuator_at[i].slot];
  const Frame at{
      .t_s = seconds(now_), .time_ns = now_.count(), .sampling = true, .y = y_.data(), .v = sampled_.data()};
  wanted == Sampled::All ? equations_->evaluate(at) : equations_->evaluate_shown(at);
  sampled_now_ = wanted;
}

// All values at now_ as who reads them sees them.
Frame ModelPlant::sampled_frame() const {
  sample(Sampled::All);
  return {
      .t_s = seconds(now_), .time_ns = now_.count(), .sampling = true, .y = y_.data(), .v = sampled_.data()};
}

std::int16_t ModelPlant::sensor(core::SensorId id) const {
  assert(id.value < model_->sensors.size());
  sample(Sampled::Shown);
  const double value = sampled_[model_->sensor_at[id.value].slot];
  if (model_->sensors[id.value].kind == core::PortKind::Bool) return value >= 0.5 ? 1 : 0;
  return static_cast<std::int16_t>(std::floor(std::clamp(value, -32768.0, 32767.0) + 0.5));
}

double ModelPlant::truth(core::TruthId id) const {
  const ModelTruth& truth = model_->truth_at[id.value];
  if (truth.slot == kAllLiquid) return all_liquid() / truth.factor;
  sample(Sampled::All);
  return (sampled_[truth.slot] - truth.offset) / truth.factor;
}

// m3
double ModelPlant::all_liquid() const {
  double sum = 0.0;
  for (const std::uint32_t c : model_->with_states) {
    const Component& component = *model_->components[c];
    for (std::size_t s = 0; s < component.state_count(); ++s)
      sum += component.liquid(s) * y_[model_->first_state[c] + s];
  }
  return sum;
}

// By how much a state's own component changes its derivatives with it, in 1/s of their tolerances: a filter
// that is far too quick stands still as well.
std::uint32_t ModelPlant::stiffest_component() {
  Frame at = frame(seconds(now_));
  const auto derivatives = [&](std::vector<double>& to) {
    at.dydt = to.data();
    equations_->evaluate(at);
    equations_->derivatives(at);
  };
  derivatives(before_);
  std::uint32_t found = 0;
  double most = 0.0;
  for (const std::uint32_t c : model_->with_states) {
    const Component& component = *model_->components[c];
    const std::size_t first = model_->first_state[c];
    for (std::size_t s = 0; s < component.state_count(); ++s) {
      const double was = y_[first + s];
      const double step = std::max(component.tolerance(s), 1e-6 * std::abs(was));
      y_[first + s] = was + step;
      derivatives(after_);
      y_[first + s] = was;
      for (std::size_t of = 0; of < component.state_count(); ++of) {
        const double rate = std::abs(after_[first + of] - before_[first + of]) / step *
                            component.tolerance(s) / component.tolerance(of);
        if (!std::isfinite(rate)) return c;
        if (rate <= most) continue;
        most = rate;
        found = c;
      }
    }
  }
  return found;
}

void ModelPlant::keep(std::span<double> numbers) const {
  std::copy(y_.begin(), y_.end(), numbers.begin());
  numbers.back() = mark_;
}

}  // namespace stepwright::components
