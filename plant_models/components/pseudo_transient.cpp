#include "plant_models/components/pseudo_transient.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace stepwright::components {
namespace {

constexpr double kSolved = 1e-10;  // of the typical flows
// Where no step leads nearer: with several check valves that are just about to open. 1e-7 l/s.
constexpr double kNearly = 1e-6;
constexpr double kStill = 1e-8;  // less than this brings no warmth to a junction
constexpr int kMostSteps = 300;
constexpr int kMostRounds = 8;    // between pressures and temperatures
constexpr double kLongest = 1e3;  // of an unknown's typical size, in one step
constexpr double kLeastDrag = 1e-14;
constexpr double kMostDrag = 1e12;

}  // namespace

struct PseudoTransient::State {
  explicit State(const Loop& of) : loop(of), size(of.unknowns.size()) {
    for (std::size_t i = 0; i < size; ++i) (loop.pressure_of[i] < 0 ? driven : carried).push_back(i);
    f.resize(size);
    tried.resize(size);
    chosen.resize(size);
    for (Eigen::VectorXd* each : {&r, &step, &next, &best, &above, &below})
      each->resize(static_cast<Eigen::Index>(driven.size()));
    for (Eigen::MatrixXd* each : {&steep, &flat, &matrix}) each->resize(r.size(), r.size());
    warmth.resize(static_cast<Eigen::Index>(carried.size()));
    warmer.resize(warmth.size());
    mixing.resize(warmth.size(), warmth.size());
    solver = Eigen::PartialPivLU<Eigen::MatrixXd>(r.size());
    mixer = Eigen::PartialPivLU<Eigen::MatrixXd>(warmth.size());
  }

  // Scaled flows into the junctions at `at`.
  void flows(const Residual& residual, const double* at, Eigen::VectorXd& to) {
    residual(at, f.data());
    for (std::size_t i = 0; i < driven.size(); ++i)
      to[static_cast<Eigen::Index>(i)] = f[driven[i]] / loop.typical_residual[driven[i]];
  }

  // By differences on both sides: at a kink, such as where a check valve opens, they are not the same.
  void slopes(const Residual& residual, double* at) {
    for (std::size_t j = 0; j < driven.size(); ++j) {
      const auto column = static_cast<Eigen::Index>(j);
      const std::size_t unknown = driven[j];
      const double typical = loop.typical[unknown];
      const double kept = at[unknown];
      const double length = 1e-8 * std::max(std::abs(kept), 1e-3 * typical);
      at[unknown] = kept + length;
      flows(residual, at, above);
      at[unknown] = kept - length;
      flows(residual, at, below);
      at[unknown] = kept;
      for (Eigen::Index i = 0; i < r.size(); ++i) {
        const double up = (above[i] - r[i]) * (typical / length);
        const double down = (r[i] - below[i]) * (typical / length);
        const bool is_steeper = std::abs(up) > std::abs(down);
        steep(i, column) = is_steeper ? up : down;
        flat(i, column) = is_steeper ? down : up;
      }
    }
  }

  // The step with that drag, cut where it leads too far; false if it is no number.
  bool take_step(const Eigen::MatrixXd& jacobian, double drag, const double* at) {
    const double sign = steep.trace() > 0.0 ? -1.0 : 1.0;
    matrix = -sign * jacobian;
    matrix.diagonal().array() += drag;
    solver.compute(matrix);
    step = solver.solve(sign * r);
    const double longest = step.cwiseAbs().maxCoeff();
    if (!std::isfinite(longest)) return false;
    const double share = longest > kLongest ? kLongest / longest : 1.0;
    std::copy(at, at + size, tried.begin());
    for (std::size_t i = 0; i < driven.size(); ++i)
      tried[driven[i]] += share * step[static_cast<Eigen::Index>(i)] * loop.typical[driven[i]];
    return true;
  }

  // Nearer to rest, or as near on a plateau. A root mirrors a whole step to the other side, and back: what
  // flows the other way then has to be far less.
  bool is_better() const {
    const double before = r.squaredNorm();
    const double now = next.squaredNorm();
    return next.dot(r) > 0.0 ? now <= before : now <= 0.25 * before;
  }

