#include "supervisor/motion/kinematics/newton.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "supervisor/motion/kinematics/sinusoid.h"
#include "supervisor/motion/spatial/random.h"

namespace stepwright::motion {

namespace {

using Six = std::array<double, 6>;

// Solves a x = b for a symmetric matrix above zero (Cholesky), in place of b; false where it is not above
// zero.
bool solve_symmetric(std::array<Six, 6>& a, Six& b) {
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      double sum = a[i][j];
      for (std::size_t k = 0; k < j; ++k) sum -= a[i][k] * a[j][k];
      if (i != j)
        a[i][j] = sum / a[j][j];
      else if (!(sum > 0.0))
        return false;
      else
        a[i][i] = std::sqrt(sum);
    }
    for (std::size_t k = 0; k < i; ++k) b[i] -= a[i][k] * b[k];
    b[i] /= a[i][i];
  }
  for (std::size_t i = 6; i-- > 0;) {
    for (std::size_t k = i + 1; k < 6; ++k) b[i] -= a[k][i] * b[k];
    b[i] /= a[i][i];
  }
  return true;
}

class Newton {
 public:
  Newton(const Chain& chain, const Transform& goal, const NewtonOptions& options)
      : chain_(chain), goal_(goal), options_(options), random_(options.seed), q_(chain.size()) {}

  std::vector<std::vector<double>> run() {
    if (!options_.near.empty()) {
      q_.assign(options_.near.begin(), options_.near.end());
      clamp();
      if (descend()) keep();
    }
    for (std::size_t k = 0; k < options_.starts && found_.size() < options_.most; ++k) {
      for (std::size_t j = 0; j < q_.size(); ++j) q_[j] = random_.between(lowest(j), highest(j));
      if (descend()) keep();
    }
    return std::move(found_);
  }

 private:
  double lowest(std::size_t j) const {
    return std::isfinite(chain_.joints()[j].lower) ? chain_.joints()[j].lower : -std::numbers::pi;
  }
  double highest(std::size_t j) const {
    return std::isfinite(chain_.joints()[j].upper) ? chain_.joints()[j].upper : std::numbers::pi;
  }
  void clamp() {
    for (std::size_t j = 0; j < q_.size(); ++j)
      q_[j] = std::clamp(q_[j], chain_.joints()[j].lower, chain_.joints()[j].upper);
  }

  // Steps until the error is small enough; false: it does not become so.
  bool descend() {
    std::array<double, 6 * Chain::kMostJoints> columns;
    for (std::size_t step = 0; step <= options_.steps; ++step) {
      const Transform tip = chain_.jacobian(q_, columns);
      const Vector3 off = goal_.position_m - tip.position_m;
      const Vector3 turn = tip.rotation * rotation_vector(transposed(tip.rotation) * goal_.rotation);
      if (length(off) <= options_.position_m && length(turn) <= options_.angle_rad) return true;
      if (step == options_.steps || !advance(columns, {off.x, off.y, off.z, turn.x, turn.y, turn.z}))
        return false;
    }
    return false;
  }

  // q += J^T (J J^T + k E)^-1 error, with k from the error; then the limits cut.
  bool advance(std::span<const double> columns, Six error) {
    double square = 0.0;
    for (const double each : error) square += each * each;
    constexpr double kDamping = 0.5;
    constexpr double kLeast = 1e-14;
    std::array<Six, 6> normal{};
    for (std::size_t i = 0; i < 6; ++i)
      for (std::size_t j = 0; j <= i; ++j) {
        double sum = i == j ? std::min(kDamping * square, 1e-1) + kLeast : 0.0;
        for (std::size_t k = 0; k < q_.size(); ++k) sum += columns[6 * k + i] * columns[6 * k + j];
        normal[i][j] = sum;
      }
    if (!solve_symmetric(normal, error)) return false;
    double moved = 0.0;
    for (std::size_t k = 0; k < q_.size(); ++k) {
      double change = 0.0;
      for (std::size_t i = 0; i < 6; ++i) change += columns[6 * k + i] * error[i];
      const double before = q_[k];
      q_[k] = std::clamp(before + std::clamp(change, -1.0, 1.0), chain_.joints()[k].lower,
                         chain_.joints()[k].upper);
      moved = std::max(moved, std::abs(q_[k] - before));
    }
    return moved > 1e-15;  // else the limits hold it
  }

  void keep() {
    for (std::size_t j = 0; j < q_.size(); ++j)
      if (!std::isfinite(chain_.joints()[j].lower)) q_[j] = wrapped(q_[j]);
    const auto same = [&](const std::vector<double>& other) {
      for (std::size_t j = 0; j < q_.size(); ++j)
        if (std::abs(q_[j] - other[j]) > options_.apart_rad) return false;
      return true;
    };
    if (std::none_of(found_.begin(), found_.end(), same)) found_.push_back(q_);
  }

  const Chain& chain_;
  const Transform& goal_;
  const NewtonOptions& options_;
  Random random_;
  std::vector<double> q_;
  std::vector<std::vector<double>> found_;
};

}  // namespace

std::vector<std::vector<double>> solve_by_newton(const Chain& chain, const Transform& tip,
                                                 const NewtonOptions& options) {
  return Newton(chain, tip, options).run();
}

}  // namespace stepwright::motion
