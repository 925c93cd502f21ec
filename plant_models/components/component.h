#pragma once

// A part of a described plant: its equations between its ports. A port is a place where components meet.
//
// Two roles, as in every network of across and through quantities (Karnopp, Margolis, Rosenberg, "System
// Dynamics"): a *node* sets what is across (the pressure of a tank) and takes the sum of what flows into it;
// a *branch* reads what is across at its ends and sets what flows (a pump, a pipe). Of signals an output is
// the node and an input the branch.
//
// Thread rule: one thread at a time. `evaluate`, `derivative` and `roots` are pure functions of the frame and
// of the modes, which only `settle`, `handle`, `handle_jumps` and `fault_changed` change; none of them
// allocates. SI units.

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "runtime/ground/result/result.h"

namespace stepwright::components {

enum class PortKind : std::uint8_t { Fluid, Heat, Rotation, Signal, Logic };
constexpr bool is_signal(PortKind kind) {
  return kind == PortKind::Signal || kind == PortKind::Logic;
}

enum class Role : std::uint8_t { Node, Branch };

// Places behind PortSlots::across.
inline constexpr std::uint32_t kPressure = 0;     // Pa above that of the room
inline constexpr std::uint32_t kAvailable = 1;    // share of a wanted flow that the node can give, 0..1
inline constexpr std::uint32_t kTemperature = 2;  // K, of what leaves it
inline constexpr std::uint32_t kFluidAcross = 3;
// Behind PortSlots::through; what flows into the node is positive.
inline constexpr std::uint32_t kFlow = 0;      // m3/s
inline constexpr std::uint32_t kHeatFlow = 1;  // K m3/s: flow times temperature of what flows
inline constexpr std::uint32_t kFluidThrough = 2;
// Heat: across K and, behind it, how much of a surface touches liquid, through W. Rotation: across rad/s,
// through N m. Signals: across only.
inline constexpr std::uint32_t kContact = 1;  // 0..1; what has no liquid gives and takes no heat
inline constexpr std::uint32_t kHeatAcross = 2;

constexpr std::uint32_t across_size(PortKind kind) {
  return kind == PortKind::Fluid ? kFluidAcross : kind == PortKind::Heat ? kHeatAcross : 1;
}
constexpr std::uint32_t through_size(PortKind kind) {
  return is_signal(kind) ? 0 : kind == PortKind::Fluid ? kFluidThrough : 1;
}

// Where the values of a port are in the vector of values.
struct PortSlots {
  std::uint32_t across = 0;
  std::uint32_t through = 0;
  bool connected = false;
};

struct Frame {
  double t_s = 0.0;
  std::int64_t time_ns = 0;   // of sampling
  bool sampling = false;      // a terminal or a report is read: noise is in it
  const double* y = nullptr;  // states
  double* v = nullptr;        // values of ports
  double* dydt = nullptr;
};

// What a start, or an output at the start, is worked out from beside parameters.
struct StartReads {
  std::vector<std::size_t> states{};  // of the component
  std::vector<std::size_t> ports{};
};

// A state whose start is no figure of the parameters.
struct FollowingStart {
  std::size_t state = 0;
  std::string name{};
  StartReads reads{};
  result::Location where{};  // of its expression; without a line: it has none
};

// What an event means for the solver.
enum class Event : std::uint8_t {
  None,     // nothing has changed
  Changed,  // modes have: it goes on from here if the derivative jumps
  Restart,  // a kink, or the state has jumped
};

class ProcessPart;

class Component {
 public:
  virtual ~Component() = default;

  // The same, if it is a process of its own.
  virtual ProcessPart* process() { return nullptr; }

