#pragma once

// The networks of a diagram: which elements belong together, and in which order they are evaluated. Internal
// to this folder.
//
// A network is what hangs together when the power rails are taken away. Networks run from top to bottom.
// Inside, what does something (coils, blocks, variables that are written, jumps) runs from top to bottom and
// left to right, each after what its inputs come from (evaluation_order.h); an execution order that the file
// gives goes first (IEC 61131-3, 8.1.4 to 8.1.6).

#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include "ladder/graphic/diagram.h"
#include "ladder/lowering/diagram_scope.h"

namespace stepwright::lowering {

struct Network {
  std::vector<const graphic::Element*> elements;
  std::vector<const graphic::Element*> doers;  // in the order of evaluation as drawn
  std::vector<std::string> labels;
  std::string comment;
  double top = 0;
  double left = 0;
  double bottom = 0;
};

// An output of an element.
struct Origin {
  const graphic::Element* element = nullptr;
  std::string output;  // of a block: its name
};

class DiagramGraph {
 public:
  // Reports connections to nothing and connectors without a partner (E0803), and what hangs on nothing
  // (W0021). The diagram must outlive this.
  DiagramGraph(const graphic::Diagram& diagram, DiagramScope& scope);

  const std::vector<Network>& networks() const { return networks_; }
  // Origin of a connection, followed through connectors; no element if there is none.
  Origin from(const graphic::Connection& connection) const;
  // Elements that read this output, once for each input.
  const std::vector<const graphic::Element*>& readers_of(const Origin& origin) const;
  // True for elements that may depend on themselves.
  bool in_circle(const graphic::Element& element) const { return circles_.count(&element) != 0; }
  // Numbers in the order given by the file take part in the order of evaluation.
  bool has_order() const { return has_order_; }

 private:
  void index();
  void join();
  void add_notes();
  void tell_loose_ends() const;
  std::set<const graphic::Element*> find_circles() const;
  // The output that a connection without a name means: the first one that is not ENO.
  static std::string output_name(const graphic::Element& element, const std::string& wanted);
  std::size_t root_of(std::size_t element) const;
  void connect(std::size_t element, const graphic::Pin& pin);
  template <typename Visit>
  void for_each_input(const graphic::Element& element, Visit visit) const;

  const graphic::Diagram& diagram_;
  DiagramScope& scope_;
  std::unordered_map<std::uint64_t, std::size_t> index_;
  std::map<std::string, const graphic::Element*> connectors_;  // upper case
  mutable std::vector<std::size_t> parents_;                   // union-find
  std::map<std::pair<const graphic::Element*, std::string>, std::vector<const graphic::Element*>> readers_;
  std::set<const graphic::Element*> read_;  // whose output leads somewhere
  std::set<const graphic::Element*> circles_;
  std::vector<Network> networks_;
  bool has_order_ = false;
};

bool does_something(const graphic::Element& element);

// "coil 'lamp'", "block TON 'delay'"
std::string title_of(const graphic::Element& element);

}  // namespace stepwright::lowering
