#include "tests/bench/shift/plant_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <deque>
#include <limits>
#include <numbers>
#include <optional>

#include "tests/bench/shift/dispatcher.h"
#include "tests/bench/shift/driver.h"
#include "tests/bench/shift/plant.h"
#include "tests/support/fleet_traffic/traffic_invariants.h"

namespace stepwright::bench::shift {

namespace {

using std::chrono::milliseconds;

constexpr milliseconds kTick{100};
constexpr double kTick_s = 0.1;
constexpr int kSilent = 10;       // ticks without an answer: it is dead
constexpr double kClear_m = 6.0;  // nobody is nearer when a place is blocked
constexpr double kStands_m_s = 0.03;

class Shift {
 public:
  Shift(const Scenario& scenario, Fleet& fleet, fleet::Traffic traffic, Plant plant)
      : scenario_(scenario),
        fleet_(fleet),
        traffic_(std::move(traffic)),
        plant_(std::move(plant)),
        events_(traffic_, fleet.planner()),
        dispatcher_(scenario, traffic_, fleet.planner(), rule_, run_.figures),
        judge_(scenario, fleet.settings().vehicle.footprint()),
        closings_(scenario.closings.begin(), scenario.closings.end()) {
    const std::uint32_t n = scenario.settings.vehicles;
    run_.figures.spent.resize(n);
    run_.tracks.resize(n);
    paused_until_s_.assign(n, 0.0);
    waits_since_s_.assign(n, 0.0);
    told_wait_.assign(n, 0);
    stands_dead_.assign(n, 0);
    silent_.assign(n, 0);
    comes_back_s_.assign(n, 1e18);
    measured_.resize(n);
    last_answer_.resize(n);
    doing_.resize(n);
    poses_.resize(n);
    for (std::uint32_t v = 0; v < n; ++v) {
      drivers_.push_back(std::make_unique<Driver>(traffic_.route(v), limits_of_the_plant(),
                                                  fleet.settings().vehicle.footprint()));
    }
  }

  PlantRun run(bool progress, double until_s) {
    end_s_ = std::min(until_s, scenario_.end_s());
    const double begin_s = cpu_s();
    const auto ticks = static_cast<std::int64_t>(std::llround(end_s_ / kTick_s));
    for (std::int64_t k = 0; k < ticks && run_.failed.empty(); ++k) {
      now_ = k * kTick;
      now_s_ = kTick_s * static_cast<double>(k);
      happen();
      control();
      operate(k);
      move();
      if (k % 10 == 0) judge_.standing(now_s_, poses_, doing_);
      if (k % 10 == 0) note_waits();
      if (k % 100 == 0) check_invariants();
      if (k % 50 == 0) {
        for (std::uint32_t v = 0; v < drivers_.size(); ++v) run_.tracks[v].push_back(poses_[v]);
      }
      if (progress && k % 6000 == 0)
        std::fprintf(stderr, "\r%5.0f of %.0f s, %zu collisions ", now_s_, end_s_,
                     judge_.collisions().size());
    }
    if (progress) std::fprintf(stderr, "\n");
    finish(cpu_s() - begin_s);
    return std::move(run_);
  }

 private:
  // Each one once, however long it lasts.
  void check_invariants() {
    std::string wrong = support::broken_invariant(traffic_);
    if (!wrong.empty() && wrong != last_broken_)
      run_.broken.push_back(fmt::format("at {} s: {}", now_s_, wrong));
    last_broken_ = std::move(wrong);
  }

  void note(std::string text) { run_.log.push_back(fmt::format("{:8.1f} s  {}", now_s_, text)); }

  template <typename Change>
  auto timed(const char* cause, Change&& change) {
    const double begin_s = cpu_s();
    auto made = change();
    run_.figures.decisions.times[cause].ms.push_back(1e3 * (cpu_s() - begin_s));
    return made;
  }

  void happen() {
    while (next_transport_ < scenario_.transports.size() &&
           scenario_.transports[next_transport_].release_s <= now_s_)
      dispatcher_.release(static_cast<std::uint32_t>(next_transport_++));
    for (; next_pause_ < scenario_.pauses.size() && scenario_.pauses[next_pause_].begin_s <= now_s_;
         ++next_pause_) {
      const Pause& pause = scenario_.pauses[next_pause_];
      paused_until_s_[pause.vehicle] = now_s_ + pause.seconds;
    }
    for (; next_breakdown_ < scenario_.breakdowns.size() &&
           scenario_.breakdowns[next_breakdown_].begin_s <= now_s_;
         ++next_breakdown_) {
      const Breakdown& breakdown = scenario_.breakdowns[next_breakdown_];
      plant_.set_dead(breakdown.vehicle, true);
      comes_back_s_[breakdown.vehicle] = breakdown.for_good ? 1e18 : now_s_ + breakdown.seconds;
      note(fmt::format("v{} stops answering", breakdown.vehicle + 1));
    }
    close_and_open();
  }