  // The better one of the two steps, if it leads nearer to rest.
  bool go(const Residual& residual, double drag, double* at) {
    bool gone = false;
    for (const Eigen::MatrixXd* jacobian : {&steep, &flat}) {
      if (!take_step(*jacobian, drag, at)) continue;
      flows(residual, tried.data(), next);
      if (!next.allFinite() || !is_better() || (gone && next.squaredNorm() >= best.squaredNorm())) continue;
      gone = true;
      best = next;
      std::swap(tried, chosen);
    }
    if (!gone) return false;
    std::copy(chosen.begin(), chosen.end(), at);
    r = best;
    return true;
  }

  bool balance(const Residual& residual, double* at) {
    flows(residual, at, r);
    if (!r.allFinite()) return false;
    double drag = 0.0;
    for (int steps = 0; steps < kMostSteps && r.cwiseAbs().maxCoeff() > kSolved; ++steps) {
      slopes(residual, at);
      const double steepest = std::max(steep.cwiseAbs().maxCoeff(), 1.0);
      if (drag == 0.0) drag = steepest;
      while (drag < kMostDrag * steepest && !go(residual, drag, at)) drag *= 4.0;
      if (drag >= kMostDrag * steepest) break;
      drag = std::max(drag / 8.0, kLeastDrag * steepest);
    }
    return r.cwiseAbs().maxCoeff() <= kNearly;
  }

  // What flows into a junction brings its temperature nearer to its own. It stays where nothing flows.
  void mixed(const double* at, Eigen::VectorXd& to) const {
    for (std::size_t i = 0; i < carried.size(); ++i) {
      const std::size_t k = carried[i];
      to[static_cast<Eigen::Index>(i)] = f[k] - at[k] * f[static_cast<std::size_t>(loop.pressure_of[k])];
    }
  }
  void mix(const Residual& residual, double* at) {
    constexpr double kKelvin = 1.0;
    residual(at, f.data());
    mixed(at, warmth);
    std::copy(at, at + size, tried.begin());
    for (std::size_t j = 0; j < carried.size(); ++j) {
      tried[carried[j]] += kKelvin;
      residual(tried.data(), f.data());
      mixed(tried.data(), warmer);
      const auto column = static_cast<Eigen::Index>(j);
      mixing.col(column) = (warmer - warmth) / kKelvin;
      const std::size_t k = carried[j];
      mixing(column, column) -= kStill * loop.typical_residual[static_cast<std::size_t>(loop.pressure_of[k])];
      tried[k] = at[k];
    }
    mixer.compute(mixing);
    warmer = mixer.solve(-warmth);
    if (!warmer.allFinite()) return;
    for (std::size_t i = 0; i < carried.size(); ++i) at[carried[i]] += warmer[static_cast<Eigen::Index>(i)];
  }

  bool is_mixed(const Residual& residual, const double* at) {
    residual(at, f.data());
    mixed(at, warmer);
    for (std::size_t i = 0; i < carried.size(); ++i) {
      if (!(std::abs(warmer[static_cast<Eigen::Index>(i)]) <= kNearly * loop.typical_residual[carried[i]]))
        return false;
    }
    return true;
  }

  const Loop& loop;
  std::size_t size;
  std::vector<std::size_t> driven;   // unknowns that flows follow from
  std::vector<std::size_t> carried;  // temperatures that follow from flows
  std::vector<double> f, tried, chosen;
  Eigen::VectorXd r, step, next, best, above, below, warmth, warmer;
  Eigen::MatrixXd steep, flat, matrix, mixing;
  Eigen::PartialPivLU<Eigen::MatrixXd> solver, mixer;
};

PseudoTransient::PseudoTransient(const Loop& loop) : state_(std::make_unique<State>(loop)) {}
PseudoTransient::~PseudoTransient() = default;
PseudoTransient::PseudoTransient(PseudoTransient&&) noexcept = default;
PseudoTransient& PseudoTransient::operator=(PseudoTransient&&) noexcept = default;

bool PseudoTransient::solve(const Residual& residual, double* unknowns) {
  State& s = *state_;
  for (int round = 0; round < kMostRounds; ++round) {
    if (!s.balance(residual, unknowns)) return false;
    if (s.carried.empty()) return true;
    s.mix(residual, unknowns);
    if (s.is_mixed(residual, unknowns)) return true;
  }
  return false;
}

}  // namespace stepwright::components
