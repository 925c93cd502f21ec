#pragma once

// Interference of the elements of a diagram: whether the evaluation of one can change what another one reads.
// Answers yes where it cannot tell: what is global, located, passed by reference or computed by a call may be
// changed by any of its kind and by every call. Internal to this folder.
//
// One object per diagram, one thread: it keeps what it has found out about each element.

#include <map>
#include <set>
#include <string>

#include "ladder/graphic/diagram.h"
#include "ladder/lowering/diagram_graph.h"
#include "ladder/lowering/diagram_scope.h"
#include "ladder/syntax/piece.h"

namespace stepwright::lowering {

class Interference {
 public:
  // Both must outlive this.
  Interference(const DiagramGraph& graph, const DiagramScope& scope) : graph_(graph), scope_(scope) {}

  // Whether its evaluation changes anything but its own outputs.
  bool has_effect(const graphic::Element& element) const;
  // Whether `effect` may change the text of the variable or contact `reader`.
  bool changes(const graphic::Element& effect, const graphic::Element& reader);
  // Whether the text of a variable calls a function.
  bool calls(const graphic::Element& reader) { return reads(reader).calls; }

 private:
  // Names that a text reads or an element writes.
  struct Names {
    std::set<std::string> own;  // variables of the POU, in upper case
    bool is_open = false;       // and others, that can be reached from elsewhere
    bool is_any = false;        // and whatever a reference leads to
    bool calls = false;
  };

  const Names& reads(const graphic::Element& element);
  const Names& writes(const graphic::Element& element);
  void add_text(Names& names, const std::string& text, bool whole);

  const DiagramGraph& graph_;
  const DiagramScope& scope_;
  syntax::PieceReader reader_;
  std::map<const graphic::Element*, Names> reads_;
  std::map<const graphic::Element*, Names> writes_;
};

}  // namespace stepwright::lowering
