#pragma once

// Task networks of the search: what is still to be done, as lists that share their ends. Equal networks have
// equal numbers.
//
// Thread rule: a container like any other.

#include <cstddef>
#include <vector>

namespace stepwright::htn {

class Agenda {
 public:
  static constexpr int kEmpty = -1;

  // The network that begins with the task.
  int push(int task, int rest);

  int task(int network) const { return cells_[static_cast<std::size_t>(network)].task; }
  int rest(int network) const { return cells_[static_cast<std::size_t>(network)].rest; }
  int length(int network) const {
    return network == kEmpty ? 0 : cells_[static_cast<std::size_t>(network)].length;
  }

 private:
  struct Cell {
    int task = 0;
    int rest = kEmpty;
    int length = 0;
  };

  void grow();
  std::size_t place(int task, int rest) const;

  std::vector<Cell> cells_;
  std::vector<int> places_;  // open addressing: number + 1, 0 = free; a power of two
};

}  // namespace stepwright::htn
