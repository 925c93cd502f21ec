#pragma once

// Base of the parsers of PDDL and HDDL files: "(define (domain name) (:section ...) ...)".
//
// Thread rule: one parse, one object.

#include <functional>
#include <set>
#include <string>
#include <vector>

#include "supervisor/lisp/token_stream.h"

namespace stepwright::lisp {

struct RequirementFlag {
  std::string name;
  Place at;
};

class SectionParser {
 public:
  SectionParser(std::vector<Token> tokens, Reporter& reporter) : tokens_(std::move(tokens), reporter) {}

 protected:
  // Handles what follows a section's keyword; false after an error, which ends the section only.
  using Handler = std::function<bool(const std::string& keyword, Place at)>;

  // "(define (kind name)".
  bool define(const std::string& kind, std::string& name, Place& at);

  // Every section up to the end of the file.
  void sections(const Handler& handler);

  // Reports a section that stands twice.
  bool once(const std::string& keyword, Place at);

  // Reports a keyword that is not known here. Always false.
  bool unknown(const std::string& keyword, Place at, const std::vector<std::string>& known);

  bool requirements(std::vector<RequirementFlag>& list);

  // "(:length (:serial 5) (:parallel 3))" of PDDL 1.2: what its author knew of plans binds none.
  bool length();

  TokenStream tokens_;

 private:
  std::set<std::string> seen_;
};

}  // namespace stepwright::lisp