  bool clear(const Rectangle& place) const {
    return std::ranges::none_of(poses_, [&](const geometry::Pose& pose) {
      const double dx = std::max({place.low.x_m - pose.x_m, 0.0, pose.x_m - place.high.x_m});
      const double dy = std::max({place.low.y_m - pose.y_m, 0.0, pose.y_m - place.high.y_m});
      return std::hypot(dx, dy) < kClear_m;
    });
  }

  // Nothing falls in front of a vehicle that could not stop any more: a place is blocked when nobody is near.
  void close_and_open() {
    for (auto closing = closings_.begin(); closing != closings_.end() && closing->begin_s <= now_s_;) {
      const Rectangle& place = scenario_.places[closing->place];
      if (!clear(place)) {
        ++closing;
        continue;
      }
      plant_.set_blocked(closing->place, true);
      judge_.block(closing->place, true);
      const auto blockage = timed("blocked", [&] { return events_.block(place.polygon(), now_); });
      closed_.push_back({closing->place, blockage.number, now_s_ + closing->seconds});
      run_.stood.push_back({place.polygon(), now_s_, now_s_ + closing->seconds});
      tell(fmt::format("place {} is blocked", closing->place), blockage.detours);
      closing = closings_.erase(closing);
    }
    for (auto closed = closed_.begin(); closed != closed_.end();) {
      if (closed->until_s > now_s_) {
        ++closed;
        continue;
      }
      plant_.set_blocked(closed->place, false);
      judge_.block(closed->place, false);
      const auto detours = timed("free again", [&] { return events_.unblock(closed->number); });
      tell(fmt::format("place {} is free again", closed->place), detours);
      closed = closed_.erase(closed);
    }
  }

  void tell(const std::string& what, const std::vector<fleet::Detour>& detours) {
    std::string text = what;
    for (const fleet::Detour& detour : detours) {
      static constexpr std::array<const char*, 4> kKinds = {"takes another way", "goes home", "waits",
                                                            "drives on"};
      text += fmt::format("; v{} {}", detour.vehicle + 1, kKinds[static_cast<std::size_t>(detour.kind)]);
      if (!detour.why.empty())
        text += fmt::format(" ({} {})", detour.why.front().code, detour.why.front().message);
    }
    note(text);
    dispatcher_.take(detours);
    renew();
  }

  void renew() {
    for (const std::uint32_t v : dispatcher_.take_rerouted())
      if (!traffic_.removed(v)) drivers_[v]->renew();
  }

  void control() {
    const double begin_s = cpu_s();
    for (std::uint32_t v = 0; v < drivers_.size(); ++v) {
      Driver& driver = *drivers_[v];
      measured_[v] = plant_.measured(v);
      const bool answers = measured_[v].x_m != 0.0 || measured_[v].y_m != 0.0;
      silent_[v] = answers ? 0 : silent_[v] + 1;
      if (answers) last_answer_[v] = {measured_[v].x_m, measured_[v].y_m, measured_[v].heading_rad};
      if (traffic_.removed(v) || !answers) {
        plant_.command(v, {0.0, 0.0}, false);
        continue;
      }
      const bool paused = paused_until_s_[v] > now_s_;
      const Driver::Drive drive = driver.step(measured_[v], traffic_.permission(v, now_), now_s_, paused);
      plant_.command(v, drive.command, drive.enable && !plant_.bumper(v));
      run_.largest_deviation_m = std::max(run_.largest_deviation_m, driver.deviation_m());
      if (driver.lost()) lose(v);
    }
    run_.figures.control_cpu_s += cpu_s() - begin_s;
  }

  void lose(std::uint32_t vehicle) {
    ++run_.lost;
    note(fmt::format("v{} is lost, {:.2f} m beside its path", vehicle + 1, drivers_[vehicle]->deviation_m()));
    silent_[vehicle] = kSilent;
    comes_back_s_[vehicle] = now_s_ + 60.0;
    bury(vehicle);
  }

