#pragma once

// Shared parts of the PLCopen reader: the file that is read, its diagnostics, types, values, variables and
// bodies. Internal to this folder; one thread per file.

#include <optional>
#include <string>

#include "ladder/exchange/xml_file.h"
#include "ladder/graphic/project.h"
#include "ladder/source/codes.h"
#include "ladder/source/dialect.h"

namespace stepwright::exchange::plcopen {

// The file that is read and what is wrong with it.
class ReadContext {
 public:
  ReadContext(const XmlFile& file, const source::Dialect& dialect) : file_(file), dialect_(dialect) {}

  const source::Dialect& dialect() const { return dialect_; }

  const XmlFile& file() const { return file_; }
  void error(pugi::xml_node where, const char* code, std::string message, std::string hint = {});
  result::Diagnostics take() { return std::move(diagnostics_); }
  bool failed() const { return !diagnostics_.empty(); }

  // An attribute that must not be empty: reported if it is. That it is there, the schema says.
  std::string required(pugi::xml_node node, const char* attribute);
  // The same, where a name stands: E0802 for one that would be read as several words.
  std::string required_name(pugi::xml_node node, const char* attribute);
  bool boolean(pugi::xml_node node, const char* attribute);
  std::optional<double> decimal(pugi::xml_node node, const char* attribute);
  std::optional<std::uint64_t> number(pugi::xml_node node, const char* attribute);
  // The text of the child "documentation".
  std::string documentation(pugi::xml_node node) const;

 private:
  const XmlFile& file_;
  const source::Dialect& dialect_;
  result::Diagnostics diagnostics_;
};

// The ST text of the type that `node` (<type>, <baseType>, <returnType>) holds.
std::string read_type(ReadContext& context, pugi::xml_node node);
// The ST text of <initialValue>, but for the quotes of strings (graphic::with_quotes).
std::string read_value(ReadContext& context, pugi::xml_node node);

// Appends the variables of one list.
void read_variables(ReadContext& context, pugi::xml_node list, graphic::VariableSection section,
                    std::vector<graphic::Variable>& variables, std::vector<graphic::VariableList>& lists);

graphic::DiagramBody read_body(ReadContext& context, pugi::xml_node node);

}  // namespace stepwright::exchange::plcopen
