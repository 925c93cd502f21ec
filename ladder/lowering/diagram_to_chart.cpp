#include "ladder/lowering/diagram_to_chart.h"

#include <algorithm>
#include <map>

#include "ladder/graphic/identifier.h"
#include "ladder/graphic/type_text.h"
#include "ladder/lowering/chart_tracer.h"
#include "ladder/lowering/drawn_body_text.h"
#include "ladder/lowering/drawn_conditions.h"
#include "ladder/lowering/network_lowering.h"
#include "ladder/lowering/shown_conditions.h"
#include "ladder/source/codes.h"

namespace stepwright::lowering {
namespace {

namespace code = source::code;
using graphic::ConditionSource;
using graphic::Element;
using graphic::ElementKind;
using graphic::StepId;

class ChartReader {
 public:
  ChartReader(const graphic::DrawnBody& body, DiagramScope& scope, Purpose purpose)
      : body_(body),
        diagram_(body.body.diagram),
        scope_(scope),
        texts_(scope, purpose),
        tracer_(diagram_, scope),
        graph_(diagram_, scope),
        networks_(graph_, scope),
        conditions_(body, graph_, networks_, texts_) {}

  DrawnChart read() {
    result_.chart.final_scan = body_.final_scan;
    refuse();
    for (const Network& network : graph_.networks())
      if (!conditions_.is_condition(network)) networks_.lower(network);
    result_.networks.every_scan = networks_.take();
    steps();
    transitions();
    for (const graphic::NamedBody& action : body_.actions)
      result_.chart.actions.push_back(
          {action.name, texts_.statements(action.body), scope_.location(action.where)});
    action_blocks();
    graphic::LadderProgram& networks = result_.networks.every_scan;
    graphic::LadderProgram more = texts_.take_networks();
    std::move(more.rungs.begin(), more.rungs.end(), std::back_inserter(networks.rungs));
    std::move(more.wires.begin(), more.wires.end(), std::back_inserter(networks.wires));
    result_.edges = texts_.take_variables();
    return std::move(result_);
  }

 private:
  void refuse() {
    for (const Element& element : diagram_.elements) {
      if (element.kind == ElementKind::MacroStep)
        scope_.error(code::kExchangeUnsupported, element.where, "macro steps are not supported",
                     "draw the steps of the macro in its place");
      if (element.kind == ElementKind::VendorElement)
        scope_.error(code::kExchangeUnsupported, element.where, "elements of vendors cannot be compiled",
                     "replace it by elements of the standard");
    }
  }

  void steps() {
    for (const Element& element : diagram_.elements) {
      if (element.kind != ElementKind::Step) continue;
      graphic::Step step;
      step.name = element.name.text;
      step.initial = element.initial;
      step.comment = element.documentation;
      step.where = scope_.location(element.where);
      step_ids_[&element] = StepId(static_cast<std::uint32_t>(result_.chart.steps.size()));
      by_name_.emplace(graphic::upper(step.name), step_ids_[&element]);
      result_.chart.steps.push_back(std::move(step));
    }
  }

  struct Drawn {
    const Element* element = nullptr;
    graphic::Transition transition;
  };

  void transitions() {
    std::vector<Drawn> drawn;
    std::map<const Element*, std::size_t> index;
    for (const Element& element : diagram_.elements) {
      if (element.kind != ElementKind::Transition) continue;
      index[&element] = drawn.size();
      Drawn& each = drawn.emplace_back();
      each.element = &element;
      each.transition = transition(element);
    }
    for (const Element& element : diagram_.elements) {
      if (element.kind != ElementKind::Step && element.kind != ElementKind::JumpStep) continue;
      const auto target = target_of(element);
      if (!target) continue;
      for (const Element* above : tracer_.transitions_above(element)) {
        std::vector<StepId>& targets = drawn[index.at(above)].transition.targets;
        if (std::find(targets.begin(), targets.end(), *target) == targets.end()) targets.push_back(*target);
      }
    }
    sort_branches(drawn);
    std::vector<const Element*> order;
    for (const Drawn& each : drawn) order.push_back(each.element);
    result_.networks.conditions = conditions_.take(order);
    for (Drawn& each : drawn) {
      if (each.transition.targets.empty())
        scope_.error(code::kBadDiagram, each.element->where, "nothing follows this transition",
                     "connect a step or a jump to it");
      result_.chart.transitions.push_back(std::move(each.transition));
    }
  }

