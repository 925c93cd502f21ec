#pragma once

// Declarations of a graphic project as ST: one parser reads them all. Internal to this folder.

#include <cstdint>
#include <functional>
#include <string>

#include "ladder/driver/project_scope.h"
#include "ladder/graphic/project.h"
#include "ladder/graphic/type_text.h"

namespace stepwright::driver {

// The mark of where something stands in the project's file.
using Mark = std::function<std::string(std::uint32_t where)>;

class DeclarationText {
 public:
  // Values of strings get their quotes: `interfaces` knows which are strings, and outlives this.
  explicit DeclarationText(const ProgramInterfaces& interfaces)
      : behind_([&interfaces](const std::string& name) { return interfaces.type_behind(name); }) {}

  // "VAR_INPUT x AT %IX0.0 : BOOL := TRUE; END_VAR", on one line.
  std::string variable(const graphic::Variable& variable) const;
  // The variables as people read them: with the quotes.
  std::vector<graphic::Variable> quoted(std::vector<graphic::Variable> variables) const;
  // TYPE .. END_TYPE; empty if the project has no types.
  std::string types(const graphic::Project& project, const Mark& mark) const;
  // Globals, tasks and instances; empty if the project has none of them.
  std::string configuration(const graphic::Project& project, const Mark& mark) const;

 private:
  std::string globals(std::vector<graphic::Variable> variables, const Mark& mark) const;

  graphic::TypeBehind behind_;
};

}  // namespace stepwright::driver
