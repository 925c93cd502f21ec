#pragma once

// In which order the elements of a diagram are evaluated. Internal to this folder; one object per diagram.
//
// Every element is evaluated once in an evaluation of its network, after what its inputs come from, so a link
// has one state. What does something follows as drawn (diagram_graph.h), the variables at the outputs of a
// block with it. A loop has no first element of its
// own: the leftmost one, of these the topmost, is evaluated first and reads what the last evaluation left at
// its inputs (IEC 61131-3, 8.3.3). Variables and blocks that the file numbers keep their own time.
//
// A value that is read where it is used needs no wire. It is held in one if several read it, or if something
// that may change it is evaluated in between.

#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "ladder/lowering/diagram_graph.h"
#include "ladder/lowering/interference.h"

namespace stepwright::lowering {

class EvaluationOrder {
 public:
  // One element, or the coils that are driven together.
  using Turn = std::vector<const graphic::Element*>;

  // Both must outlive this.
  EvaluationOrder(const DiagramGraph& graph, DiagramScope& scope);

  // The elements to evaluate now: all that have an effect in the network, and those that they need. No
  // element has two turns.
  std::vector<Turn> turns_of(const Network& network);
  // The same of what this input of an element outside of the networks needs.
  std::vector<Turn> turns_before(const graphic::Pin& pin, const graphic::Element& owner);

  // These answer for what had its turn.
  bool is_held(const graphic::Element& element) const { return held_.count(&element) != 0; }
  // A function that stands where it is read.
  bool is_inline(const graphic::Element& block) const { return inline_.count(&block) != 0; }
  // Read before it is evaluated: its readers see the value of the last evaluation.
  bool is_read_back(const graphic::Element& element) const { return read_back_.count(&element) != 0; }
  // Whether the block may write the variable itself: nothing between their turns could tell.
  bool writes_at_once(const graphic::Element& block, const graphic::Element& variable);

  // The loops of a network, for a reader: who goes first and what it reads; empty if there is none.
  std::string feedback_of(const Network& network) const;

 private:
  void cut_loops();
  void cut_loop(const graphic::Element& first, const std::set<const graphic::Element*>& left);
  void visit(const graphic::Element& element, int depth);
  void visit_outputs(const graphic::Element& block, int depth);
  void visit_input(const graphic::Pin& pin, const graphic::Element& reader, int depth);
  void note_reading_back(const graphic::Element& reader);
  bool has_own_time(const graphic::Element& element) const;
  bool is_power_circle(const graphic::Element& element) const;

  std::vector<Turn> finish(std::size_t first);
  std::vector<Turn> group(std::size_t first);
  void decide(const graphic::Element& element);
  bool reads_value(const graphic::Element& reader, const graphic::Element& element) const;
  std::size_t last_use(const graphic::Element& element) const;
  std::size_t readers_of(const graphic::Element& element) const;
  bool is_changed_before(const graphic::Element& element, std::size_t use);
  bool can_be_inline(const graphic::Element& block, std::size_t use) const;
  bool is_called_before(const graphic::Element& block, std::size_t use) const;
  template <typename Visit>
  void for_each_reader(const graphic::Element& element, Visit visit) const;

  const DiagramGraph& graph_;
  DiagramScope& scope_;
  Interference interference_;
  std::set<std::pair<const graphic::Element*, const graphic::Element*>> cuts_;  // from, to who goes first
  // Who goes first in the loops around an element, the outermost loop first.
  std::map<const graphic::Element*, std::vector<const graphic::Element*>> leaders_;
  std::set<const graphic::Element*> doers_;
  std::set<const graphic::Element*> visited_;
  std::vector<const graphic::Element*> order_;
  std::map<const graphic::Element*, std::size_t> place_;  // in `order_`
  std::map<const graphic::Element*, std::size_t> used_;   // when it is really evaluated
  std::map<const graphic::Element*, std::size_t> group_;  // coils: place of the first of them
  std::set<const graphic::Element*> held_;
  std::set<const graphic::Element*> inline_;
  std::set<const graphic::Element*> read_back_;
};

// Whether a coil inverts its power and does more: the power goes through a wire of its own.
bool inverts_power(const graphic::Modifier& modifier);

}  // namespace stepwright::lowering
