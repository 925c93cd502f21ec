#include "plant_models/components/own_component.h"

#include <algorithm>
#include <cmath>

namespace stepwright::components {
namespace {

// Requires an expression that was read before.
Expression sure(const std::string& text, const std::vector<Variable>& variables) {
  auto made = Expression::create(text, variables, {});
  if (!made) made = Expression::create("0", variables, {});
  return std::move(*made);
}

class OwnComponent final : public Component {
 public:
  OwnComponent(std::shared_ptr<const OwnEquations> equations, const Parameters& p)
      : equations_(std::move(equations)), room_k_(p.room_k) {
    const OwnEquations& e = *equations_;
    const std::vector<Variable> variables = variables_of(e, values_);
    for (std::size_t i = 0; i < e.parameters.size(); ++i) values_[i] = p[e.parameters[i].first];
    first_fault_ = e.parameters.size();
    first_read_ = first_fault_ + e.faults.size();
    first_state_ = first_read_ + e.reads.size();
    for (const OwnState& state : e.states) {
      starts_.push_back(sure(state.start, variables));
      add_state({.start = follows(starts_.back()) ? 0.0 : starts_.back().value(),
                 .tolerance = state.tolerance,
                 .liquid = state.liquid ? 1.0 : 0.0});
      derivatives_.push_back(sure(state.derivative, variables));
    }
    for (const OwnOutput& output : e.outputs) outputs_.push_back(sure(output.text, variables));
    for (const OwnEvent& event : e.events) {
      events_.push_back(sure(event.when, variables));
      sets_.emplace_back();
      for (const auto& [state, text] : event.set) sets_.back().push_back({state, sure(text, variables)});
    }
    set_roots(events_.size(), true);
    happened_.resize(events_.size());
    before_.resize(events_.size());
    reverses_.resize(events_.size());
  }

  void evaluate(std::uint32_t stage, const Frame& f) const override {
    load(f);
    for (std::size_t i = 0; i < outputs_.size(); ++i) {
      const OwnOutput& output = equations_->outputs[i];
      if (output.stage != stage) continue;
      const double value = outputs_[i].value();
      const std::size_t port = output.place.port;
      if (!output.place.fluid) {
        across(f, port) = output.is_switch ? (value > 0.5 ? 1.0 : 0.0) : value;
      } else if (output.place.through) {
        // What flows into the port leaves the node that it is joined to.
        const double flow = value >= 0.0 ? value * across(f, port, kAvailable) : value;
        const double temperature = value >= 0.0 ? across(f, port, kTemperature) : room_k_;
        through(f, port, kFlow) = -flow;
        through(f, port, kHeatFlow) = -flow * temperature;
      } else {
        across(f, port, kPressure) = value;
        across(f, port, kAvailable) = 1.0;
        across(f, port, kTemperature) = room_k_;
      }
    }
  }
  void derivative(const Frame& f) const override {
    load(f);
    for (std::size_t i = 0; i < derivatives_.size(); ++i) dydt(f, i) = derivatives_[i].value();
  }
  void roots(const Frame& f, double* g) const override {
    load(f);
    for (std::size_t i = 0; i < events_.size(); ++i) g[i] = events_[i].value();
  }
  Event handle(const Frame& f, const int* signs, double* all) override {
    load(f);
    Event most = Event::None;
    reverses_.assign(events_.size(), 0.0);
    for (std::size_t i = 0; i < events_.size(); ++i) {
      if (signs[i] == 0) continue;
      before_[i] = 0.0;
      if (happens(i, signs[i], all)) most = Event::Restart;
    }
    return most;
  }

  bool follows_jumps() const override { return !events_.empty(); }
  void remember(const Frame& f) override { roots(f, before_.data()); }
  Event handle_jumps(const Frame& f, double* all) override {
    load(f);
    Event most = Event::None;
    for (std::size_t i = 0; i < events_.size(); ++i) {
      const double now = events_[i].value();
      const int sign = before_[i] < 0.0 && now >= 0.0 ? 1 : before_[i] > 0.0 && now <= 0.0 ? -1 : 0;
      before_[i] = now;
      if (sign == 0) continue;
      reverses_[i] = 0.0;
      if (!happens(i, sign, all)) continue;
      before_[i] = 0.0;  // where its own states jump to is no passing
      most = Event::Restart;
    }
    return most;
  }

  std::vector<FollowingStart> following_starts() const override {
    std::vector<FollowingStart> following;
    for (std::size_t i = 0; i < starts_.size(); ++i) {
      const OwnState& state = equations_->states[i];
      if (follows(starts_[i])) following.push_back({i, state.name, reads_of(starts_[i]), state.start_where});
    }
    return following;
  }
  double start_from(std::size_t state, const Frame& f) const override {
    load(f);
    return starts_[state].value();
  }
  std::optional<StartReads> output_reads(std::size_t port) const override {
    StartReads reads;
    for (std::size_t i = 0; i < outputs_.size(); ++i) {
      const OwnPlace& place = equations_->outputs[i].place;
      if (place.port != port) continue;
      reads = reads_of(outputs_[i]);
      if (place.through) reads.ports.push_back(port);  // the temperature of what flows
    }
    return reads;
  }

