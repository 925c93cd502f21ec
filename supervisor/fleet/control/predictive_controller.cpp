#include "supervisor/fleet/control/predictive_controller.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace stepwright::fleet {
namespace {

constexpr int kStates = 5;  // x, y, heading, speed, lock
constexpr int kControls = 2;
using StateVector = Eigen::Matrix<double, kStates, 1>;
using StateMatrix = Eigen::Matrix<double, kStates, kStates>;
using ControlVector = Eigen::Matrix<double, kControls, 1>;
using ControlMatrix = Eigen::Matrix<double, kControls, kControls>;
using InputMatrix = Eigen::Matrix<double, kStates, kControls>;
using GainMatrix = Eigen::Matrix<double, kControls, kStates>;

constexpr int kMostIterations = 8;
constexpr double kEnough = 1e-3;  // of the cost, by which an iteration must be better

double turned(double from_rad, double to_rad) {
  return std::remainder(to_rad - from_rad, 2.0 * std::numbers::pi);
}

StateVector vector_of(const VehicleState& state) {
  StateVector v;
  v << state.x_m, state.y_m, state.heading_rad, state.speed_m_s, state.lock_rad;
  return v;
}

StateVector difference(const VehicleState& from, const VehicleState& to) {
  StateVector d = vector_of(to) - vector_of(from);
  d(2) = turned(from.heading_rad, to.heading_rad);
  return d;
}

// The cost near a state: its slope and curvature (Gauss-Newton).
struct Quadratic {
  double value = 0.0;
  StateVector slope = StateVector::Zero();
  StateMatrix curvature = StateMatrix::Zero();

  void add(double weight, double error, const StateVector& gradient) {
    value += 0.5 * weight * error * error;
    slope += weight * error * gradient;
    curvature += weight * gradient * gradient.transpose();
  }
};

Quadratic tracking_cost(const VehicleState& at, const ReferenceState& wanted,
                        const ControllerWeights& weights) {
  Quadratic cost;
  const VehicleState& r = wanted.state;
  const double c = std::cos(r.heading_rad);
  const double s = std::sin(r.heading_rad);
  const double dx = at.x_m - r.x_m;
  const double dy = at.y_m - r.y_m;
  StateVector gradient = StateVector::Zero();
  gradient << c, s, 0, 0, 0;
  cost.add(weights.along, c * dx + s * dy, gradient);
  gradient << -s, c, 0, 0, 0;
  cost.add(weights.across, c * dy - s * dx, gradient);
  cost.add(weights.heading, turned(r.heading_rad, at.heading_rad), StateVector::Unit(2));
  cost.add(weights.speed, at.speed_m_s - r.speed_m_s, StateVector::Unit(3));
  cost.add(weights.lock, at.lock_rad - r.lock_rad, StateVector::Unit(4));
  return cost;
}

void add_area_cost(const VehicleState& at, const ReferenceState& wanted,
                   std::span<const geometry::Point> corners, const ControllerWeights& weights,
                   Quadratic& cost) {
  if (wanted.area.empty()) return;
  const double c = std::cos(at.heading_rad);
  const double s = std::sin(at.heading_rad);
  for (const geometry::Point& own : corners) {
    const geometry::Point arm{c * own.x_m - s * own.y_m, s * own.x_m + c * own.y_m};
    const geometry::Point corner{at.x_m + arm.x_m, at.y_m + arm.y_m};
    for (const geometry::HalfPlane& side : wanted.area) {
      const double beyond_m = geometry::dot(side.normal, corner) - side.offset_m + weights.margin_m;
      if (beyond_m <= 0.0) continue;
      StateVector gradient = StateVector::Zero();
      gradient << side.normal.x_m, side.normal.y_m, geometry::cross(arm, side.normal), 0, 0;
      cost.add(weights.area, beyond_m, gradient);
    }
  }
}

// The least of 1/2 u'Hu + g'u with low <= u <= high, and which of the two are free. Two numbers: all faces
// are tried.
struct BoxAnswer {
  ControlVector u = ControlVector::Zero();
  std::array<bool, kControls> is_free = {true, true};
};

BoxAnswer solve_box(const ControlMatrix& h, const ControlVector& g, const ControlVector& low,
                    const ControlVector& high) {
  const double determinant = h(0, 0) * h(1, 1) - h(0, 1) * h(1, 0);
  const ControlVector whole{(h(0, 1) * g(1) - h(1, 1) * g(0)) / determinant,
                            (h(1, 0) * g(0) - h(0, 0) * g(1)) / determinant};
  const auto inside = [&](int i, double value) { return value >= low(i) && value <= high(i); };
  if (inside(0, whole(0)) && inside(1, whole(1))) return {whole, {true, true}};
  const auto value = [&](const ControlVector& u) { return 0.5 * u.dot(h * u) + g.dot(u); };
  BoxAnswer best;
  double least = std::numeric_limits<double>::infinity();
  for (int fixed = 0; fixed < kControls; ++fixed) {
    const int other = 1 - fixed;
    for (const double bound : {low(fixed), high(fixed)}) {
      ControlVector u;
      u(fixed) = bound;
      const double free = -(g(other) + h(other, fixed) * bound) / h(other, other);
      u(other) = std::clamp(free, low(other), high(other));
      if (value(u) >= least) continue;
      least = value(u);
      best.u = u;
      best.is_free[static_cast<std::size_t>(fixed)] = false;
      best.is_free[static_cast<std::size_t>(other)] = inside(other, free);
    }
  }
  return best;
}

}  // namespace

