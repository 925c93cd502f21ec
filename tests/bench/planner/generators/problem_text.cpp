#include "tests/bench/planner/generators/problem_text.h"

namespace stepwright::bench {

std::vector<std::string> numbered(const std::string& prefix, int count) {
  std::vector<std::string> names;
  for (int i = 1; i <= count; ++i) names.push_back(prefix + std::to_string(i));
  return names;
}

ProblemText::ProblemText(const std::string& problem, const std::string& domain)
    : head_("(define (problem " + problem + ")\n  (:domain " + domain + ")\n") {}

void ProblemText::objects(const std::string& type, const std::vector<std::string>& names) {
  if (names.empty()) return;
  objects_ += "   ";
  for (const std::string& name : names) objects_ += " " + name;
  objects_ += " - " + type + "\n";
}

std::string ProblemText::text() const {
  std::string text = head_ + "  (:objects\n" + objects_ + "  )\n  (:init\n" + init_ + "  )\n  (:goal (and\n" +
                     goal_ + "  ))\n";
  if (!metric_.empty()) text += "  (:metric " + metric_ + ")\n";
  return text + ")\n";
}

}  // namespace stepwright::bench
