#pragma once

// Types, objects and the symbols with their signatures: what bodies refer to.
//
// Thread rule: one reading, one object.

#include <string>
#include <vector>

#include "supervisor/htn/syntax/syntax_tree.h"
#include "supervisor/htn/task/names.h"
#include "supervisor/htn/task/planning_task.h"
#include "supervisor/lisp/reporter.h"

namespace stepwright::htn {

class Declarations {
 public:
  Declarations(PlanningTask& task, Names& names, lisp::Reporter& reporter)
      : task_(task), names_(names), reporter_(reporter) {}

  void requirements(const std::vector<lisp::RequirementFlag>& flags);
  // False where there are too many: what follows would take too much memory.
  bool types(const std::vector<TypedName>& list);
  bool objects(const std::vector<TypedName>& constants, const std::vector<TypedName>& objects);
  void symbols(const std::vector<ParsedSymbol>& parsed, std::vector<Symbol>& table,
               std::map<std::string, int>& ids, const std::string& what);

  // The type named; reports an unknown one (P0101) and answers object. An either becomes a type at its first
  // use.
  int type(const TypedName& typed);
  std::vector<int> types_of(const std::vector<TypedName>& parameters);

  void repeated(const std::string& what, const std::string& name, Place at);

 private:
  int declared_type(const std::string& name, Place at);
  void close_types(const std::vector<std::vector<int>>& parents, const std::vector<Place>& places);
  void add_objects(const std::vector<TypedName>& list);

  PlanningTask& task_;
  Names& names_;
  lisp::Reporter& reporter_;
};

}  // namespace stepwright::htn
