#pragma once

// A state of a planning task as a value: the facts that hold and the numbers of the fluents, by ground name.
//
// Thread rule: a plain value. Invariant: every name is canonical: lower case, one space, parentheses.
// Facts that are not in the state do not hold; fluents that are not in it are undefined.
//
//   State s = task.initial();
//   s.assign("(lev v1)", 4.0);
//   s.set("(is-at v1 f1)", false);

#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>

namespace stepwright::pddl {

// "( IS-AT  v1 F1 )" and "is-at v1 f1" -> "(is-at v1 f1)".
std::string canonical_name(std::string_view text);

// A number as PDDL text: "5", "0.25"; at most 12 significant digits.
std::string number_text(double value);

class State {
 public:
  bool holds(std::string_view fact) const;
  void set(std::string_view fact, bool value);

  // Nothing if the fluent has no value in this state.
  std::optional<double> value(std::string_view fluent) const;
  void assign(std::string_view fluent, double value);

  const std::set<std::string, std::less<>>& facts() const { return facts_; }
  const std::map<std::string, double, std::less<>>& fluents() const { return fluents_; }

  friend bool operator==(const State&, const State&) = default;

 private:
  std::set<std::string, std::less<>> facts_;
  std::map<std::string, double, std::less<>> fluents_;
};

}  // namespace stepwright::pddl
