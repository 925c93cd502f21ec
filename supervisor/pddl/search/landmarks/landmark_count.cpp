#include "supervisor/pddl/search/landmarks/landmark_count.h"

#include <algorithm>

namespace stepwright::pddl {

LandmarkCount::LandmarkCount(const RelaxedTask& task, const Landmarks& landmarks,
                             const std::vector<int>& weights)
    : task_(task),
      landmarks_(landmarks),
      words_((landmarks.size() + 63) / 64),
      weights_(landmarks.size(), INT32_MAX) {
  std::vector<std::vector<int>> reached_by(weights.size());
  for (std::size_t u = 0; u < task.units(); ++u) {
    const int op = task.operator_of(u);
    const auto count = [&](int atom) {
      const int landmark = landmarks.landmark_of(atom);
      if (landmark < 0) return;
      int& weight = weights_[static_cast<std::size_t>(landmark)];
      weight = std::min(weight, op < 0 ? 1 : weights[static_cast<std::size_t>(op)]);
      if (op >= 0) reached_by[static_cast<std::size_t>(op)].push_back(landmark);
    };
    for (const int atom : task.adds(u)) count(atom);
    for (const Mover& mover : task.moved_by(u)) count(mover.atom);
  }
  for (int& weight : weights_) weight = weight == INT32_MAX ? 1 : weight;
  reached_by_ = PackedLists<int>(reached_by);
}

bool LandmarkCount::all_reached(std::span<const int> landmarks, const Word* reached) {
  return std::all_of(landmarks.begin(), landmarks.end(), [&](int l) { return bit(reached, l); });
}

bool LandmarkCount::holds(std::size_t landmark, const Word* state) const {
  const auto atom = static_cast<std::size_t>(landmarks_.atom(landmark));
  const int literal = task_.literal_of(atom);
  if (literal >= 0) return task_.space().literal(state, literal);
  return task_.space().holds(task_.comparison(atom - task_.first_comparison()), state);
}

void LandmarkCount::progress(const Word* state, Word* reached) const {
  for (std::size_t l = 0; l < landmarks_.size(); ++l) {
    if (!bit(reached, static_cast<int>(l)) && holds(l, state)) reached[l >> 6] |= Word{1} << (l & 63);
  }
}

int LandmarkCount::estimate(const Word* state, const Word* reached) const {
  int sum = 0;
  for (std::size_t l = 0; l < landmarks_.size(); ++l) {
    bool needed = !bit(reached, static_cast<int>(l));
    if (!needed && holds(l, state)) {
      needed = !all_reached(landmarks_.better_first(l), reached);
    } else if (!needed) {
      needed = landmarks_.is_goal(l) || !all_reached(landmarks_.wanted_for(l), reached);
    }
    if (needed) sum += weights_[l];
  }
  return sum;
}

bool LandmarkCount::reaches_another(int op, const Word* reached) const {
  const std::span<const int> landmarks = reached_by_[static_cast<std::size_t>(op)];
  return std::any_of(landmarks.begin(), landmarks.end(), [&](int l) {
    return !bit(reached, l) && all_reached(landmarks_.better_first(static_cast<std::size_t>(l)), reached);
  });
}

}  // namespace stepwright::pddl
