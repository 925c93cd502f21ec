#pragma once

// Networks of a diagram as rungs. Internal to this folder; one object per diagram.

#include <map>
#include <set>
#include <string>
#include <utility>

#include "ladder/graphic/ladder_program.h"
#include "ladder/lowering/diagram_graph.h"
#include "ladder/lowering/evaluation_order.h"
#include "ladder/syntax/piece.h"

namespace stepwright::lowering {

class NetworkLowering {
 public:
  // All must outlive this.
  NetworkLowering(const DiagramGraph& graph, DiagramScope& scope)
      : graph_(graph), scope_(scope), order_(graph, scope) {}

  // Appends the rungs of everything that does something in the network.
  void lower(const Network& network);
  // Everything that `pin` needs is evaluated; the result is the power there.
  graphic::Condition evaluate(const graphic::Pin& pin, const graphic::Element& owner);

  // The value for a coil or variable without a declaration: the result of a network.
  graphic::Condition evaluate_output(const graphic::Element& element);

  graphic::LadderProgram take() { return std::move(ladder_); }

 private:
  void run(const EvaluationOrder::Turn& turn);
  void coils(const std::vector<const graphic::Element*>& group);
  void assignment(const graphic::Element& element);
  void jump(const graphic::Element& element);
  void block(const graphic::Element& element);
  void call_inputs(const graphic::Element& element, graphic::Rung& rung, graphic::Block& block);
  void call_outputs(const graphic::Element& element, graphic::Block& block);
  bool asks_enabled(const graphic::Element& element) const;
  void hold_outputs(const graphic::Element& element);
  // The variable that the call writes itself: the only reader of this output. Null if there is none.
  const graphic::Element* written_by_call(const Origin& origin);
  void check_block(const graphic::Element& element);

  // The value of an input, now.
  graphic::Condition power(const graphic::Pin& pin, const graphic::Element& owner);
  graphic::Condition read(const Origin& origin, const graphic::Element& owner);
  graphic::Condition read_once(const Origin& origin, const graphic::Element& owner);
  graphic::Condition contact(const graphic::Element& element, const graphic::Element& owner);
  // The variable that a VAR_IN_OUT is connected to.
  graphic::Condition variable(const graphic::Pin& pin, const graphic::Element& owner);
  graphic::Condition block_output(const Origin& origin, const graphic::Element& owner);
  std::string argument(const graphic::Pin& pin, const graphic::Element& owner);
  std::string inline_call(const graphic::Element& element);

  // Wires.
  graphic::Condition through_wire(graphic::Condition condition, const graphic::Element& element);
  // A condition without edges, for text: ST has no expression for them, so a wire is computed before it.
  graphic::Condition without_edges(graphic::Condition condition, const graphic::Element& element);
  std::string result_wire(const Origin& origin);
  // The power behind a contact or coil, for everything that reads it.
  graphic::Condition link(graphic::Condition power, const graphic::Element& element);
  std::string kept_link(const graphic::Element& element);
  // A value as it is now, for everything that reads it.
  void hold(const Origin& origin, const graphic::Condition& value);
  bool is_power(const graphic::Pin& pin) const;

  graphic::Rung& add(const graphic::Element& element, graphic::Condition condition);
  // A text of the diagram with its mark; falls back to the mark of the element that it stands in. What is not
  // whole is reported.
  std::string marked(const graphic::SourceText& text, syntax::PieceKind kind, const graphic::Element& element,
                     const graphic::Element& owner);
  // The same for an expression beside an operator: in parentheses unless it is an operand.
  std::string operand(const graphic::Element& element, const graphic::Element& owner);
  // A name that goes into a text together with others; reported if it is none.
  std::string named(const std::string& text, syntax::PieceKind kind, const graphic::Element& element);
  bool is_whole(const graphic::SourceText& text, const syntax::Piece& piece, const graphic::Element& element);

  const DiagramGraph& graph_;
  DiagramScope& scope_;
  syntax::PieceReader reader_;
  graphic::LadderProgram ladder_;
  EvaluationOrder order_;
  std::set<const graphic::Element*> written_;  // variables that a call has written
  std::set<const graphic::Element*> reading_;
  std::map<std::pair<const graphic::Element*, std::string>, std::string> wires_;
  std::map<const graphic::Element*, graphic::Condition> enables_;  // power at EN of blocks that ran
  std::set<std::string> checked_;
};

}  // namespace stepwright::lowering
