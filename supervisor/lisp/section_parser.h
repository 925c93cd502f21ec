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

  // What stands in parentheses, one by one, up to the end of the section. An error in one ends that one only.
  template <typename Element>
  bool elements(const Element& element) {
    while (tokens_.at(TokenKind::Open)) {
      const std::size_t depth = tokens_.depth();
      if (!element()) tokens_.recover(depth);
    }
    return tokens_.at(TokenKind::Close) || tokens_.unexpected("'(' or ')'");
  }

  // The declarations of a section of functions. They may carry a result type, which can only be a number
  // here.
  template <typename Declaration>
  bool numeric_functions(const Declaration& declaration) {
    while (!tokens_.at(TokenKind::Close)) {
      if (!tokens_.at(TokenKind::Operator, "-")) {
        if (!declaration()) return false;
        continue;
      }
      tokens_.take();
      if (!tokens_.at(TokenKind::Name, "number")) return tokens_.unexpected("'number'");
      tokens_.take();
    }
    return true;
  }

  TokenStream tokens_;

 private:
  std::set<std::string> seen_;
};

}  // namespace stepwright::lisp
