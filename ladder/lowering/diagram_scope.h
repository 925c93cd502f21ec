#pragma once

// Interface of the lowering of a diagram to the program around it, and to whoever takes its diagnostics. One
// per POU, one thread; the driver implements it over the syntax tree.

#include <cstdint>
#include <string>
#include <vector>

#include "ladder/graphic/diagram.h"
#include "ladder/syntax/parser.h"
#include "runtime/ground/result/diagnostic.h"

namespace stepwright::lowering {

struct Parameter {
  std::string name;
  std::string type;  // ST
};

// The interface of a function or function block.
struct Signature {
  bool is_function = false;
  std::string result;  // functions
  std::vector<Parameter> inputs;
  std::vector<Parameter> in_outs;
  std::vector<Parameter> outputs;
};

class DiagramScope {
 public:
  DiagramScope() = default;
  DiagramScope(const DiagramScope&) = delete;
  DiagramScope& operator=(const DiagramScope&) = delete;
  virtual ~DiagramScope() = default;

  // ST type of a variable, an element of an array, a member: "a.b[1].c"; empty if it is none or unknown.
  virtual std::string type_of(const std::string& variable) const = 0;
  // Whether the POU declares it for itself: nothing else can write it but through a reference or VAR_IN_OUT.
  virtual bool is_private(const std::string& variable) const = 0;
  // Null for standard functions and for what does not exist.
  virtual const Signature* signature(const std::string& type) const = 0;
  // The mark of a byte of the diagram's file (ladder/syntax/lexer.h), or nothing.
  virtual std::string mark(std::uint32_t where) const = 0;
  // A byte of the diagram's file for a reader.
  virtual result::Location location(std::uint32_t where) const = 0;
  // Names the place from a byte of the diagram's file on: "network 2, coil 'lamp'". Diagnostics and traps
  // there use the name.
  virtual void note(std::uint32_t where, const std::string& what) = 0;
  // A text with the marks of where its pieces stand, on one line. What is not whole (syntax/piece.h) is
  // reported, at `where` if the text does not know its place, and becomes empty.
  virtual std::string piece(const graphic::SourceText& text, syntax::PieceKind kind, std::uint32_t where) = 0;
  virtual void error(const char* code, std::uint32_t where, std::string message, std::string hint = {}) = 0;
  virtual void warning(const char* code, std::uint32_t where, std::string message, std::string hint = {}) = 0;
  // The name of a variable that nothing else in the POU has.
  virtual std::string new_wire() = 0;
};

}  // namespace stepwright::lowering