struct PredictiveController::Gains {
  ControlVector open = ControlVector::Zero();
  GainMatrix feedback = GainMatrix::Zero();
};

PredictiveController::PredictiveController(const DriveLimits& limits, const geometry::Footprint& footprint,
                                           const ControllerWeights& weights)
    : limits_(limits),
      corners_{{{footprint.front_m, footprint.half_width_m},
                {footprint.front_m, -footprint.half_width_m},
                {-footprint.rear_m, footprint.half_width_m},
                {-footprint.rear_m, -footprint.half_width_m}}},
      weights_(weights) {}

void PredictiveController::reset() {
  controls_ = {};
}

PredictiveController::Controls PredictiveController::bounded(const Controls& controls) const {
  const double most = limits_.hard_brake_m_s2;
  return {std::clamp(controls.acceleration_m_s2, -most, most),
          std::clamp(controls.lock_rate_rad_s, -limits_.lock_rate_rad_s, limits_.lock_rate_rad_s)};
}

// Half a step of turning before the step of driving: exact on circles to the second order.
VehicleState PredictiveController::after(const VehicleState& state, const Controls& u) const {
  const double h = kControlStep_s;
  const double speed = state.speed_m_s + 0.5 * h * u.acceleration_m_s2;
  const double lock = state.lock_rad + 0.5 * h * u.lock_rate_rad_s;
  const double turn = speed * std::tan(lock) / limits_.wheelbase_m;
  const double heading = state.heading_rad + 0.5 * h * turn;
  return {
      state.x_m + h * speed * std::cos(heading), state.y_m + h * speed * std::sin(heading),
      state.heading_rad + h * turn,
      std::clamp(state.speed_m_s + h * u.acceleration_m_s2, -limits_.top_speed_m_s, limits_.top_speed_m_s),
      std::clamp(state.lock_rad + h * u.lock_rate_rad_s, -limits_.full_lock_rad, limits_.full_lock_rad)};
}

double PredictiveController::cost_of(const Trajectory& states, const Sequence& controls,
                                     const Reference& reference) const {
  double sum = 0.0;
  for (std::size_t k = 0; k < kHorizon; ++k) {
    sum += 0.5 * weights_.acceleration * controls[k].acceleration_m_s2 * controls[k].acceleration_m_s2 +
           0.5 * weights_.lock_rate * controls[k].lock_rate_rad_s * controls[k].lock_rate_rad_s;
    Quadratic cost = tracking_cost(states[k + 1], reference[k + 1], weights_);
    add_area_cost(states[k + 1], reference[k + 1], corners_, weights_, cost);
    sum += cost.value;
  }
  return sum;
}