  static bool share_a_step(const Drawn& a, const Drawn& b) {
    const std::vector<StepId>& steps = a.transition.sources;
    return std::any_of(steps.begin(), steps.end(), [&](StepId each) {
      const std::vector<StepId>& others = b.transition.sources;
      return std::find(others.begin(), others.end(), each) != others.end();
    });
  }

  // From left to right where they leave the same step, unless each has a number; all else keeps the order of
  // the file.
  static void sort_branches(std::vector<Drawn>& drawn) {
    std::vector<bool> sorted(drawn.size(), false);
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      if (sorted[i]) continue;
      std::vector<std::size_t> group{i};
      sorted[i] = true;
      for (std::size_t k = 0; k < group.size(); ++k) {
        for (std::size_t j = i + 1; j < drawn.size(); ++j) {
          if (sorted[j] || !share_a_step(drawn[group[k]], drawn[j])) continue;
          sorted[j] = true;
          group.push_back(j);
        }
      }
      std::sort(group.begin(), group.end());
      const bool numbered = std::all_of(
          group.begin(), group.end(), [&](std::size_t each) { return drawn[each].transition.priority != 0; });
      if (numbered) continue;
      std::vector<Drawn> branches;
      for (const std::size_t each : group) branches.push_back(drawn[each]);
      std::stable_sort(branches.begin(), branches.end(), [](const Drawn& a, const Drawn& b) {
        return a.element->position.x < b.element->position.x;
      });
      for (std::size_t k = 0; k < group.size(); ++k) drawn[group[k]] = std::move(branches[k]);
    }
  }

  std::optional<StepId> target_of(const Element& element) {
    if (element.kind == ElementKind::Step) return step_ids_.at(&element);
    const auto found = by_name_.find(graphic::upper(element.name.text));
    if (found != by_name_.end()) return found->second;
    scope_.error(code::kBadDiagram, element.where,
                 "the jump leads to '" + element.name.text + "', which is no step of this chart");
    return std::nullopt;
  }

  graphic::Transition transition(const Element& element) {
    graphic::Transition transition;
    transition.priority = static_cast<int>(std::min<std::uint64_t>(element.priority.value_or(0), 0xFFFF));
    transition.comment = element.documentation;
    transition.where = scope_.location(element.where);
    for (const Element* step : tracer_.steps_above(element)) transition.sources.push_back(step_ids_.at(step));
    if (transition.sources.empty())
      scope_.error(code::kBadDiagram, element.where, "no step leads to this transition");
    const graphic::TransitionCondition& condition = element.condition;
    // Only a name of its own: editors leave it empty.
    if (condition.source == ConditionSource::Inline) transition.name = condition.reference;
    transition.condition = condition_of(element);
    if (condition.negated) transition.condition = graphic::negation(transition.condition);
    return transition;
  }

  graphic::Condition condition_of(const Element& element) {
    const graphic::TransitionCondition& condition = element.condition;
    switch (condition.source) {
      case ConditionSource::Connection:
        return conditions_.connected(element);
      case ConditionSource::Inline:
        return conditions_.inline_body(element);
      case ConditionSource::Reference: {
        const graphic::Condition* named = conditions_.named(element);
        return named != nullptr ? *named : referred(condition.reference, element.where);
      }
      case ConditionSource::None:
        break;
    }
    scope_.error(code::kBadDiagram, element.where, "the transition has no condition",
                 "write TRUE for one that always holds");
    return {};
  }

  // What is no transition is a variable or an expression.
  graphic::Condition referred(const std::string& reference, std::uint32_t where) {
    const syntax::Piece piece = reader_.read(reference, syntax::PieceKind::Expression);
    if (!is_whole(piece, "the condition '" + reference + "'", where)) return {};
    graphic::Condition condition = graphic::contact(graphic::trimmed(reader_.bare_line(reference)));
    if (!piece.is_operand) condition.kind = graphic::ConditionKind::Expression;
    return condition;
  }

