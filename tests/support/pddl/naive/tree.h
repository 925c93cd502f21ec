#pragma once

// PDDL text as nested lists of lower-case words: the reader of the naive interpreter. It shares no code with
// the planner's parser and expects text without errors.

#include <string>
#include <utility>
#include <vector>

namespace stepwright::pddl::testing {

struct Tree {
  std::string word;         // of a leaf
  std::vector<Tree> parts;  // of a list
  bool leaf() const { return !word.empty(); }
  const Tree& operator[](std::size_t i) const { return parts.at(i); }
  std::size_t size() const { return parts.size(); }
  // The first word of a list; empty for an empty list.
  std::string head() const { return parts.empty() ? std::string() : parts[0].word; }
};

Tree read_tree(const std::string& text);

// "?a ?b - t c" as names with their types; several types for (either ...).
using TypedName = std::pair<std::string, std::vector<std::string>>;
std::vector<TypedName> read_typed(const std::vector<Tree>& words, std::size_t first);

}  // namespace stepwright::pddl::testing
