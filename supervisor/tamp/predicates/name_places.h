#pragma once

// Places of names in a domain and a problem that were read already.
//
// Immutable; any thread.
//
//   const NamePlaces places(domain, problem);
//   report("G0104", places.of("can9"), ...);

#include <string>
#include <vector>

#include "runtime/ground/result/diagnostic.h"
#include "supervisor/lisp/lexer.h"
#include "supervisor/lisp/place.h"

namespace stepwright::tamp::predicates {

// Of what has a name.
template <typename T>
std::vector<std::string> names_of(const std::vector<T>& all) {
  std::vector<std::string> names;
  for (const T& each : all) names.push_back(each.name);
  return names;
}

class NamePlaces {
 public:
  NamePlaces(const lisp::Source& domain, const lisp::Source& problem);

  // In the problem first, or in the domain; the begin of the problem where it is nowhere.
  result::Location of(const std::string& name) const;
  // Of a fact in the problem: its name and terms in a row.
  result::Location of(const std::vector<std::string>& fact) const;

 private:
  result::Location location(const lisp::Place& at) const;

  std::vector<lisp::Token> problem_, domain_;
  std::vector<std::string> files_;
};

}  // namespace stepwright::tamp::predicates
