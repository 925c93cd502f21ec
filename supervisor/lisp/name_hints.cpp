#include "supervisor/lisp/name_hints.h"

#include <algorithm>

#include "runtime/ground/result/closest.h"

namespace stepwright::lisp {
namespace {

constexpr std::size_t kLongestName = 200;

}  // namespace

std::string did_you_mean(std::string_view name, const std::vector<std::string>& candidates) {
  if (name.size() > kLongestName) return {};
  const std::string* found = result::closest(name, candidates, std::max<std::size_t>(1, name.size() / 3));
  return found == nullptr ? std::string() : "did you mean '" + *found + "'?";
}

std::vector<std::string> names_of(const std::map<std::string, int>& ids) {
  std::vector<std::string> names;
  names.reserve(ids.size());
  for (const auto& [name, id] : ids) names.push_back(name);
  return names;
}

}  // namespace stepwright::lisp
