// What outlives the process that simulates the train: numbers in the order of keep().

#include <cmath>

#include "plant_models/assemblies/tugger.h"

namespace stepwright::assemblies {
namespace {

constexpr std::size_t kOfTractor = 3;   // pose
constexpr std::size_t kPerTrailer = 4;  // state (the truth's numbers), middle, heading
constexpr double kFarthestKept_m = 1000.0;

bool is_place(double x_m, double y_m, double heading_rad) {
  return std::abs(x_m) <= kFarthestKept_m && std::abs(y_m) <= kFarthestKept_m && std::isfinite(heading_rad);
}

}  // namespace

std::size_t Tugger::kept_size() const {
  return kOfTractor + kPerTrailer * most_trailers(parameters_);
}

void Tugger::keep(std::span<double> numbers) const {
  const body2d::Pose tractor = train_->tractor();
  std::size_t at = 0;
  for (const double number : {tractor.position.x, tractor.position.y, tractor.angle}) numbers[at++] = number;
  for (std::size_t k = 1; k <= most_trailers(parameters_); ++k) {
    for (const TuggerTruth kind :
         {TuggerTruth::LinkState, TuggerTruth::X, TuggerTruth::Y, TuggerTruth::Heading})
      numbers[at++] = truth_of_trailer(kind, k);
  }
}

bool Tugger::resume(std::span<const double> numbers) {
  if (numbers.size() != kept_size() || !is_place(numbers[0], numbers[1], numbers[2])) return false;
  const auto trailer = [&](std::size_t k) {
    return numbers.subspan(kOfTractor + kPerTrailer * (k - 1), kPerTrailer);
  };
  const std::size_t most = most_trailers(parameters_);
  std::size_t coupled = 0;
  for (std::size_t k = 1; k <= most; ++k) {
    const auto kept = trailer(k);
    const bool known = kept[0] == 0.0 || kept[0] == 1.0 || kept[0] == 2.0;
    if (!known || !is_place(kept[1], kept[2], kept[3])) return false;
    if (kept[0] != 1.0) continue;
    if (coupled + 1 != k) return false;  // behind one that is not coupled
    coupled = k;
  }
  std::vector<double> state(train_->state().begin(), train_->state().end());
  state[kBicycleX] = numbers[0];
  state[kBicycleY] = numbers[1];
  state[kBicycleHeading] = numbers[2];
  for (std::size_t k = 1; k <= most; ++k) {
    const auto kept = trailer(k);
    state[kTuggerTrailer + k - 1] = kept[3];
    PlacedBox box = train_->boxes().front();
    box.middle = {kept[1], kept[2]};
    box.ahead = {std::cos(kept[3]), std::sin(kept[3])};
    floor_.leave(k, kept[0] == 2.0 ? std::optional(box) : std::nullopt);
  }
  train_->couple(coupled);
  train_->stop_at(state);
  changed_ = true;
  return true;
}

}  // namespace stepwright::assemblies
