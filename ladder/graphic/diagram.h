#pragma once

// A drawn body (FBD, LD or SFC) as a graph of elements at their places, in the shape of PLCopen TC6 XML 2.01:
// what editors draw and files hold. Nothing is interpreted here; ladder/lowering reads programs and charts
// out of it, ladder/exchange writes it back as it is, with everything that it did not understand.
//
// An element names the elements that its inputs come from (as TC6 does): a connection belongs to the
// consumer. Identifiers are those of the file and unique in a diagram. Coordinates are those of the file; y
// grows downwards. Values; use from any thread.

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "ladder/graphic/condition.h"

namespace stepwright::graphic {

struct Place {
  double x = 0;
  double y = 0;

  friend bool operator==(const Place&, const Place&) = default;
};

// Content of a file beyond the model: attributes, and XML of child elements (addData and the like).
struct Extra {
  std::vector<std::pair<std::string, std::string>> attributes;
  std::string children;
};

// Where each piece of a text stands in its file: from `text` on the bytes are those of the file from `file`
// on, up to the next anchor. Sorted.
struct TextAnchor {
  std::uint32_t text = 0;
  std::uint32_t file = 0;
};
struct SourceText {
  std::string text;
  std::vector<TextAnchor> anchors;  // empty if it was never in a file
};

enum class Storage : std::uint8_t { None, Set, Reset };

struct Modifier {
  bool negated = false;
  Edge edge = Edge::None;
  Storage storage = Storage::None;
};

struct Connection {
  std::uint64_t from = 0;   // identifier of an element
  std::string output;       // name of its output; empty = its only or first one
  std::vector<Place> path;  // from the consumer to the producer; may be empty
  Extra extra;
};

// An input or output of an element. Names matter for blocks and branches only.
struct Pin {
  std::string name;
  Modifier modifier;
  std::vector<Connection> connections;  // inputs: several are a wired OR
  SourceText expression;                // instead of connections; may be empty
  std::optional<Place> position;        // relative to the element
  bool has_point = true;                // a block's output may have no connection point
  std::string documentation;
  Extra extra;        // of the pin
  Extra point_extra;  // of its connection point
};

enum class ElementKind : std::uint8_t {
  Comment,
  Error,
  Connector,
  Continuation,
  ActionBlock,
  VendorElement,
  Block,
  InVariable,
  OutVariable,
  InOutVariable,
  Label,
  Jump,
  Return,
  LeftPowerRail,
  RightPowerRail,
  Coil,
  Contact,
  Step,
  MacroStep,
  JumpStep,
  Transition,
  SelectionDivergence,
  SelectionConvergence,
  SimultaneousDivergence,
  SimultaneousConvergence,
};

struct DiagramBody;

// One row of an action block.
struct DiagramAction {
  std::string qualifier;  // empty = N
  std::string duration;
  std::string indicator;
  std::string reference;          // name of an action or variable; empty if `body` holds it
  std::vector<DiagramBody> body;  // none or one
  std::optional<Place> position;  // relative to the block
  std::string documentation;
  Extra extra;
  std::uint32_t where = 0;
};

enum class ConditionSource : std::uint8_t { None, Reference, Connection, Inline };

struct TransitionCondition {
  ConditionSource source = ConditionSource::None;
  bool negated = false;
  std::string reference;          // Reference: a named transition; Inline: the name it has
  std::vector<DiagramBody> body;  // Inline: one
  Pin input;                      // Connection
};

struct Element {
  ElementKind kind = ElementKind::Comment;
  std::uint64_t id = 0;
  Place position;
  std::optional<double> width;
  std::optional<double> height;
  std::optional<std::uint64_t> order;  // executionOrderId
  // Contact, Coil: variable; In/Out/InOutVariable: expression; Block: type; Label, Jump: label; Connector,
  // Continuation: name; Step: name; JumpStep: target; Comment, Error: content.
  SourceText name;
  std::string instance;      // Block
  Modifier modifier;         // of contacts, coils and variables (InOutVariable: its input)
  Modifier output_modifier;  // InOutVariable
  std::vector<Pin> inputs;
  std::vector<Pin> in_outs;  // Block; connections are those of its input side
  std::vector<Pin> outputs;
  bool initial = false;                   // Step
  std::optional<Pin> action_output;       // Step
  std::optional<std::uint64_t> priority;  // Transition
  TransitionCondition condition;          // Transition
  std::vector<DiagramAction> actions;     // ActionBlock
  std::string documentation;
  Extra extra;
  std::uint32_t where = 0;  // byte of the file, 0 = none
};

enum class DiagramLanguage : std::uint8_t { Ladder, FunctionBlocks, Chart };

struct Diagram {
  DiagramLanguage language = DiagramLanguage::Ladder;
  std::vector<Element> elements;
};

enum class BodyLanguage : std::uint8_t { StructuredText, InstructionList, Diagram };

// A body of any language.
struct DiagramBody {
  BodyLanguage language = BodyLanguage::StructuredText;
  SourceText text;  // StructuredText, InstructionList
  Diagram diagram;
  std::string documentation;
  Extra extra;
  std::uint32_t where = 0;
};

// An action or transition of a POU with a name of its own.
struct NamedBody {
  std::string name;
  DiagramBody body;
  std::string documentation;
  Extra extra;
  std::uint32_t where = 0;
};

// "contact", "selectionDivergence": the name of the element in TC6.
const char* to_string(ElementKind kind);

// The element with this identifier, or null.
const Element* find(const Diagram& diagram, std::uint64_t id);

}  // namespace stepwright::graphic