  void bury(std::uint32_t vehicle) {
    const auto detours = timed("died", [&] { return events_.died(vehicle, last_answer_[vehicle], now_); });
    dispatcher_.died(vehicle);
    const geometry::Pose& at = last_answer_[vehicle];
    // Its true outline, where it truly stands.
    stands_dead_[vehicle] = run_.stood.size();
    run_.stood.push_back({geometry::footprint_at(plant_.pose(vehicle), fleet_.settings().vehicle.footprint()),
                          now_s_, std::numeric_limits<double>::infinity(), vehicle,
                          plant_.pose(vehicle).position()});
    tell(fmt::format("v{} is dead at {:.1f}, {:.1f} m, {:.0f} degrees", vehicle + 1, at.x_m, at.y_m,
                     at.heading_rad * 180.0 / std::numbers::pi),
         detours);
  }

  void operate(std::int64_t tick) {
    for (std::uint32_t v = 0; v < drivers_.size(); ++v) {
      if (traffic_.removed(v)) {
        if (comes_back_s_[v] <= now_s_ && tick % 50 == 0) resurrect(v);
        continue;
      }
      if (silent_[v] == kSilent) bury(v);
      if (silent_[v] > 0) continue;
      Driver& driver = *drivers_[v];
      if (driver.arrived_at() != nullptr) driver.stand_for(std::max(1.0, dispatcher_.service_s(v)), now_s_);
      if (driver.left_stop()) dispatcher_.stood(v, now_s_);
      const std::uint64_t delays = traffic_.delays();
      const double begin_s = cpu_s();
      traffic_.progress(v, driver.location(), now_);
      if (traffic_.delays() != delays) run_.figures.retimes.ms.push_back(1e3 * (cpu_s() - begin_s));
    }
    if (tick % 5 == 0) dispatcher_.dispatch(now_);
    if (tick % 100 == 0) {
      bool any_held = false;
      for (std::uint32_t v = 0; v < drivers_.size(); ++v)
        any_held = any_held || (traffic_.held(v) && !traffic_.removed(v));
      if (any_held) {
        const auto detours = timed("looked again", [&] { return events_.retry(now_); });
        if (!detours.empty()) tell("those who wait look for a way again", detours);
      }
    }
    renew();
  }

  void resurrect(std::uint32_t vehicle) {
    plant_.set_dead(vehicle, false);
    const geometry::Pose at = plant_.pose(vehicle);  // somebody has put its navigation right
    const geometry::Path& path = traffic_.route(vehicle).mission.path;
    double here_m = traffic_.arc_m(vehicle), nearest = 1e9;
    for (const geometry::PathPose& pose : path) {
      if (pose.arc_m < traffic_.arc_m(vehicle) - 1e-9 || pose.arc_m > traffic_.arc_m(vehicle) + 1.0) continue;
      const double off = geometry::distance(pose.pose.position(), at.position());
      if (off < nearest) {
        nearest = off;
        here_m = pose.arc_m;
      }
    }
    auto detours = timed(
        "came back", [&] { return events_.came_back(vehicle, here_m, !dispatcher_.busy(vehicle), now_); });
    if (!detours) {
      note(fmt::format("v{} cannot drive on yet: {}", vehicle + 1, detours.error().front().message));
      return;
    }
    silent_[vehicle] = 0;
    comes_back_s_[vehicle] = 1e18;
    run_.stood[stands_dead_[vehicle]].end_s = now_s_;
    drivers_[vehicle]->restart(traffic_.arc_m(vehicle));
    tell(fmt::format("v{} is back", vehicle + 1), *detours);
  }

  void move() {
    double judge_s = 0.0;
    const double begin_s = cpu_s();
    for (int k = 1; k <= 10; ++k) {
      if (!plant_.step(std::chrono::nanoseconds(now_) + k * assemblies::kFleetStep)) {
        run_.failed = fmt::format("the plant's solver gave up at {} s", now_s_);
        return;
      }
      const double judged_s = cpu_s();
      for (std::uint32_t v = 0; v < poses_.size(); ++v) poses_[v] = plant_.pose(v);
      judge_.step(now_s_ + 0.01 * k, poses_);
      judge_s += cpu_s() - judged_s;
    }
    run_.figures.judge_cpu_s += judge_s;
    run_.figures.plant_cpu_s += cpu_s() - begin_s - judge_s;
    for (std::uint32_t v = 0; v < drivers_.size(); ++v) account(v);
  }

