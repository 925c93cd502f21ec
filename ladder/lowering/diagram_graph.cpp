#include "ladder/lowering/diagram_graph.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <tuple>

#include "ladder/graphic/identifier.h"
#include "ladder/source/codes.h"

namespace stepwright::lowering {
namespace {

using graphic::Connection;
using graphic::Element;
using graphic::ElementKind;
using graphic::Pin;

bool in_networks(const Element& element) {
  switch (element.kind) {
    case ElementKind::Block:
    case ElementKind::InVariable:
    case ElementKind::OutVariable:
    case ElementKind::InOutVariable:
    case ElementKind::Jump:
    case ElementKind::Return:
    case ElementKind::Coil:
    case ElementKind::Contact:
    case ElementKind::Connector:
    case ElementKind::Continuation:
      return true;
    default:
      return false;
  }
}

std::uint64_t order_of(const Element& element) {
  const std::uint64_t order = element.order.value_or(0);
  return order == 0 ? std::numeric_limits<std::uint64_t>::max() : order;
}

bool before(const Element* a, const Element* b) {
  return std::tuple(order_of(*a), a->position.y, a->position.x, a->id) <
         std::tuple(order_of(*b), b->position.y, b->position.x, b->id);
}

}  // namespace

std::string title_of(const Element& element) {
  std::string title = graphic::to_string(element.kind);
  if (element.kind == ElementKind::Comment || element.kind == ElementKind::Error) return title;
  if (element.kind == ElementKind::Block) {
    title += " " + element.name.text;
    return element.instance.empty() ? title : title + " '" + element.instance + "'";
  }
  std::string name = element.name.text.substr(0, 40);
  std::replace(name.begin(), name.end(), '\n', ' ');
  return name.empty() ? title : title + " '" + name + "'";
}

bool does_something(const Element& element) {
  switch (element.kind) {
    case ElementKind::Block:
    case ElementKind::OutVariable:
    case ElementKind::Jump:
    case ElementKind::Return:
    case ElementKind::Coil:
      return true;
    case ElementKind::InOutVariable:
      return !element.inputs.empty() && !element.inputs.front().connections.empty();
    default:
      return false;
  }
}

DiagramGraph::DiagramGraph(const graphic::Diagram& diagram, DiagramScope& scope)
    : diagram_(diagram), scope_(scope) {
  for (const Element& element : diagram.elements) scope.note(element.where, title_of(element));
  index();
  join();
  for (std::size_t i = 0; i < networks_.size(); ++i)
    for (const Element* each : networks_[i].elements)
      scope.note(each->where, "network " + std::to_string(i + 1) + ", " + title_of(*each));
  add_notes();
  tell_loose_ends();
  circles_ = find_circles();
}

template <typename Visit>
void DiagramGraph::for_each_input(const Element& element, Visit visit) const {
  for (const Pin& pin : element.inputs) visit(pin);
  for (const Pin& pin : element.in_outs) visit(pin);
  if (element.kind == ElementKind::Transition) visit(element.condition.input);
}

void DiagramGraph::index() {
  for (std::size_t i = 0; i < diagram_.elements.size(); ++i) {
    const Element& element = diagram_.elements[i];
    if (!index_.emplace(element.id, i).second)
      scope_.error(source::code::kBadDiagram, element.where,
                   "the localId " + std::to_string(element.id) + " is used twice",
                   "every element of a body has a number of its own");
    if (element.kind == ElementKind::Connector) connectors_[graphic::upper(element.name.text)] = &element;
  }
}

Origin DiagramGraph::from(const Connection& connection) const {
  const Connection* at = &connection;
  // A chain of connectors ends, or goes in a circle.
  for (std::size_t hops = 0; hops <= connectors_.size(); ++hops) {
    const auto found = index_.find(at->from);
    if (found == index_.end()) return {};
    const Element* source = &diagram_.elements[found->second];
    if (source->kind == ElementKind::Continuation) {
      const auto connector = connectors_.find(graphic::upper(source->name.text));
      if (connector == connectors_.end()) return {};
      source = connector->second;
    }
    if (source->kind != ElementKind::Connector) return {source, output_name(*source, at->output)};
    if (source->inputs.empty() || source->inputs.front().connections.size() != 1) return {};
    at = &source->inputs.front().connections.front();
  }
  return {};
}

std::string DiagramGraph::output_name(const Element& element, const std::string& wanted) {
  if (element.kind != ElementKind::Block || !wanted.empty()) return wanted;
  for (const Pin& pin : element.outputs)
    if (!graphic::same_name(pin.name, "ENO")) return pin.name;
  return {};
}

std::size_t DiagramGraph::root_of(std::size_t element) const {
  while (parents_[element] != element) element = parents_[element] = parents_[parents_[element]];
  return element;
}

void DiagramGraph::connect(std::size_t element, const Pin& pin) {
  const Element& consumer = diagram_.elements[element];
  for (const Connection& connection : pin.connections) {
    const auto found = index_.find(connection.from);
    const Origin origin = from(connection);
    if (found == index_.end()) {
      scope_.error(source::code::kBadDiagram, consumer.where,
                   std::string("an input of this ") + graphic::to_string(consumer.kind) +
                       " is connected to element " + std::to_string(connection.from) +
                       ", which is not there");
      continue;
    }
    if (origin.element == nullptr) {
      const Element& near = diagram_.elements[found->second];
      scope_.error(source::code::kBadDiagram, near.where,
                   "connector '" + near.name.text + "' has no partner, or none that is connected",
                   "a connector and its continuations have the same name");
      continue;
    }
    read_.insert(origin.element);
    if (in_networks(consumer) && in_networks(*origin.element))
      parents_[root_of(element)] = root_of(index_.at(origin.element->id));
    if (consumer.kind == ElementKind::RightPowerRail || consumer.kind == ElementKind::Connector) continue;
    readers_[{origin.element, origin.output}].push_back(&consumer);
  }
}

void DiagramGraph::join() {
  parents_.resize(diagram_.elements.size());
  std::iota(parents_.begin(), parents_.end(), std::size_t{0});
  for (std::size_t i = 0; i < diagram_.elements.size(); ++i)
    for_each_input(diagram_.elements[i], [&](const Pin& pin) { connect(i, pin); });
  std::size_t ordered = diagram_.elements.size();
  std::map<std::size_t, Network> networks;
  for (std::size_t i = 0; i < diagram_.elements.size(); ++i) {
    // Numbers go before places, so all that are numbered run as one network.
    if (!does_something(diagram_.elements[i]) || diagram_.elements[i].order.value_or(0) == 0) continue;
    has_order_ = true;
    if (ordered == diagram_.elements.size()) ordered = i;
    parents_[root_of(i)] = root_of(ordered);
  }
  for (std::size_t i = 0; i < diagram_.elements.size(); ++i) {
    const Element& element = diagram_.elements[i];
    if (!in_networks(element)) continue;
    const auto [found, added] = networks.try_emplace(root_of(i));
    Network& network = found->second;
    const double bottom = element.position.y + element.height.value_or(0);
    if (added || element.position.y < network.top) network.top = element.position.y;
    if (added || element.position.x < network.left) network.left = element.position.x;
    if (added || bottom > network.bottom) network.bottom = bottom;
    network.elements.push_back(&element);
    if (does_something(element)) network.doers.push_back(&element);
  }
  for (auto& [root, network] : networks) {
    std::sort(network.doers.begin(), network.doers.end(), before);
    networks_.push_back(std::move(network));
  }
  std::stable_sort(networks_.begin(), networks_.end(), [](const Network& a, const Network& b) {
    return std::tuple(a.top, a.left) < std::tuple(b.top, b.left);
  });
}

// Labels and comments belong to the first network that is not wholly above them.
void DiagramGraph::add_notes() {
  std::vector<const Element*> notes;
  for (const Element& element : diagram_.elements)
    if (element.kind == ElementKind::Label || element.kind == ElementKind::Comment) notes.push_back(&element);
  std::sort(notes.begin(), notes.end(), before);
  const std::size_t drawn = networks_.size();
  for (const Element* note : notes) {
    std::size_t at = 0;
    while (at < drawn && networks_[at].bottom < note->position.y) ++at;
    const bool label = note->kind == ElementKind::Label;
    if (at == drawn && !label) continue;
    if (at == networks_.size()) networks_.emplace_back();
    if (label) {
      networks_[at].labels.push_back(note->name.text);
    } else {
      networks_[at].comment += (networks_[at].comment.empty() ? "" : " ") + note->name.text;
    }
  }
}

// They are legal, and hardly meant: an editor leaves them behind when a wire is deleted.
void DiagramGraph::tell_loose_ends() const {
  for (const Element& element : diagram_.elements) {
    const bool link = element.kind == ElementKind::Contact || element.kind == ElementKind::Coil;
    if (!link && element.kind != ElementKind::OutVariable) continue;
    const Pin* const input = element.inputs.empty() ? nullptr : &element.inputs.front();
    const bool fed = input != nullptr && (!input->connections.empty() || !input->expression.text.empty());
    if (!fed)
      scope_.warning(source::code::kLooseEnd, element.where,
                     std::string("no wire leads to it: it ") + (link ? "never has power" : "is not written"),
                     "connect its left side, or delete it");
    if (element.kind == ElementKind::Contact && !read_.contains(&element))
      scope_.warning(source::code::kLooseEnd, element.where, "no wire leads on from it: it does nothing",
                     "connect its right side, or delete it");
  }
}

const std::vector<const Element*>& DiagramGraph::readers_of(const Origin& origin) const {
  static const std::vector<const Element*> none;
  const auto found = readers_.find({origin.element, origin.output});
  return found == readers_.end() ? none : found->second;
}

// Takes away what has no inputs left, then what has no readers left: the circles stay, and what lies between
// two of them.
std::set<const Element*> DiagramGraph::find_circles() const {
  std::set<const Element*> circles;
  std::map<const Element*, std::vector<const Element*>> forward;
  std::map<const Element*, std::vector<const Element*>> backward;
  for (const auto& [origin, readers] : readers_) {
    for (const Element* reader : readers) {
      forward[origin.first].push_back(reader);
      backward[reader].push_back(origin.first);
    }
  }
  for (const Element& element : diagram_.elements) circles.insert(&element);
  const auto peel = [&circles](const auto& in, const auto& out) {
    std::map<const Element*, std::size_t> left;
    std::vector<const Element*> free;
    for (const Element* element : circles) {
      const auto found = in.find(element);
      std::size_t count = 0;
      if (found != in.end())
        for (const Element* other : found->second) count += circles.count(other);
      left[element] = count;
      if (count == 0) free.push_back(element);
    }
    while (!free.empty()) {
      const Element* element = free.back();
      free.pop_back();
      circles.erase(element);
      const auto found = out.find(element);
      if (found == out.end()) continue;
      for (const Element* other : found->second)
        if (circles.count(other) != 0 && --left[other] == 0) free.push_back(other);
    }
  };
  peel(backward, forward);
  peel(forward, backward);
  return circles;
}

}  // namespace stepwright::lowering
