#pragma once

// Task networks: the keywords that methods and the problem's ":htn" share.
//
// Thread rule: one parse, one object; it takes its text from the stream of its FormulaParser.

#include <string>

#include "supervisor/htn/syntax/formula_parser.h"

namespace stepwright::htn {

class NetworkParser {
 public:
  NetworkParser(lisp::TokenStream& tokens, FormulaParser& formulas) : tokens_(tokens), formulas_(formulas) {}

  // Whether this keyword begins a part of a network.
  static bool knows(const std::string& keyword);

  // What follows that keyword. False after an error.
  bool part(ParsedNetwork& network, const std::string& keyword, Place at);

  // Puts the subtasks in their order; reports P0602 to P0604. False after an error.
  bool finish(ParsedNetwork& network);

 private:
  bool subtasks(ParsedNetwork& network);
  bool subtask(ParsedNetwork& network);
  bool ordering(ParsedNetwork& network);
  bool order(ParsedNetwork& network);
  bool label(ParsedTerm& term);

  lisp::TokenStream& tokens_;
  FormulaParser& formulas_;
};

}  // namespace stepwright::htn
