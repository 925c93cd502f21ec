#include "supervisor/pddl/search/pruning/interchangeable.h"

#include <algorithm>
#include <numeric>

namespace stepwright::pddl {

Interchangeable::Interchangeable(const StateSpace& space, const SetLimits& limits)
    : space_(space), order_(space), sets_(find_exchange_sets(space, order_, limits)) {}

std::vector<std::pair<int, int>> Interchangeable::exchanged_variables() const {
  std::vector<std::pair<int, int>> list;
  for (const ExchangeSet& set : sets_) {
    const std::vector<int>& first = set.members.front().variables;
    for (const ExchangeMember& other : set.members) {
      for (std::size_t i = 0; i < first.size(); ++i) list.emplace_back(first[i], other.variables[i]);
    }
  }
  return list;
}

bool Interchangeable::parted(const ExchangeMember& member, const Word* state) const {
  return std::any_of(member.parted_by.begin(), member.parted_by.end(), [&](const VariableValue& need) {
    const int now = space_.domains().value(state, static_cast<std::size_t>(need.variable));
    return order_.can_follow(need.variable, now, need.value);
  });
}

// What parts objects must itself not be about one that changes its place.
void Interchangeable::choose_members(const ExchangeSet& set, const Word* state) const {
  members_.clear();
  for (const ExchangeMember& member : set.members) {
    if (!parted(member, state)) members_.push_back(&member);
  }
  for (const ExchangeMember& member : set.members) {
    for (const VariableValue& need : member.parted_by) {
      const int now = space_.domains().value(state, static_cast<std::size_t>(need.variable));
      const int fact = order_.fact_of({need.variable, now});
      if (fact < 0) continue;
      const auto& about = space_.task().facts[static_cast<std::size_t>(fact)].arguments;
      std::erase_if(members_, [&](const ExchangeMember* chosen) {
        return std::find(about.begin(), about.end(), chosen->object) != about.end();
      });
    }
  }
}

void Interchangeable::read_profiles(const Word* state) const {
  profiles_.resize(members_.size());
  for (std::size_t m = 0; m < members_.size(); ++m) {
    const ExchangeMember& member = *members_[m];
    std::vector<Word>& profile = profiles_[m];
    profile.assign((member.facts.size() + 63) / 64, 0);
    for (std::size_t i = 0; i < member.facts.size(); ++i)
      profile[i >> 6] |= static_cast<Word>(space_.fact(state, member.facts[i])) << (i & 63);
    for (const int v : member.variables)
      profile.push_back(state[space_.fact_words() + static_cast<std::size_t>(v)]);
  }
}

void Interchangeable::arrange(const ExchangeSet& set, Word* state) const {
  choose_members(set, state);
  read_profiles(state);
  if (std::is_sorted(profiles_.begin(), profiles_.end())) return;
  std::sort(profiles_.begin(), profiles_.end());
  for (std::size_t m = 0; m < members_.size(); ++m) {
    const ExchangeMember& member = *members_[m];
    const std::vector<Word>& profile = profiles_[m];
    for (std::size_t i = 0; i < member.facts.size(); ++i) {
      const int fact = member.facts[i];
      const Word bit = Word{1} << (fact & 63);
      const bool holds = (profile[i >> 6] >> (i & 63) & 1) != 0;
      state[fact >> 6] = holds ? state[fact >> 6] | bit : state[fact >> 6] & ~bit;
    }
    const std::size_t words = profile.size() - member.variables.size();
    for (std::size_t i = 0; i < member.variables.size(); ++i)
      state[space_.fact_words() + static_cast<std::size_t>(member.variables[i])] = profile[words + i];
  }
}

void Interchangeable::arrange(Word* state) const {
  for (const ExchangeSet& set : sets_) arrange(set, state);
}

void Interchangeable::find_twins(const Word* state, std::vector<Twin>& twins) const {
  twins.clear();
  for (const ExchangeSet& set : sets_) {
    choose_members(set, state);
    read_profiles(state);
    ranks_.resize(members_.size());
    std::iota(ranks_.begin(), ranks_.end(), std::size_t{0});
    std::sort(ranks_.begin(), ranks_.end(), [this](std::size_t a, std::size_t b) {
      return profiles_[a] != profiles_[b] ? profiles_[a] < profiles_[b] : a < b;
    });
    for (std::size_t r = 1, first = 0; r < ranks_.size(); ++r) {
      if (profiles_[ranks_[r]] != profiles_[ranks_[first]]) {
        first = r;
        continue;
      }
      const ExchangeMember& member = *members_[ranks_[r]];
      twins.push_back(
          {member.object, members_[ranks_[first]]->object, set.first_is_enough ? &member.facts : nullptr});
    }
  }
}

}  // namespace stepwright::pddl