void PredictiveController::sweep_back(const Reference& reference, std::array<Gains, kHorizon>& gains) const {
  StateVector slope = StateVector::Zero();
  StateMatrix curvature = StateMatrix::Zero();
  const double h = kControlStep_s;
  const double most = limits_.hard_brake_m_s2;
  for (std::size_t k = kHorizon; k-- > 0;) {
    Quadratic stage = tracking_cost(made_.states[k + 1], reference[k + 1], weights_);
    add_area_cost(made_.states[k + 1], reference[k + 1], corners_, weights_, stage);
    slope += stage.slope;
    curvature += stage.curvature;

    const VehicleState& x = made_.states[k];
    const Controls& u = controls_[k];
    const double speed = x.speed_m_s + 0.5 * h * u.acceleration_m_s2;
    const double lock = x.lock_rad + 0.5 * h * u.lock_rate_rad_s;
    const double bend = std::tan(lock) / limits_.wheelbase_m;
    const double bend_by_lock = (1.0 + std::tan(lock) * std::tan(lock)) / limits_.wheelbase_m;
    const double heading = x.heading_rad + 0.5 * h * speed * bend;
    const double c = std::cos(heading);
    const double s = std::sin(heading);
    StateMatrix a = StateMatrix::Identity();
    a(0, 2) = -h * speed * s;
    a(1, 2) = h * speed * c;
    a(0, 3) = h * c - h * speed * s * 0.5 * h * bend;
    a(1, 3) = h * s + h * speed * c * 0.5 * h * bend;
    a(2, 3) = h * bend;
    a(0, 4) = -h * speed * s * 0.5 * h * speed * bend_by_lock;
    a(1, 4) = h * speed * c * 0.5 * h * speed * bend_by_lock;
    a(2, 4) = h * speed * bend_by_lock;
    InputMatrix b = InputMatrix::Zero();
    b.col(0) = 0.5 * h * a.col(3);
    b.col(1) = 0.5 * h * a.col(4);
    b(3, 0) = h;
    b(4, 1) = h;

    const ControlVector now{u.acceleration_m_s2, u.lock_rate_rad_s};
    const ControlVector weight{weights_.acceleration, weights_.lock_rate};
    const ControlVector g = weight.cwiseProduct(now) + b.transpose() * slope;
    ControlMatrix q = b.transpose() * curvature * b;
    q.diagonal() += weight;
    const GainMatrix mixed = b.transpose() * curvature * a;
    const ControlVector limit{most, limits_.lock_rate_rad_s};
    const BoxAnswer answer = solve_box(q, g, -limit - now, limit - now);
    Gains& gain = gains[k];
    gain.open = answer.u;
    gain.feedback.setZero();
    if (answer.is_free[0] && answer.is_free[1]) {
      const double determinant = q(0, 0) * q(1, 1) - q(0, 1) * q(1, 0);
      gain.feedback.row(0) = -(q(1, 1) * mixed.row(0) - q(0, 1) * mixed.row(1)) / determinant;
      gain.feedback.row(1) = -(q(0, 0) * mixed.row(1) - q(1, 0) * mixed.row(0)) / determinant;
    } else {
      for (int i = 0; i < kControls; ++i) {
        if (answer.is_free[static_cast<std::size_t>(i)]) gain.feedback.row(i) = -mixed.row(i) / q(i, i);
      }
    }
    const StateVector own_slope = a.transpose() * slope;
    const StateMatrix own_curvature = a.transpose() * curvature * a;
    slope = own_slope + gain.feedback.transpose() * (q * gain.open + g) + mixed.transpose() * gain.open;
    curvature = own_curvature + gain.feedback.transpose() * q * gain.feedback +
                gain.feedback.transpose() * mixed + mixed.transpose() * gain.feedback;
    curvature = 0.5 * (curvature + curvature.transpose().eval());
  }
}

double PredictiveController::sweep_on(const std::array<Gains, kHorizon>& gains, double part,
                                      const Reference& reference, Trajectory& states,
                                      Sequence& controls) const {
  states[0] = made_.states[0];
  for (std::size_t k = 0; k < kHorizon; ++k) {
    const ControlVector change =
        part * gains[k].open + gains[k].feedback * difference(made_.states[k], states[k]);
    controls[k] =
        bounded({controls_[k].acceleration_m_s2 + change(0), controls_[k].lock_rate_rad_s + change(1)});
    states[k + 1] = after(states[k], controls[k]);
  }
  return cost_of(states, controls, reference);
}

const Prediction& PredictiveController::solve(const VehicleState& now, const Reference& reference) {
  std::shift_left(controls_.begin(), controls_.end(), 1);
  controls_.back() = {};
  made_.states[0] = now;
  for (std::size_t k = 0; k < kHorizon; ++k) made_.states[k + 1] = after(made_.states[k], controls_[k]);
  made_.cost = cost_of(made_.states, controls_, reference);
  made_.iterations = 0;
  std::array<Gains, kHorizon> gains;
  Trajectory states;
  Sequence controls;
  bool better = true;
  while (better && made_.iterations < kMostIterations) {
    ++made_.iterations;
    better = false;
    sweep_back(reference, gains);
    for (double part = 1.0; part > 0.05; part *= 0.5) {
      const double cost = sweep_on(gains, part, reference, states, controls);
      if (!(cost < made_.cost)) continue;
      better = cost < (1.0 - kEnough) * made_.cost;
      made_.cost = cost;
      made_.states = states;
      controls_ = controls;
      break;
    }
  }
  made_.acceleration_m_s2 = controls_[0].acceleration_m_s2;
  made_.lock_rate_rad_s = controls_[0].lock_rate_rad_s;
  return made_;
}

}  // namespace stepwright::fleet
