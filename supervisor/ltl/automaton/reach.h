#pragma once

// Reachability between states: those that can reach some, and those that cannot help reaching them. Thread
// rule: const functions from any thread.

#include <cstdint>
#include <utility>
#include <vector>

namespace stepwright::ltl {

class Reach {
 public:
  explicit Reach(std::size_t states) : before_(states), outgoing_(states, 0) {}

  void add(std::uint32_t from, std::uint32_t to);

  // Seeds and the states from which some path, or every infinite path, meets one.
  std::vector<bool> some(std::vector<bool> seeds) const { return closed(std::move(seeds), false); }
  std::vector<bool> every(std::vector<bool> seeds) const { return closed(std::move(seeds), true); }

 private:
  std::vector<bool> closed(std::vector<bool> seeds, bool every) const;

  std::vector<std::vector<std::uint32_t>> before_;
  std::vector<std::uint32_t> outgoing_;
};

}  // namespace stepwright::ltl
