#include "plant_models/components/starts.h"

#include <algorithm>
#include <cmath>

#include "plant_models/components/model_equations.h"
#include "plant_models/components/start_order.h"

namespace stepwright::components {
namespace {

constexpr int kRounds = 16;  // modes that remember what they saw first
constexpr double kNear = 1e-6;

bool differs(double a, double b, double tolerance) {
  if (!std::isfinite(a) || !std::isfinite(b)) return std::isfinite(a) != std::isfinite(b);
  return std::abs(a - b) > tolerance + kNear * std::max(std::abs(a), std::abs(b));
}

// As assemble() made them, without the modes that they have come into since.
void renew_components(Model& model) {
  for (std::size_t c = 0; c < model.components.size(); ++c) {
    Component& old = *model.components[c];
    if (old.process() != nullptr) continue;
    std::unique_ptr<Component> made = model.types[c]->make(model.text.components[c].parameters);
    made->bind(old.ports(), model.first_state[c], old.fault_values());
    model.components[c] = std::move(made);
  }
}

class Starts {
 public:
  Starts(Model& model, std::vector<StartOfState> starts, std::size_t depth, ModelEquations& equations)
      : model_(model), starts_(std::move(starts)), depth_(depth), equations_(equations), y_(model.start()) {}

  // Modes hide from the order which start follows which, so that a round may have changed what the first ones
  // saw. False: it goes on like that.
  bool settle() {
    for (int round = 0; round < kRounds; ++round) {
      const bool settled = !follow_all();
      renew_components(model_);
      for (const StartOfState& start : starts_)
        model_.components[start.component]->set_start(start.follows.state, y_[place_of(start)]);
      if (settled) return true;
    }
    return false;
  }
  const StartOfState* without_value() const {
    const auto found = std::find_if(starts_.begin(), starts_.end(), [&](const StartOfState& start) {
      return !std::isfinite(y_[place_of(start)]);
    });
    return found == starts_.end() ? nullptr : &*found;
  }
  const StartOfState& first() const { return starts_.front(); }

 private:
  std::size_t place_of(const StartOfState& start) const {
    return model_.first_state[start.component] + start.follows.state;
  }
  // True if a start has changed.
  bool follow_all() {
    bool any = false;
    for (std::size_t i = 0; i <= depth_; ++i) {
      const Frame at{.y = y_.data(), .v = equations_.values()};
      equations_.settle(at);
      if (!follow(at)) break;
      any = true;
    }
    return any;
  }
  bool follow(const Frame& at) {
    std::vector<double> next = y_;
    bool changed = false;
    for (const StartOfState& start : starts_) {
      const Component& component = *model_.components[start.component];
      double& value = next[place_of(start)];
      const double before = value;
      value = component.start_from(start.follows.state, at);
      changed = changed || differs(before, value, component.tolerance(start.follows.state));
    }
    y_ = std::move(next);
    return changed;
  }

  Model& model_;
  std::vector<StartOfState> starts_;
  std::size_t depth_;
  ModelEquations& equations_;
  std::vector<double> y_;
};

result::Location place_of(const StartOfState& start, const Model& model) {
  return start.follows.where.line > 0 ? start.follows.where : model.text.components[start.component].place;
}

}  // namespace

result::Result<void> work_out_starts(Model& model) {
  std::vector<StartOfState> following = following_starts_of(model);
  if (following.empty()) return {};
  auto depth = depth_of(following, model);
  if (!depth) return result::forward(depth);
  auto equations = ModelEquations::create(model);
  if (!equations) return result::forward(equations);
  Starts starts(model, std::move(following), *depth, **equations);
  const bool settled = starts.settle();
  if (const StartOfState* const none = starts.without_value(); none != nullptr)
    return result::fail("C0349", place_of(*none, model),
                        "the start of '" + none->follows.name + "' of '" + model.names[none->component] +
                            "' is no finite number",
                        "it may divide by what is 0 at the start");
  if (!settled)
    return result::fail("C0346", place_of(starts.first(), model),
                        "the starts of the plant's states fit each other in no way",
                        "give the states in a circle of switches figures to start with");
  return {};
}

}  // namespace stepwright::components