  // A ball that bounces: what has fallen through zero rises again, or the other way round.
  void event_done(const Frame& f) override {
    load(f);
    for (std::size_t i = 0; i < happened_.size(); ++i) {
      if (!happened_[i] || equations_->events[i].rising == equations_->events[i].falling) continue;
      reverses_[i] = 0.0;
      const double now = away(i);
      for (std::size_t s = 0; s < derivatives_.size(); ++s) values_[first_state_ + s] += kSoon_s * dydt(f, s);
      // Only if it is at zero: states may have jumped far beyond.
      if (const double soon = away(i); soon > 0.0) reverses_[i] = std::max(0.0, soon - now);
      load(f);
    }
    happened_.assign(happened_.size(), false);
  }
  const std::string* passed_unseen(const Frame& f) const override {
    load(f);
    for (std::size_t i = 0; i < reverses_.size(); ++i)
      if (reverses_[i] > 0.0 && away(i) < -reverses_[i]) return &equations_->events[i].name;
    return nullptr;
  }

 private:
  static constexpr double kSoon_s = 1e-6;

  // Whether it reads more than parameters.
  bool follows(const Expression& expression) const {
    const auto& parameters = equations_->parameters;
    const std::vector<std::string> names = expression.reads();
    return std::any_of(names.begin(), names.end(), [&](const std::string& name) {
      return std::none_of(parameters.begin(), parameters.end(),
                          [&](const auto& parameter) { return parameter.first == name; });
    });
  }
  StartReads reads_of(const Expression& expression) const {
    StartReads reads;
    for (const std::string& name : expression.reads()) {
      for (std::size_t i = 0; i < equations_->states.size(); ++i)
        if (equations_->states[i].name == name) reads.states.push_back(i);
      for (const OwnRead& read : equations_->reads)
        if (read.name == name) reads.ports.push_back(read.place.port);
    }
    return reads;
  }

  // Sets the states of an event whose condition has passed zero, if that is its direction.
  bool happens(std::size_t i, int sign, double* all) {
    const OwnEvent& event = equations_->events[i];
    if (!((sign > 0 && event.rising) || (sign < 0 && event.falling))) return false;
    for (const auto& [state, value] : sets_[i]) state_of(all, state) = value.value();
    happened_[i] = true;
    return true;
  }
  // How far the condition of an event is from zero, on the side that it comes from.
  double away(std::size_t event) const {
    return equations_->events[event].falling ? events_[event].value() : -events_[event].value();
  }
  void load(const Frame& f) const {
    const OwnEquations& e = *equations_;
    for (std::size_t i = 0; i < e.faults.size(); ++i) values_[first_fault_ + i] = fault(i);
    for (std::size_t i = 0; i < e.reads.size(); ++i) {
      const OwnPlace& place = e.reads[i].place;
      values_[first_read_ + i] = place.through ? through(f, place.port) : across(f, place.port);
    }
    for (std::size_t i = 0; i < e.states.size(); ++i) values_[first_state_ + i] = y(f, i);
    values_.back() = f.t_s;
  }

  std::shared_ptr<const OwnEquations> equations_;  // shared by all components of the type
  double room_k_;
  mutable std::vector<double> values_;  // of the variables, in the order of variables_of()
  std::size_t first_fault_ = 0, first_read_ = 0, first_state_ = 0;
  std::vector<Expression> starts_, derivatives_, outputs_, events_;
  std::vector<std::vector<std::pair<std::size_t, Expression>>> sets_;
  std::vector<bool> happened_;    // at the instant that is handled
  std::vector<double> before_;    // conditions before what jumps; 0: at zero, from where nothing passes it
  std::vector<double> reverses_;  // how far away each event's condition is kSoon_s behind it; 0: it goes on
};

}  // namespace

std::vector<Variable> variables_of(const OwnEquations& e, std::vector<double>& values) {
  values.assign(e.parameters.size() + e.faults.size() + e.reads.size() + e.states.size() + 1, 1.0);
  std::vector<Variable> variables;
  const auto add = [&](const std::string& name, const Dimension& dimension) {
    variables.push_back({name, dimension, &values[variables.size()]});
  };
  for (const auto& [name, dimension] : e.parameters) add(name, dimension);
  for (const auto& [name, dimension] : e.faults) add(name, dimension);
  for (const OwnRead& read : e.reads) add(read.name, read.dimension);
  for (const OwnState& state : e.states) add(state.name, state.dimension);
  add("t", Dimension{{0, 0, 1, 0, 0}});
  return variables;
}

std::unique_ptr<Component> make_own(std::shared_ptr<const OwnEquations> equations,
                                    const Parameters& parameters) {
  return std::make_unique<OwnComponent>(std::move(equations), parameters);
}

}  // namespace stepwright::components