  bool is_whole(const syntax::Piece& piece, const std::string& what, std::uint32_t where) {
    if (!piece.is_whole) scope_.error(code::kBadDiagram, where, what + ": " + piece.fault, piece.hint);
    return piece.is_whole;
  }

  // The texts of an action block.
  bool is_sound(const graphic::DiagramAction& row) {
    using syntax::PieceKind;
    const auto whole = [&](const std::string& text, PieceKind kind, const char* what) {
      return text.empty() || is_whole(reader_.read(text, kind), what + (" '" + text + "'"), row.where);
    };
    return whole(row.duration, PieceKind::Expression, "the duration") &&
           whole(row.reference, PieceKind::Variable, "the target");
  }

  void action_blocks() {
    std::vector<const Element*> blocks;
    for (const Element& element : diagram_.elements)
      if (element.kind == ElementKind::ActionBlock) blocks.push_back(&element);
    std::stable_sort(blocks.begin(), blocks.end(),
                     [](const Element* a, const Element* b) { return a->position.y < b->position.y; });
    for (const Element* block : blocks) {
      const Element* owner = tracer_.owner_of(*block);
      if (owner == nullptr) {
        scope_.error(code::kBadDiagram, block->where, "the action block belongs to no step",
                     "connect it to one");
        continue;
      }
      graphic::Step& step = result_.chart.steps[step_ids_.at(owner).value];
      for (const graphic::DiagramAction& row : block->actions) add_action(step, row);
    }
  }

  void add_action(graphic::Step& step, const graphic::DiagramAction& row) {
    graphic::ActionBlock block;
    const std::string qualifier = row.qualifier.empty() ? "N" : graphic::upper(row.qualifier);
    const auto known = graphic::qualifier_from(qualifier);
    if (!known) {
      scope_.error(code::kBadChart, row.where, "there is no qualifier '" + qualifier + "'",
                   "qualifiers are N, S, R, L, D, P, P0, P1, SD, DS and SL");
      return;
    }
    if (!is_sound(row)) return;
    block.qualifier = *known;
    block.where = scope_.location(row.where);
    block.duration = row.duration;
    block.indicator = row.indicator;
    block.target = row.reference;
    if (graphic::needs_duration(*known) && row.duration.empty())
      scope_.error(code::kBadChart, row.where, "the qualifier " + qualifier + " needs a duration",
                   "give the action a duration such as T#5s");
    if (!row.body.empty()) {
      block.target = step.name + "_INLINE" + std::to_string(++inline_actions_);
      result_.chart.actions.push_back({block.target, texts_.statements(row.body.front()), block.where});
    } else if (block.target.empty()) {
      scope_.error(code::kBadDiagram, row.where, "the action of step '" + step.name + "' is missing",
                   "name an action or a BOOL variable");
      return;
    }
    step.actions.push_back(std::move(block));
  }

  const graphic::DrawnBody& body_;
  const graphic::Diagram& diagram_;
  DiagramScope& scope_;
  syntax::PieceReader reader_;
  DrawnBodyText texts_;
  ChartTracer tracer_;
  DiagramGraph graph_;
  NetworkLowering networks_;
  DrawnConditions conditions_;
  std::map<const Element*, StepId> step_ids_;
  std::map<std::string, StepId> by_name_;
  int inline_actions_ = 0;
  DrawnChart result_;
};

}  // namespace

DrawnChart diagram_to_chart(const graphic::DrawnBody& body, DiagramScope& scope) {
  return ChartReader(body, scope, Purpose::Compile).read();
}

graphic::SfcChart shown_chart(const graphic::DrawnBody& body, DiagramScope& scope) {
  DrawnChart drawn = ChartReader(body, scope, Purpose::Show).read();
  ShownConditions shown(drawn.networks.every_scan);
  for (graphic::Transition& each : drawn.chart.transitions)
    each.condition = shown.drawn(std::move(each.condition));
  return std::move(drawn.chart);
}

}  // namespace stepwright::lowering
