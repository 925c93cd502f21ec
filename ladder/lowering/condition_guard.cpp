#include "ladder/lowering/condition_guard.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

#include "ladder/graphic/identifier.h"

namespace stepwright::lowering {
namespace {

using graphic::Condition;
using graphic::Edge;
using graphic::Rung;

bool in_word(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.' || c == '#' || c == '%';
}

bool is_operator(std::string_view word) {
  constexpr std::array<const char*, 4> words{"AND", "OR", "XOR", "NOT"};
  return std::any_of(words.begin(), words.end(),
                     [&](const char* each) { return graphic::same_name(std::string(word), each); });
}

// Steps through a text; whatever it does not know makes the text no plain one.
class PlainText {
 public:
  explicit PlainText(std::string_view text) : text_(text) {}

  bool is_plain() {
    while (skip_blanks(), at_ < text_.size()) {
      if (!token()) return false;
    }
    return true;
  }

 private:
  // Space, and the marks of places ("{@3:17}").
  void skip_blanks() {
    while (at_ < text_.size()) {
      if (text_[at_] == '{') {
        at_ = std::min(text_.find('}', at_), text_.size() - 1) + 1;
      } else if (std::isspace(static_cast<unsigned char>(text_[at_])) != 0) {
        ++at_;
      } else {
        return;
      }
    }
  }

  bool token() {
    const char c = text_[at_];
    if (in_word(c)) return word();
    ++at_;
    // A sign, but no arithmetic.
    if (c == '-' || c == '+') return !std::exchange(operand_, true);
    if (c == '(') return !std::exchange(operand_, false);
    operand_ = c == ')';
    return c == ')' || c == '=' || c == '<' || c == '>' || c == '&';
  }

  bool word() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && in_word(text_[at_])) ++at_;
    const std::string_view word = text_.substr(begin, at_ - begin);
    operand_ = !is_operator(word);
    return !graphic::same_name(std::string(word), "MOD");
  }

  std::string_view text_;
  std::size_t at_ = 0;
  bool operand_ = false;  // what stands before can be called, or take part in arithmetic
};

constexpr std::size_t kNone = static_cast<std::size_t>(-1);

}  // namespace

bool only_reads(std::string_view text) {
  return PlainText(text).is_plain();
}

bool only_reads(const Condition& condition) {
  return only_reads(std::string_view(condition.name)) && only_reads(std::string_view(condition.operand)) &&
         std::all_of(condition.children.begin(), condition.children.end(),
                     [](const Condition& child) { return only_reads(child); });
}

bool only_reads(const graphic::LadderProgram& ladder) {
  const auto is_wire = [&](const graphic::Coil& coil) {
    return std::any_of(ladder.wires.begin(), ladder.wires.end(), [&](const graphic::Wire& wire) {
      return graphic::same_name(wire.name, coil.variable);
    });
  };
  return std::all_of(ladder.rungs.begin(), ladder.rungs.end(), [&](const Rung& rung) {
    return rung.blocks.empty() && only_reads(rung.condition) &&
           std::all_of(rung.coils.begin(), rung.coils.end(), is_wire);
  });
}

ConditionGuard::ConditionGuard(SfcLoweringContext& context)
    : context_(context),
      networks_(context.chart().transitions.size(), kNone),
      has_run_(context.condition_networks().size(), false) {
  for (std::size_t i = 0; i < has_run_.size(); ++i)
    for (const std::size_t user : context.condition_networks()[i].transitions) networks_[user] = i;
}

const ConditionNetwork* ConditionGuard::network_of(std::size_t transition) const {
  const std::size_t network = networks_[transition];
  return network == kNone ? nullptr : &context_.condition_networks()[network];
}

bool ConditionGuard::guards(std::size_t transition) const {
  const ConditionNetwork* network = network_of(transition);
  const bool own = network != nullptr && network->transitions.size() == 1;
  return own || !only_reads(context_.chart().transitions[transition].condition);
}

void ConditionGuard::run_shared_network(std::size_t transition) {
  const ConditionNetwork* network = network_of(transition);
  if (network == nullptr || network->transitions.size() == 1 || has_run_[networks_[transition]]) return;
  has_run_[networks_[transition]] = true;
  std::vector<Condition> enabled;
  for (const std::size_t user : network->transitions) {
    std::vector<Condition> sources;
    for (const graphic::StepId step : context_.chart().transitions[user].sources)
      sources.push_back(context_.active(step));
    enabled.push_back(graphic::all(std::move(sources)));
  }
  context_.add(statements("Network of several transitions", graphic::any(std::move(enabled)),
                          context_.rewrite(std::string_view(network->statements))));
}

void ConditionGuard::evaluate(std::size_t transition, Condition enabled, const std::string& way) {
  const std::string fires = context_.fires(transition).name;
  Condition condition = context_.rewrite(context_.chart().transitions[transition].condition);
  sense_edges(condition, fires);
  Rung rung;
  rung.comment = "Transition " + way;
  rung.coils.push_back({graphic::CoilKind::Reset, fires});
  context_.add(std::move(rung));
  const ConditionNetwork* network = network_of(transition);
  std::string text;
  if (network != nullptr && network->transitions.size() == 1)
    text = context_.rewrite(std::string_view(network->statements));
  context_.add(statements("Condition of transition " + way, std::move(enabled),
                          text + fires + " := " + graphic::to_st(condition) + ";"));
}

// The state of an edge belongs to its variable: it is sensed in every scan, also where nothing asks for it.
void ConditionGuard::sense_edges(Condition& condition, const std::string& fires) {
  for (Condition& child : condition.children) sense_edges(child, fires);
  if (condition.edge == Edge::None) return;
  const std::string wire = context_.declare(fires + "_EDGE", "BOOL", "edge in the condition of " + fires);
  Rung rung;
  rung.comment = "Edge in the condition of " + fires;
  rung.condition = condition;
  rung.condition.negated = false;
  rung.coils.push_back({graphic::CoilKind::Normal, wire});
  context_.add(std::move(rung));
  condition = graphic::contact(wire, condition.negated);
}

}  // namespace stepwright::lowering
