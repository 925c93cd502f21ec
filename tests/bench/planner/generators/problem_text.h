#pragma once

// A PDDL problem put together piece by piece.
//
// Thread rule: a plain value.
//
//   ProblemText problem("two-parcels", "logistics");
//   problem.objects("parcel", numbered("parcel", 2));
//   problem.init("(lies parcel1 {})", depot);
//   return problem.text();

#include <fmt/format.h>

#include <string>
#include <utility>
#include <vector>

namespace stepwright::bench {

// prefix1 .. prefix<count>
std::vector<std::string> numbered(const std::string& prefix, int count);

class ProblemText {
 public:
  ProblemText(const std::string& problem, const std::string& domain);

  void objects(const std::string& type, const std::vector<std::string>& names);

  template <typename... Values>
  void init(fmt::format_string<Values...> form, Values&&... values) {
    init_ += "    " + fmt::format(form, std::forward<Values>(values)...) + "\n";
  }

  template <typename... Values>
  void goal(fmt::format_string<Values...> form, Values&&... values) {
    goal_ += "    " + fmt::format(form, std::forward<Values>(values)...) + "\n";
  }

  // "minimize (total-cost)"
  void metric(const std::string& text) { metric_ = text; }

  std::string text() const;

 private:
  std::string head_, objects_, init_, goal_, metric_;
};

}  // namespace stepwright::bench
