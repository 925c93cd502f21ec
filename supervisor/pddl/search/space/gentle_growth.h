#pragma once

// Growth of large arrays by a quarter instead of by double, so that memory stays near its bound.

#include <vector>

namespace stepwright::pddl {

template <typename T>
void push_gently(std::vector<T>& list, const T& item) {
  if (list.size() == list.capacity()) list.reserve(list.size() + list.size() / 4 + 256);
  list.push_back(item);
}

}  // namespace stepwright::pddl