  void account(std::uint32_t v) {
    const Driver& driver = *drivers_[v];
    Spent& spent = run_.figures.spent[v];
    const bool still = std::abs(measured_[v].speed_m_s) < kStands_m_s;
    VehicleState& state = doing_[v];
    state.waits_for.reset();
    if (dispatcher_.busy(v)) spent.busy_s += kTick_s;
    if (traffic_.removed(v) || silent_[v] > 0) {
      state.doing = Doing::Dead;
      spent.dead_s += kTick_s;
    } else if (driver.rests()) {
      state.doing = Doing::Rests;
      spent.resting_s += kTick_s;
    } else if (driver.stands()) {
      state.doing = Doing::Stands;
      spent.serving_s += kTick_s;
    } else if (paused_until_s_[v] > now_s_) {
      state.doing = Doing::Stands;
      spent.paused_s += kTick_s;
    } else if (traffic_.held(v) && still) {
      state.doing = Doing::Held;
      spent.held_s += kTick_s;
    } else if (driver.waits() && driver.waits_for_more_than(traffic_.permission(v, now_))) {
      state.doing = Doing::Waits;
      state.waits_for = traffic_.waits_for(v);
      spent.waiting_s += kTick_s;
    } else {
      state.doing = Doing::Drives;
      spent.driving_s += kTick_s;
    }
  }

  // Long waits, told once each when they are long: who waits for whom, and what the last one does.
  void note_waits() {
    constexpr double kLong_s = 60.0;
    static constexpr std::array<const char*, 6> kDoing = {"drives",  "rests",   "stands",
                                                          "is held", "is dead", "waits"};
    for (std::uint32_t v = 0; v < doing_.size(); ++v) {
      if (doing_[v].doing != Doing::Waits) {
        waits_since_s_[v] = now_s_;
        told_wait_[v] = 0;
      }
      if (told_wait_[v] != 0 || now_s_ - waits_since_s_[v] < kLong_s) continue;
      told_wait_[v] = 1;
      std::string chain = fmt::format("v{}", v + 1);
      std::uint32_t at = v;
      for (std::size_t k = 0; k < doing_.size() && doing_[at].waits_for; ++k) {
        at = *doing_[at].waits_for;
        chain += fmt::format(" -> v{}", at + 1);
      }
      note(fmt::format("waits for {:.0f} s: {} at {:.1f}, {:.1f} m, which {}", kLong_s, chain, poses_[at].x_m,
                       poses_[at].y_m, kDoing[static_cast<std::size_t>(doing_[at].doing)]));
    }
  }

  void finish(double cpu) {
    run_.figures.cpu_s = cpu;
    run_.figures.simulated_s = end_s_;
    run_.figures.delays = traffic_.delays();
    run_.collisions = judge_.collisions();
    run_.deadlocks = judge_.deadlocks();
    run_.smallest_gap_m = judge_.smallest_gap_m();
    run_.longest_wait_s = judge_.longest_wait_s();
    run_.outline_checks = judge_.checks();
    run_.contacts = static_cast<std::uint32_t>(plant_.contacts());
    for (const auto& driver : drivers_) run_.control_steps += driver->control_steps();
  }

  struct Closed {
    std::uint32_t place;
    std::uint32_t number;
    double until_s;
  };

  const Scenario& scenario_;
  Fleet& fleet_;
  fleet::Traffic traffic_;
  Plant plant_;
  fleet::FloorEvents events_;
  EarliestDueNearestVehicle rule_;
  PlantRun run_;
  Dispatcher dispatcher_;
  Judge judge_;
  std::vector<std::unique_ptr<Driver>> drivers_;
  std::deque<Closing> closings_;
  std::vector<Closed> closed_;
  std::vector<double> paused_until_s_, comes_back_s_, waits_since_s_;
  std::vector<char> told_wait_;
  std::vector<std::size_t> stands_dead_;  // by vehicle, into run_.stood
  std::vector<int> silent_;
  std::vector<fleet::VehicleState> measured_;
  std::vector<geometry::Pose> last_answer_, poses_;
  std::vector<VehicleState> doing_;
  std::size_t next_transport_ = 0, next_pause_ = 0, next_breakdown_ = 0;
  milliseconds now_{0};
  double now_s_ = 0.0, end_s_ = 0.0;
  std::string last_broken_;
};

}  // namespace

PlantRun run_on_plant(const Scenario& scenario, Fleet& fleet, bool progress, double until_s) {
  PlantRun none;
  auto plant = Plant::create(scenario);
  if (!plant) {
    none.failed = result::to_string(plant.error());
    return none;
  }
  auto traffic =
      fleet::Traffic::create(resting(fleet.planner(), scenario.settings.vehicles), {}, milliseconds(0));
  if (!traffic) {
    none.failed = result::to_string(traffic.error());
    return none;
  }
  return Shift(scenario, fleet, *std::move(traffic), *std::move(plant)).run(progress, until_s);
}

}  // namespace stepwright::bench::shift
