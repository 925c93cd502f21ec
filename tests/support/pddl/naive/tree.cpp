#include "tests/support/pddl/naive/tree.h"

#include <cctype>
#include <stdexcept>

namespace stepwright::pddl::testing {
namespace {

void skip(const std::string& text, std::size_t& at) {
  while (at < text.size() && (std::isspace(static_cast<unsigned char>(text[at])) != 0 || text[at] == ';')) {
    if (text[at] == ';') {
      while (at < text.size() && text[at] != '\n') ++at;
    } else {
      ++at;
    }
  }
}

Tree read(const std::string& text, std::size_t& at) {
  skip(text, at);
  Tree tree;
  if (at >= text.size()) throw std::runtime_error("the text ends within a list");
  if (text[at] != '(') {
    while (at < text.size() && text[at] != '(' && text[at] != ')' && text[at] != ';' &&
           std::isspace(static_cast<unsigned char>(text[at])) == 0) {
      tree.word += static_cast<char>(std::tolower(static_cast<unsigned char>(text[at++])));
    }
    return tree;
  }
  for (++at, skip(text, at); at < text.size() && text[at] != ')'; skip(text, at)) {
    tree.parts.push_back(read(text, at));
  }
  ++at;
  return tree;
}

}  // namespace

Tree read_tree(const std::string& text) {
  std::size_t at = 0;
  return read(text, at);
}

std::vector<TypedName> read_typed(const std::vector<Tree>& words, std::size_t first) {
  std::vector<TypedName> names;
  std::size_t untyped = 0;
  for (std::size_t i = first; i < words.size(); ++i) {
    if (words[i].word != "-") {
      names.push_back({words[i].word, {"object"}});
      continue;
    }
    const Tree& type = words.at(++i);
    std::vector<std::string> types{type.word};
    if (!type.leaf()) {
      types.clear();
      for (std::size_t t = 1; t < type.size(); ++t) types.push_back(type[t].word);
    }
    for (; untyped < names.size(); ++untyped) names[untyped].second = types;
  }
  return names;
}

}  // namespace stepwright::pddl::testing
