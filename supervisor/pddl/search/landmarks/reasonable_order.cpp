#include "supervisor/pddl/search/landmarks/reasonable_order.h"

#include <algorithm>

namespace stepwright::pddl {
namespace {

class ReasonableOrder {
 public:
  ReasonableOrder(const RelaxedTask& task, const AtomOrder& order, const std::vector<int>& landmarks,
                  const std::vector<std::vector<int>>& wanted_for)
      : relaxed_(task),
        task_(task.space().task()),
        order_(order),
        landmarks_(landmarks),
        wanted_for_(wanted_for),
        first_(landmarks.size()),
        words_((landmarks.size() + 63) / 64),
        before_(landmarks.size(), std::vector<Word>(words_, 0)) {
    find_sets();
    find_needs();
    follow_order();
  }

  std::vector<std::vector<int>> run(const std::function<bool()>& stop) {
    const std::vector<Word> state = relaxed_.space().initial();
    for (std::size_t a = 0; a < landmarks_.size() && !stop(); ++a) {
      const int literal = literal_of(a);
      // What holds from the start has been reached before everything else.
      if (literal < 0 || relaxed_.space().literal(state.data(), literal)) continue;
      mark_gone(a);
      for (std::size_t b = 0; b < landmarks_.size(); ++b) {
        const int other = literal_of(b);
        if (a == b || other < 0 || other % 2 != 0 || !gone_[static_cast<std::size_t>(other / 2)]) continue;
        if (both_wanted(a, b)) add(a, b);
      }
    }
    return std::move(first_);
  }

 private:
  int literal_of(std::size_t l) const { return relaxed_.literal_of(static_cast<std::size_t>(landmarks_[l])); }

  void find_sets() {
    std::vector<std::vector<int>> sets(task_.facts.size());
    for (std::size_t s = 0; s < task_.exclusive.size(); ++s) {
      for (const int fact : task_.exclusive[s]) {
        sets[static_cast<std::size_t>(fact)].push_back(static_cast<int>(s));
      }
    }
    sets_of_ = PackedLists<int>(sets);
  }

  void find_needs() {
    std::vector<std::vector<int>> needs(landmarks_.size());
    for (std::size_t l = 0; l < landmarks_.size(); ++l) {
      for (const int later : wanted_for_[l]) {
        needs[static_cast<std::size_t>(later)].push_back(static_cast<int>(l));
      }
    }
    just_before_ = PackedLists<int>(needs);
  }

  void follow_order() {
    for (std::size_t l = 0; l < landmarks_.size(); ++l) {
      const Word* before = order_.before_atom(static_cast<std::size_t>(landmarks_[l]));
      for (std::size_t other = 0; other < landmarks_.size(); ++other) {
        if (other != l && bit(before, landmarks_[other])) before_[l][other >> 6] |= Word{1} << (other & 63);
      }
      goal_.push_back(std::binary_search(relaxed_.goal().begin(), relaxed_.goal().end(), landmarks_[l]));
    }
  }

  // Facts that do not hold while the fact does.
  template <typename Visit>
  void for_each_excluded(int fact, const Visit& visit) const {
    for (const int s : sets_of_[static_cast<std::size_t>(fact)]) {
      for (const int other : task_.exclusive[static_cast<std::size_t>(s)]) {
        if (other != fact) visit(static_cast<std::size_t>(other));
      }
    }
  }

  // Facts that cannot hold just before the landmark is reached for the first time, or just after it.
  void mark_gone(std::size_t landmark) {
    gone_.assign(task_.facts.size(), false);
    for (const int need : just_before_[landmark]) {
      const int literal = literal_of(static_cast<std::size_t>(need));
      if (literal >= 0 && literal % 2 == 0) {
        for_each_excluded(literal / 2, [this](std::size_t fact) { gone_[fact] = true; });
      }
    }
    undone_by_.assign(task_.facts.size(), 0);
    last_.assign(task_.facts.size(), -1);
    int achievers = 0;
    std::vector<Word> before;
    const int atom = landmarks_[landmark];
    for (const int unit : relaxed_.added_by(static_cast<std::size_t>(atom))) {
      const auto u = static_cast<std::size_t>(unit);
      if (!order_.applied(u)) continue;
      order_.before_unit(u, before);
      if (bit(before.data(), atom)) continue;
      count_undone(relaxed_.operator_of(u), achievers++);
    }
    for (std::size_t fact = 0; achievers > 0 && fact < gone_.size(); ++fact) {
      if (undone_by_[fact] == achievers) gone_[fact] = true;
    }
  }

  void count_undone(int op, int achiever) {
    if (op < 0) return;
    const auto undo = [&](std::size_t fact) {
      if (last_[fact] == achiever) return;
      last_[fact] = achiever;
      ++undone_by_[fact];
    };
    for (const GroundEffect& effect : task_.operators[static_cast<std::size_t>(op)].effects) {
      if (!effect.when.always()) continue;
      for (const int fact : effect.adds) for_each_excluded(fact, undo);
      for (const int fact : effect.deletes) {
        const bool stays = std::find(effect.adds.begin(), effect.adds.end(), fact) != effect.adds.end();
        if (!stays) undo(static_cast<std::size_t>(fact));
      }
    }
  }

  // Must b hold at a time when a has been reached: both at the end, or b just before something that comes
  // behind a?
  bool both_wanted(std::size_t a, std::size_t b) const {
    if (goal_[b]) return goal_[a];
    return std::any_of(wanted_for_[b].begin(), wanted_for_[b].end(), [&](int later) {
      const auto l = static_cast<std::size_t>(later);
      return l != a && bit(order_.before_atom(static_cast<std::size_t>(landmarks_[l])), landmarks_[a]);
    });
  }

  void add(std::size_t a, std::size_t b) {
    if (bit(before_[a].data(), static_cast<int>(b))) return;
    first_[b].push_back(static_cast<int>(a));
    if (bit(before_[b].data(), static_cast<int>(a))) return;
    std::vector<Word> more = before_[a];
    more[a >> 6] |= Word{1} << (a & 63);
    for (std::size_t l = 0; l < landmarks_.size(); ++l) {
      if (l != b && !bit(before_[l].data(), static_cast<int>(b))) continue;
      for (std::size_t w = 0; w < words_; ++w) before_[l][w] |= more[w];
    }
  }

  const RelaxedTask& relaxed_;
  const GroundTask& task_;
  const AtomOrder& order_;
  const std::vector<int>& landmarks_;
  const std::vector<std::vector<int>>& wanted_for_;
  std::vector<std::vector<int>> first_;
  std::size_t words_;
  std::vector<std::vector<Word>> before_;  // sets of landmarks, with what is better first
  std::vector<bool> goal_, gone_;
  PackedLists<int> sets_of_, just_before_;  // exclusive sets by fact; landmarks by landmark
  std::vector<int> undone_by_, last_;       // by fact: achievers that undo it, and the last of them
};

}  // namespace

std::vector<std::vector<int>> reasonable_order(const RelaxedTask& task, const AtomOrder& order,
                                               const std::vector<int>& landmarks,
                                               const std::vector<std::vector<int>>& wanted_for,
                                               const std::function<bool()>& stop) {
  return ReasonableOrder(task, order, landmarks, wanted_for).run(stop);
}

}  // namespace stepwright::pddl
