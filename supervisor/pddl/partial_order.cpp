#include "supervisor/pddl/partial_order.h"

#include <algorithm>
#include <cstdint>
#include <unordered_map>

#include "supervisor/pddl/ground_action.h"

namespace stepwright::pddl {
namespace {

// Facts and fluents as numbers, ascending.
struct Footprint {
  std::vector<int> reads, writes, counts;
};

// Numbers names in the order in which they come.
class Names {
 public:
  std::vector<int> numbers(const std::set<std::string>& names) {
    std::vector<int> list;
    for (const std::string& name : names) {
      list.push_back(numbers_.try_emplace(name, static_cast<int>(numbers_.size())).first->second);
    }
    std::sort(list.begin(), list.end());
    return list;
  }

 private:
  std::unordered_map<std::string, int> numbers_;
};

// Calls `visit` with every number that both have, until it says so.
template <typename Visit>
bool any_common(const std::vector<int>& a, const std::vector<int>& b, const Visit& visit) {
  for (auto i = a.begin(), j = b.begin(); i != a.end() && j != b.end();) {
    if (*i == *j && visit(*i)) return true;
    *i <= *j ? ++i : ++j;
  }
  return false;
}

bool interfere(const Footprint& a, const Footprint& b) {
  const auto always = [](int) { return true; };
  const auto counted = [](const Footprint& print, int name) {
    return std::binary_search(print.counts.begin(), print.counts.end(), name);
  };
  return any_common(a.writes, b.reads, always) || any_common(a.reads, b.writes, always) ||
         any_common(a.writes, b.writes, [&](int name) { return !(counted(a, name) && counted(b, name)); });
}

}  // namespace

result::Result<std::vector<model::Ordering>> lift_partial_order(const Task& task, const model::Plan& plan) {
  const std::size_t count = plan.actions.size();
  std::vector<Footprint> prints;
  Names names;
  for (const model::GroundAction& action : plan.actions) {
    auto info = inspect_action(task, action);
    if (!info) return result::forward(info);
    prints.push_back({names.numbers(info->reads), names.numbers(info->writes), names.numbers(info->counts)});
  }
  // Bit i of before[j]: i comes before j. Walking i downwards from j, a pair that is implied by a later one
  // is left out.
  const std::size_t words = count / 64 + 1;
  std::vector<std::vector<std::uint64_t>> before(count, std::vector<std::uint64_t>(words, 0));
  std::vector<model::Ordering> orderings;
  for (std::size_t j = 0; j < count; ++j) {
    for (std::size_t i = j; i-- > 0;) {
      const std::uint64_t bit = std::uint64_t{1} << (i % 64);
      if ((before[j][i / 64] & bit) != 0 || !interfere(prints[i], prints[j])) continue;
      orderings.push_back({i, j});
      before[j][i / 64] |= bit;
      for (std::size_t w = 0; w <= i / 64; ++w) before[j][w] |= before[i][w];
    }
  }
  std::sort(orderings.begin(), orderings.end(), [](const model::Ordering& a, const model::Ordering& b) {
    return a.before != b.before ? a.before < b.before : a.after < b.after;
  });
  return orderings;
}

}  // namespace stepwright::pddl