  // Writes the values that its type puts into `stage`, from states and from the inputs read by that stage.
  virtual void evaluate(std::uint32_t stage, const Frame& frame) const {
    (void)stage;
    (void)frame;
  }
  // Writes the derivatives of its states.
  virtual void derivative(const Frame& frame) const { (void)frame; }
  // Writes root_count() functions, one of which changes its sign where something happens. Of a component that
  // has not said set_roots(count, true) they depend on states and time alone.
  virtual void roots(const Frame& frame, double* g) const {
    (void)frame;
    (void)g;
  }
  // At a root: `signs` as ode::CvodeSolver::roots(), of this component; it may change its states in `y`.
  virtual Event handle(const Frame& frame, const int* signs, double* y) {
    (void)frame;
    (void)signs;
    (void)y;
    return Event::None;
  }
  // Whether its root functions are conditions of events that happen also where they jump through zero, which
  // no solver sees. Other components look at what has jumped in settle().
  virtual bool follows_jumps() const { return false; }
  // Something is about to jump; the frame is as it was before.
  virtual void remember(const Frame& frame) { (void)frame; }
  // Behind a jump: has the events happen whose conditions have passed zero since remember(), or since the
  // last call. It may change its states in `y`.
  virtual Event handle_jumps(const Frame& frame, double* y) {
    (void)frame;
    (void)y;
    return Event::None;
  }
  // Behind an event that has changed states, which the frame has with their derivatives: what must not be
  // passed again without being seen.
  virtual void event_done(const Frame& frame) { (void)frame; }
  // The name of an event that has been passed without being seen since event_done(): it follows itself faster
  // than the solver steps. Null if there is none.
  virtual const std::string* passed_unseen(const Frame& frame) const {
    (void)frame;
    return nullptr;
  }
  // Modes that follow from inputs and states, after a terminal, a fault or a mode has changed; at the start
  // too. True if a value of the component follows from a mode that has changed.
  virtual bool settle(const Frame& frame) {
    (void)frame;
    return false;
  }
  // The fault is about to have another value; NaN = it does not hold. The frame is as it was before.
  virtual void fault_changed(std::size_t fault, double value, const Frame& frame) {
    (void)fault;
    (void)value;
    (void)frame;
  }

  // The states whose start follows from inputs, other states, faults or the time (starts.h).
  virtual std::vector<FollowingStart> following_starts() const { return {}; }
  // Such a start, from what is at the ports and from the other states' starts.
  virtual double start_from(std::size_t state, const Frame& frame) const {
    (void)frame;
    return start(state);
  }
  // What the output at a port is worked out from; nothing: all states, and what its stage reads.
  virtual std::optional<StartReads> output_reads(std::size_t port) const {
    (void)port;
    return std::nullopt;
  }

  std::size_t root_count() const { return roots_; }
  // False: roots() looks at states and time alone.
  bool roots_read_values() const { return roots_read_values_; }
  std::size_t state_count() const { return start_.size(); }
  double start(std::size_t state) const { return start_[state]; }
  void set_start(std::size_t state, double value) { start_[state] = value; }
  double tolerance(std::size_t state) const { return tolerance_[state]; }
  // m3 of liquid in state `state` per unit of it, and J/(rho c) likewise: what must stay constant over a
  // plant.
  double liquid(std::size_t state) const { return liquid_[state]; }
  double heat(std::size_t state) const { return heat_[state]; }

  const std::vector<PortSlots>& ports() const { return ports_; }
  void bind(std::vector<PortSlots> ports, std::size_t first_state, std::vector<double> faults) {
    ports_ = std::move(ports);
    state_ = first_state;
    faults_ = std::move(faults);
  }
  void set_fault(std::size_t fault, double value) { faults_[fault] = value; }
  double fault_value(std::size_t fault) const { return faults_[fault]; }
  const std::vector<double>& fault_values() const { return faults_; }

 protected:
  struct State {
    double start = 0.0;
    double tolerance = 1e-6;
    double liquid = 0.0;
    double heat = 0.0;
  };
  void add_state(const State& state) {
    start_.push_back(state.start);
    tolerance_.push_back(state.tolerance);
    liquid_.push_back(state.liquid);
    heat_.push_back(state.heat);
  }
  void set_roots(std::size_t count, bool read_values = false) {
    roots_ = count;
    roots_read_values_ = read_values;
  }

  double y(const Frame& frame, std::size_t state) const { return frame.y[state_ + state]; }
  double& dydt(const Frame& frame, std::size_t state) const { return frame.dydt[state_ + state]; }
  double& state_of(double* all, std::size_t state) const { return all[state_ + state]; }
  double& across(const Frame& frame, std::size_t port, std::uint32_t what = 0) const {
    return frame.v[ports_[port].across + what];
  }
  double& through(const Frame& frame, std::size_t port, std::uint32_t what = 0) const {
    return frame.v[ports_[port].through + what];
  }
  bool connected(std::size_t port) const { return ports_[port].connected; }
  double fault(std::size_t index) const { return faults_[index]; }

 private:
  std::vector<PortSlots> ports_;
  std::size_t state_ = 0;
  std::size_t roots_ = 0;
  bool roots_read_values_ = false;
  std::vector<double> faults_;
  std::vector<double> start_, tolerance_, liquid_, heat_;
};

}  // namespace stepwright::components
