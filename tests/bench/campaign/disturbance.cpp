#include "tests/bench/campaign/disturbance.h"

#include <fmt/format.h>

#include <algorithm>

namespace stepwright::campaign {
namespace {

using Class = DisturbanceClass;

// The undisturbed job takes about 80 s.
constexpr double kLatest_s = 75.0;

class Dice {
 public:
  explicit Dice(std::uint64_t seed) : state_(seed * 0x9E37'79B9'7F4A'7C15ULL + 0x632B'E59B'D9B4'E019ULL) {}

  double real(double low, double high) {
    return low + (high - low) * static_cast<double>(next() >> 11) * 0x1p-53;
  }
  int pick(int count) { return static_cast<int>(next() % static_cast<std::uint64_t>(count)); }
  bool chance(double probability) { return real(0.0, 1.0) < probability; }

 private:
  // SplitMix64 (Steele, Lea, Flood 2014).
  std::uint64_t next() {
    state_ += 0x9E37'79B9'7F4A'7C15ULL;
    std::uint64_t mixed = state_;
    mixed = (mixed ^ (mixed >> 30)) * 0xBF58'476D'1CE4'E5B9ULL;
    mixed = (mixed ^ (mixed >> 27)) * 0x94D0'49BB'1331'11EBULL;
    return mixed ^ (mixed >> 31);
  }

  std::uint64_t state_;
};

class Draw {
 public:
  explicit Draw(std::uint64_t seed) : dice_(seed) { result_.seed = seed; }

  Disturbance run() {
    result_.of = static_cast<Class>(result_.seed % kClasses);
    if (result_.of == Class::Several) {
      const int count = 2 + dice_.pick(2);
      for (int i = 0; i < count; ++i) add(static_cast<Class>(1 + dice_.pick(static_cast<int>(kClasses) - 2)));
    } else {
      add(result_.of);
    }
    const auto earlier = [](const auto& a, const auto& b) { return a.at_s < b.at_s; };
    std::stable_sort(result_.faults.begin(), result_.faults.end(), earlier);
    std::stable_sort(result_.changes.begin(), result_.changes.end(), earlier);
    return std::move(result_);
  }

 private:
  void add(Class disturbance) {
    switch (disturbance) {
      case Class::Leak:
        return fault(std::string("leak_") + one_of({"v1", "a1", "a2"}), dice_.real(0.1, 3.0), 0.7);
      case Class::WeakPump:
        return fault("weak_b" + std::to_string(1 + dice_.pick(4)),
                     dice_.chance(0.4) ? 0.0 : dice_.real(0.0, 0.9), 0.5);
      case Class::StuckSwitch:
        return fault("stuck_fc" + std::to_string(1 + dice_.pick(3)), dice_.pick(2), 0.6);
      case Class::Drift:
        return fault("drift_s" + std::to_string(1 + dice_.pick(3)),
                     dice_.real(0.5, 40.0) * (dice_.chance(0.5) ? 1.0 : -1.0), 0.3);
      case Class::FrozenSensor:
        return fault("frozen_s" + std::to_string(1 + dice_.pick(3)), 1.0, 0.4);
      case Class::Draw:
        return fault("draw_c" + std::to_string(1 + dice_.pick(2)), dice_.real(1.0, 30.0), 0.0);
      case Class::Demand:
        return demand();
      case Class::NewGoal:
        return goal();
      case Class::LostRuntime:
        result_.kill_at_s = dice_.real(2.0, kLatest_s);
        return tell(fmt::format("runtime killed at {:.2f} s", *result_.kill_at_s));
      case Class::None:
      case Class::Several:
        return;
    }
  }

  const char* one_of(std::initializer_list<const char*> names) {
    return names.begin()[dice_.pick(static_cast<int>(names.size()))];
  }

  void tell(const std::string& part) { result_.story += (result_.story.empty() ? "" : ", ") + part; }

  // With `passing` as the probability that it ends again.
  void fault(const std::string& name, double value, double passing) {
    const double at_s = dice_.real(0.0, kLatest_s);
    result_.faults.push_back({at_s, name, value});
    tell(fmt::format("{} = {:.3g} at {:.2f} s", name, value, at_s));
    if (!dice_.chance(passing)) return;
    const double end_s = at_s + dice_.real(0.05, 20.0);
    result_.faults.push_back({end_s, name, 0.0, true});
    tell(fmt::format("until {:.2f} s", end_s));
  }

  void demand() {
    const int client = 1 + dice_.pick(2);
    const double value = 1 + dice_.pick(10);
    const double at_s = dice_.real(0.0, kLatest_s);
    result_.changes.push_back({at_s, "(demand c" + std::to_string(client) + ")", value});
    tell(fmt::format("demand of c{} = {} at {:.2f} s", client, value, at_s));
  }

  void goal() {
    const double at_s = dice_.real(0.0, kLatest_s);
    executive::GoalChange change;
    change.at_s = at_s;
    change.goal = fmt::format("(and (is-at v1 {}) (= (level a1) {}) (= (level a2) {}))",
                              one_of({"f1", "a1", "a2"}), 2 + dice_.pick(7), 2 + dice_.pick(7));
    tell(fmt::format("goal {} at {:.2f} s", change.goal, at_s));
    result_.changes.push_back(std::move(change));
  }

  Dice dice_;
  Disturbance result_;
};

bool names(const std::vector<support::PlantFault>& faults, std::initializer_list<const char*> kinds) {
  return std::any_of(faults.begin(), faults.end(), [&](const support::PlantFault& fault) {
    return std::any_of(kinds.begin(), kinds.end(),
                       [&](const char* kind) { return fault.name.rfind(kind, 0) == 0; });
  });
}

}  // namespace

const char* to_string(DisturbanceClass disturbance) {
  static constexpr std::array<const char*, kClasses> kNames = {
      "none", "leak",   "weak_pump", "stuck_switch", "drift",  "frozen_sensor",
      "draw", "demand", "new_goal",  "lost_runtime", "several"};
  return kNames[static_cast<std::size_t>(disturbance)];
}

bool Disturbance::lies() const {
  return names(faults, {"drift_", "frozen_", "stuck_"});
}

bool Disturbance::drifts() const {
  return names(faults, {"drift_"});
}

bool Disturbance::breaks() const {
  return lies() || names(faults, {"leak_", "weak_", "draw_"});
}

Disturbance disturbance_of(std::uint64_t seed) {
  return Draw(seed).run();
}

}  // namespace stepwright::campaign
