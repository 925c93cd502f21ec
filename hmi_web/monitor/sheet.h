#pragma once

// One sheet of a program's document (hmi_web/doc/program.md) as far as values are computed of it. The
// document is of anybody: what has another shape than it should is read as nothing.
//
//   auto sheet = read_sheet(json);
//
// A value; immutable once read. Expressions view its texts.

#include <cstdint>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "hmi_web/monitor/scope.h"
#include "hmi_web/monitor/texts.h"

namespace stepwright::monitor {

// What stands for a value: a variable, an expression, or the connector of a line that ended elsewhere.
struct Operand {
  std::string text;
  const syntax::Expression* expression = nullptr;  // null: a connector, or no ST
};

enum class NodeKind : std::uint8_t { True, Contact, Test, All, Any };
enum class EdgeKind : std::uint8_t { None, Rising, Falling };

struct Node {
  NodeKind kind = NodeKind::True;
  Operand operand;  // Contact, Test
  bool negated = false;
  EdgeKind edge = EdgeKind::None;
  std::vector<Node> of;  // All, Any
};

struct Box {
  std::string type;
  std::string instance;
  std::vector<Operand> inputs;
  std::vector<std::pair<std::string, std::string>> outputs;  // pin, variable
};

struct Coil {
  std::string kind;
  Operand operand;
};

struct Rung {
  std::string label;
  Node condition;
  std::vector<Box> boxes;
  std::vector<Coil> coils;
  std::string jump;
  bool returns = false;
};

// Statements, or a condition as a whole.
struct Body {
  const syntax::Statements* statements = nullptr;
  const syntax::Expression* condition = nullptr;
};

struct Pin {
  std::string name;
  bool negated = false;
  bool edge = false;
  bool has_text = false;
  Operand text;                                                  // instead of connections
  std::vector<std::pair<std::size_t, std::string>> connections;  // element, its output
};

struct Element {
  std::string kind;
  std::string instance;
  Operand name;
  bool negated = false;
  bool edge = false;
  std::vector<Pin> inputs;
  std::vector<Pin> outputs;
};

struct Diagram {
  std::vector<Element> elements;
};

// monostate: a block of which nothing is computed.
using Block = std::variant<std::monostate, Rung, Body, Diagram>;

struct Sheet {
  Sections sections;
  std::vector<Block> blocks;
  std::unique_ptr<Texts> texts;
};

Sheet read_sheet(const nlohmann::json& sheet);

}  // namespace stepwright::monitor
