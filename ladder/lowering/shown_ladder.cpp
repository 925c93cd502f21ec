#include "ladder/lowering/shown_ladder.h"

#include <map>
#include <set>
#include <utility>

#include "ladder/lowering/text_names.h"

namespace stepwright::lowering {

namespace {

using graphic::Block;
using graphic::Coil;
using graphic::CoilKind;
using graphic::Condition;
using graphic::ConditionKind;
using graphic::Edge;
using graphic::LadderProgram;
using graphic::Rung;

// Calls `contact(condition)` for each contact and `text(string)` for each other text of a rung.
template <typename Contact, typename Text>
void visit(Condition& condition, const Contact& contact, const Text& text) {
  if (condition.kind == ConditionKind::Contact) {
    contact(condition);
  } else {
    text(condition.name);
    text(condition.operand);
  }
  for (Condition& each : condition.children) visit(each, contact, text);
}

template <typename Text>
void visit(Block& block, const Text& text) {
  for (auto& [formal, argument] : block.inputs) text(argument);
  for (auto& [formal, variable] : block.outputs) text(variable);
  text(block.st_body);
}

class Shown {
 public:
  explicit Shown(LadderProgram ladder) : ladder_(std::move(ladder)) {
    for (const graphic::Wire& each : ladder_.wires)
      if (!each.keeps) once_.insert(each.name);
    for (const graphic::Wire& each : ladder_.wires) wires_.insert(each.name);
    count_reads();
  }

  LadderProgram run() {
    std::vector<Rung> shown;
    for (std::size_t i = 0; i < ladder_.rungs.size(); ++i) {
      Rung& rung = ladder_.rungs[i];
      rung.condition = drawn(std::move(rung.condition));
      if (!is_line(i)) {
        shown.push_back(std::move(rung));
        continue;
      }
      lines_[rung.coils.front().variable] = std::move(rung.condition);
      // The network begins with what is left of it.
      if (!rung.goes_on) {
        Rung& next = ladder_.rungs[i + 1];
        next.goes_on = false;
        next.comment = std::move(rung.comment);
        next.label = std::move(rung.label);
      }
    }
    for (Rung& each : shown) connect(each);
    return {std::move(shown)};
  }

 private:
  struct Reads {
    std::size_t contacts = 0;
    std::size_t others = 0;  // in texts, or of an edge
    bool negated = false;
  };

  void count_reads() {
    const auto in_text = [&](std::string& text) {
      each_name(text, [&](const std::string& name) {
        ++reads_[name].others;
        return name;
      });
    };
    const auto in_contact = [&](const Condition& contact) {
      Reads& reads = reads_[contact.name];
      ++(contact.edge == Edge::None ? reads.contacts : reads.others);
      reads.negated = reads.negated || contact.negated;
    };
    for (Rung& rung : ladder_.rungs) {
      visit(rung.condition, in_contact, in_text);
      for (Block& each : rung.blocks) visit(each, in_text);
    }
  }

  // The rung computes a wire that one contact of its network reads, and nothing else.
  bool is_line(std::size_t index) const {
    const Rung& rung = ladder_.rungs[index];
    const bool plain = rung.coils.size() == 1 && rung.coils.front().kind == CoilKind::Normal &&
                       rung.blocks.empty() && rung.jump_to.empty() && !rung.is_return;
    const bool continued = index + 1 < ladder_.rungs.size() && ladder_.rungs[index + 1].goes_on;
    if (!plain || !continued || !once_.contains(rung.coils.front().variable)) return false;
    const auto found = reads_.find(rung.coils.front().variable);
    if (found == reads_.end() || found->second.contacts != 1 || found->second.others != 0) return false;
    return !(found->second.negated && graphic::senses_edge(rung.condition));
  }

  Condition drawn(Condition condition) const {
    if (condition.kind == ConditionKind::Contact) {
      const auto line = lines_.find(condition.name);
      if (line == lines_.end()) return condition;
      return condition.negated ? graphic::negation(line->second) : line->second;
    }
    for (Condition& each : condition.children) each = drawn(std::move(each));
    if (condition.kind == ConditionKind::All) return graphic::all(std::move(condition.children));
    if (condition.kind == ConditionKind::Any) return graphic::any(std::move(condition.children));
    return condition;
  }

  std::string connector(const std::string& name) {
    if (!wires_.contains(name)) return name;
    const auto number = connectors_.try_emplace(name, connectors_.size() + 1).first->second;
    return connector_name(number);
  }

  // What is left of the wires.
  void connect(Rung& rung) {
    const auto text = [&](std::string& each) {
      each = each_name(each, [&](const std::string& name) { return connector(name); });
    };
    visit(
        rung.condition, [&](Condition& contact) { text(contact.name); }, text);
    for (Block& each : rung.blocks) visit(each, text);
    for (Coil& each : rung.coils) text(each.variable);
  }

  LadderProgram ladder_;
  std::set<std::string> wires_;
  std::set<std::string> once_;  // wires that are computed before they are read
  std::map<std::string, Reads> reads_;
  std::map<std::string, Condition> lines_;
  std::map<std::string, std::size_t> connectors_;
};

}  // namespace

LadderProgram shown_ladder(LadderProgram ladder) {
  return Shown(std::move(ladder)).run();
}

}  // namespace stepwright::lowering
