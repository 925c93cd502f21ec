#include "ladder/lowering/evaluation_order.h"

#include <algorithm>
#include <limits>
#include <tuple>

#include "ladder/graphic/identifier.h"
#include "ladder/lowering/block_pins.h"
#include "ladder/source/codes.h"

namespace stepwright::lowering {

using graphic::Connection;
using graphic::Element;
using graphic::ElementKind;
using graphic::Pin;

namespace {

constexpr int kMaxDepth = 1000;
constexpr std::size_t kNever = std::numeric_limits<std::size_t>::max();

bool is_link(const Element& element) {
  return element.kind == ElementKind::Contact || element.kind == ElementKind::Coil;
}

bool is_evaluated(const Element& element) {
  return is_link(element) || element.kind == ElementKind::Block || element.kind == ElementKind::InVariable ||
         element.kind == ElementKind::InOutVariable;
}

const Pin& input_of(const Element& element) {
  static const Pin none;
  return element.inputs.empty() ? none : element.inputs.front();
}

bool same_sources(const Pin& a, const Pin& b) {
  return std::equal(
      a.connections.begin(), a.connections.end(), b.connections.begin(), b.connections.end(),
      [](const Connection& x, const Connection& y) { return x.from == y.from && x.output == y.output; });
}

}  // namespace

bool inverts_power(const graphic::Modifier& modifier) {
  return modifier.negated &&
         (modifier.storage != graphic::Storage::None || modifier.edge != graphic::Edge::None);
}

EvaluationOrder::EvaluationOrder(const DiagramGraph& graph, DiagramScope& scope)
    : graph_(graph), scope_(scope), interference_(graph, scope) {
  cut_loops();
}

bool EvaluationOrder::has_own_time(const Element& element) const {
  return graph_.has_order() && does_something(element) && element.order.value_or(0) != 0;
}

template <typename Visit>
void EvaluationOrder::for_each_reader(const Element& element, Visit visit) const {
  const auto all = [&](const std::string& output) {
    for (const Element* reader : graph_.readers_of({&element, output})) visit(*reader);
  };
  if (element.kind != ElementKind::Block) all({});
  if (element.kind != ElementKind::Block) return;
  for (const Pin& pin : element.outputs) all(pin.name);
  for (const Pin& pin : element.in_outs) all(pin.name);
}

// The leftmost element of a loop goes first: what leads back to it is cut. Then it belongs to no loop, and
// the loops that are left follow. A variable that is read and written ends a loop, and so do numbers.
void EvaluationOrder::cut_loops() {
  std::vector<const Element*> elements;
  for (const Network& network : graph_.networks())
    for (const Element* each : network.elements)
      if (graph_.in_circle(*each) && is_evaluated(*each) && each->kind != ElementKind::InOutVariable &&
          !has_own_time(*each))
        elements.push_back(each);
  std::sort(elements.begin(), elements.end(), [](const Element* a, const Element* b) {
    return std::tuple(a->position.x, a->position.y, a->id) < std::tuple(b->position.x, b->position.y, b->id);
  });
  std::set<const Element*> left(elements.begin(), elements.end());
  for (const Element* first : elements) {
    cut_loop(*first, left);
    left.erase(first);
  }
}

// The loop through `first`, of the elements that are left.
void EvaluationOrder::cut_loop(const Element& first, const std::set<const Element*>& left) {
  std::map<const Element*, std::vector<const Element*>> sources;  // of what `first` leads to
  std::vector<const Element*> open{&first};
  while (!open.empty()) {
    const Element* at = open.back();
    open.pop_back();
    for_each_reader(*at, [&](const Element& reader) {
      if (left.count(&reader) == 0) return;
      std::vector<const Element*>& known = sources[&reader];
      if (known.empty() && &reader != &first) open.push_back(&reader);
      known.push_back(at);
    });
  }
  for (const Element* each : sources[&first]) cuts_.insert({each, &first});
  std::set<const Element*> loop;
  open = sources[&first];
  while (!open.empty()) {
    const Element* at = open.back();
    open.pop_back();
    if (at == &first || !loop.insert(at).second) continue;
    leaders_[at].push_back(&first);
    open.insert(open.end(), sources[at].begin(), sources[at].end());
  }
}

void EvaluationOrder::visit_input(const Pin& pin, const Element& reader, int depth) {
  for (const Connection& connection : pin.connections) {
    const Element* source = graph_.from(connection).element;
    if (source == nullptr || !is_evaluated(*source) || cuts_.count({source, &reader}) != 0) continue;
    // Inside of a circle a variable is read as it is: it is written at its own place.
    const bool is_feedback =
        source->kind == ElementKind::InOutVariable && graph_.in_circle(*source) && graph_.in_circle(reader);
    if (is_feedback) continue;
    if (!has_own_time(*source)) {
      visit(*source, depth + 1);
    } else if (source->kind == ElementKind::Coil && depth < kMaxDepth) {
      visit_input(input_of(*source), *source, depth + 1);
    }
  }
}

void EvaluationOrder::visit(const Element& element, int depth) {
  if (visited_.count(&element) != 0) return;
  if (depth > kMaxDepth) {
    if (element.kind == ElementKind::Block)
      scope_.error(source::code::kTooDeep, element.where, "blocks are connected in too long a chain",
                   "split the network with a variable");
    return;
  }
  visited_.insert(&element);
  if (const auto leaders = leaders_.find(&element); leaders != leaders_.end())
    for (const Element* first : leaders->second) visit(*first, depth);
  for (const Pin& pin : element.inputs) visit_input(pin, element, depth);
  for (const Pin& pin : element.in_outs) visit_input(pin, element, depth);
  note_reading_back(element);
  place_[&element] = order_.size();
  order_.push_back(&element);
  if (element.kind == ElementKind::Block) visit_outputs(element, depth);
}

// The variables at the outputs of a block are written with it: no element is complete before its outputs are.
void EvaluationOrder::visit_outputs(const Element& block, int depth) {
  for_each_reader(block, [&](const Element& reader) {
    const bool is_own = reader.kind == ElementKind::OutVariable && reader.inputs.size() == 1 &&
                        reader.inputs.front().connections.size() == 1;
    if (is_own && !has_own_time(reader) && doers_.count(&reader) != 0) visit(reader, depth);
  });
}

void EvaluationOrder::note_reading_back(const Element& reader) {
  const auto note = [&](const Pin& pin) {
    for (const Connection& connection : pin.connections) {
      const Element* source = graph_.from(connection).element;
      if (source == nullptr || place_.count(source) != 0) continue;
      const bool link = is_link(*source) && cuts_.count({source, &reader}) != 0 && !is_power_circle(*source);
      if (source->kind == ElementKind::Block || link) read_back_.insert(source);
    }
  };
  for (const Pin& pin : reader.inputs) note(pin);
  for (const Pin& pin : reader.in_outs) note(pin);
}

// Contacts and coils alone compute nothing that could be kept: such a circle is a mistake of the drawing.
bool EvaluationOrder::is_power_circle(const Element& element) const {
  std::set<const Element*> seen;
  std::vector<const Element*> open{&element};
  while (!open.empty()) {
    const Element* at = open.back();
    open.pop_back();
    for_each_reader(*at, [&](const Element& reader) {
      if (is_link(reader) && seen.insert(&reader).second) open.push_back(&reader);
    });
  }
  return seen.count(&element) != 0;
}

std::vector<EvaluationOrder::Turn> EvaluationOrder::turns_of(const Network& network) {
  const std::size_t first = order_.size();
  doers_.insert(network.doers.begin(), network.doers.end());
  for (const Element* doer : network.doers) visit(*doer, 0);
  return finish(first);
}

std::vector<EvaluationOrder::Turn> EvaluationOrder::turns_before(const Pin& pin, const Element& owner) {
  const std::size_t first = order_.size();
  visit_input(pin, owner, 0);
  return finish(first);
}

std::vector<EvaluationOrder::Turn> EvaluationOrder::finish(std::size_t first) {
  std::vector<Turn> turns = group(first);
  // From the end: when a value is used depends on its readers.
  for (std::size_t i = order_.size(); i > first; --i) decide(*order_[i - 1]);
  return turns;
}

// Coils one behind the other with the same power are driven together.
std::vector<EvaluationOrder::Turn> EvaluationOrder::group(std::size_t first) {
  std::vector<Turn> turns;
  for (std::size_t i = first; i < order_.size(); ++i) {
    const Element& element = *order_[i];
    const bool joins = element.kind == ElementKind::Coil && !turns.empty() &&
                       turns.back().front()->kind == ElementKind::Coil &&
                       same_sources(input_of(element), input_of(*turns.back().front())) &&
                       !inverts_power(element.modifier) && !inverts_power(turns.back().front()->modifier);
    if (!joins) turns.emplace_back();
    turns.back().push_back(&element);
    if (element.kind == ElementKind::Coil) group_[&element] = place_.at(turns.back().front());
  }
  return turns;
}

void EvaluationOrder::decide(const Element& element) {
  const std::size_t place = place_.at(&element);
  const std::size_t use = last_use(element);
  bool is_at_use = false;
  if (element.kind == ElementKind::Contact) {
    if (readers_of(element) > 1 || is_read_back(element) || is_changed_before(element, use))
      held_.insert(&element);
    is_at_use = !is_held(element);
  } else if (element.kind == ElementKind::InVariable || element.kind == ElementKind::InOutVariable) {
    const bool is_called_twice = readers_of(element) > 1 && interference_.calls(element);
    if (is_called_twice || is_changed_before(element, use)) held_.insert(&element);
    is_at_use = !is_held(element) && !does_something(element);
  } else if (element.kind == ElementKind::Block) {
    if (can_be_inline(element, use)) inline_.insert(&element);
    if (is_called_before(element, use)) held_.insert(&element);
    is_at_use = is_inline(element);
  }
  used_[&element] = is_at_use ? use : place;
}

// Not so a VAR_IN_OUT, which is the variable itself.
bool EvaluationOrder::reads_value(const Element& reader, const Element& element) const {
  const auto leads = [&](const Connection& each) { return graph_.from(each).element == &element; };
  const auto is_read = [&](const Pin& pin) {
    return std::any_of(pin.connections.begin(), pin.connections.end(), leads);
  };
  return std::none_of(reader.in_outs.begin(), reader.in_outs.end(), is_read) ||
         std::any_of(reader.inputs.begin(), reader.inputs.end(), is_read);
}

// When the value is read for the last time.
std::size_t EvaluationOrder::last_use(const Element& element) const {
  const std::size_t place = place_.at(&element);
  std::size_t last = place;
  for_each_reader(element, [&](const Element& reader) {
    if (!reads_value(reader, element)) return;
    const auto placed = place_.find(&reader);
    if (placed == place_.end()) {
      const bool waits = reader.kind != ElementKind::Transition && is_evaluated(reader);
      last = std::max(last, waits ? kNever : order_.size());
      return;
    }
    if (placed->second <= place) return;  // it read the last evaluation
    const auto group = group_.find(&reader);
    last = std::max(last, group != group_.end() ? group->second : used_.at(&reader));
  });
  return last;
}

// Coils that are driven together count once.
std::size_t EvaluationOrder::readers_of(const Element& element) const {
  std::set<std::size_t> groups;
  std::size_t others = 0;
  for_each_reader(element, [&](const Element& reader) {
    const auto group = group_.find(&reader);
    if (group != group_.end()) groups.insert(group->second);
    if (group == group_.end()) ++others;
  });
  return groups.size() + others;
}

bool EvaluationOrder::is_changed_before(const Element& element, std::size_t use) {
  const std::size_t place = place_.at(&element);
  for (std::size_t i = place + 1; i < order_.size() && i < use; ++i) {
    const Element& other = *order_[i];
    if (interference_.has_effect(other) && used_.at(&other) < use && interference_.changes(other, element))
      return true;
  }
  return false;
}

// A function without EN whose only reader reads its result. One that a user wrote may do anything, so it
// keeps its turn if something else has one before it is read.
bool EvaluationOrder::can_be_inline(const Element& block, std::size_t use) const {
  if (!block.instance.empty() || enable_of(block) != nullptr || is_read_back(block)) return false;
  if (has_own_time(block) || !block.in_outs.empty()) return false;
  if (readers_of(block) != 1 || graph_.readers_of(result_of(block, scope_)).size() != 1) return false;
  if (!interference_.has_effect(block)) return true;
  for (std::size_t i = place_.at(&block) + 1; i < order_.size() && i < use; ++i) {
    const Element& other = *order_[i];
    if (used_.at(&other) < use && (interference_.has_effect(other) || is_held(other))) return false;
  }
  return true;
}

// The outputs of an instance that another block calls, too, are those of the last call.
bool EvaluationOrder::is_called_before(const Element& block, std::size_t use) const {
  if (block.instance.empty()) return false;
  for (std::size_t i = place_.at(&block) + 1; i < order_.size() && i < use; ++i)
    if (order_[i]->kind == ElementKind::Block && graphic::same_name(order_[i]->instance, block.instance))
      return true;
  return false;
}

bool EvaluationOrder::writes_at_once(const Element& block, const Element& variable) {
  const auto from = place_.find(&block);
  const auto to = place_.find(&variable);
  if (from == place_.end() || to == place_.end()) return false;
  for (std::size_t i = from->second + 1; i < to->second; ++i) {
    const Element& other = *order_[i];
    const bool is_other_output = other.kind == ElementKind::OutVariable && other.inputs.size() == 1 &&
                                 other.inputs.front().connections.size() == 1 &&
                                 graph_.from(other.inputs.front().connections.front()).element == &block;
    const bool is_still = !interference_.has_effect(other) &&
                          (other.kind == ElementKind::Block || !interference_.changes(variable, other));
    if (!is_other_output && !is_still) return false;
  }
  return true;
}

std::string EvaluationOrder::feedback_of(const Network& network) const {
  std::string text;
  for (const Element* first : network.elements) {
    std::string read;
    const auto add = [&](const Pin& pin) {
      for (const Connection& connection : pin.connections) {
        const Element* source = graph_.from(connection).element;
        if (cuts_.count({source, first}) != 0) read += (read.empty() ? "" : " and ") + title_of(*source);
      }
    };
    for (const Pin& pin : first->inputs) add(pin);
    for (const Pin& pin : first->in_outs) add(pin);
    if (read.empty()) continue;
    text += (text.empty() ? "" : " ") + std::string("Feedback: ") + title_of(*first) +
            " is evaluated first and reads the last value of " + read + ".";
  }
  return text;
}

}  // namespace stepwright::lowering
