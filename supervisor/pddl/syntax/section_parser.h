#pragma once

// Base of the parsers of PDDL files: "(define (domain name) (:section ...) ...)".
//
// Thread rule: one parse, one object.

#include <functional>
#include <set>

#include "supervisor/pddl/syntax/formula_parser.h"
#include "supervisor/pddl/syntax/parser.h"

namespace stepwright::pddl {

class SectionParser {
 public:
  SectionParser(std::vector<Token> tokens, Reporter& reporter)
      : tokens_(std::move(tokens), reporter), formulas_(tokens_) {}

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

  TokenStream tokens_;
  FormulaParser formulas_;

 private:
  std::set<std::string> seen_;
};

}  // namespace stepwright::pddl
