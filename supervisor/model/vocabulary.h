#pragma once

// The names that a planning domain and problem declare: what a file that refers to them is checked against.

#include <cstddef>
#include <string>
#include <vector>

namespace stepwright::model {

struct Symbol {
  std::string name;  // lower case
  std::size_t arity = 0;
};

struct Vocabulary {
  std::vector<Symbol> actions;
  std::vector<Symbol> predicates;
  std::vector<Symbol> functions;
  std::vector<std::string> objects;
};

}  // namespace stepwright::model
