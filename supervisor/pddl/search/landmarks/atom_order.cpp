#include "supervisor/pddl/search/landmarks/atom_order.h"

#include <algorithm>

namespace stepwright::pddl {

AtomOrder::AtomOrder(const RelaxedTask& task)
    : task_(task),
      words_((task.atoms() + 63) / 64),
      known_(task.atoms(), false),
      waiting_(task.units(), false),
      sets_(task.atoms() * words_) {
  for (std::size_t u = 0; u < task.units(); ++u) lacking_.push_back(static_cast<int>(task.needs(u).size()));
}

bool AtomOrder::work_out(const std::function<bool()>& stop) {
  const std::vector<Word> state = task_.space().initial();
  const std::vector<Word> nothing(words_, 0);
  task_.for_each_holding(state.data(),
                         [&](int atom) { meet(static_cast<std::size_t>(atom), nothing.data()); });
  for (const int unit : task_.without_needs()) wait(unit);
  std::vector<Word> before(words_);
  for (std::size_t turn = 0; !queue_.empty(); ++turn) {
    if (turn % 256 == 0 && stop()) return false;
    const auto unit = static_cast<std::size_t>(queue_.front());
    queue_.pop_front();
    waiting_[unit] = false;
    before_unit(unit, before);
    for (const int atom : task_.adds(unit)) meet(static_cast<std::size_t>(atom), before.data());
    for (const Mover& mover : task_.moved_by(unit)) meet(static_cast<std::size_t>(mover.atom), before.data());
  }
  return true;
}

void AtomOrder::before_unit(std::size_t unit, std::vector<Word>& set) const {
  set.assign(words_, 0);
  for (const int need : task_.needs(unit)) {
    const Word* other = before_atom(static_cast<std::size_t>(need));
    for (std::size_t w = 0; w < words_; ++w) set[w] |= other[w];
  }
}

void AtomOrder::wait(int unit) {
  if (waiting_[static_cast<std::size_t>(unit)]) return;
  waiting_[static_cast<std::size_t>(unit)] = true;
  queue_.push_back(unit);
}

// The atom can be reached after what is in `before`: only what is in all such sets comes before it always.
void AtomOrder::meet(std::size_t atom, const Word* before) {
  Word* mine = sets_.data() + atom * words_;
  const bool first = !known_[atom];
  bool changed = first;
  for (std::size_t w = 0; w < words_; ++w) {
    const Word joined = before[w] | (w == atom >> 6 ? Word{1} << (atom & 63) : 0);
    const Word now = first ? joined : mine[w] & joined;
    changed = changed || now != mine[w];
    mine[w] = now;
  }
  known_[atom] = true;
  if (!changed) return;
  for (const int unit : task_.needed_by(atom)) {
    int& lacking = lacking_[static_cast<std::size_t>(unit)];
    if (first) --lacking;
    if (lacking == 0) wait(unit);
  }
}

}  // namespace stepwright::pddl
