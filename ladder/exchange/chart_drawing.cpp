#include "ladder/exchange/chart_drawing.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include "ladder/exchange/drawing.h"
#include "ladder/graphic/sfc_layout.h"

namespace stepwright::exchange {
namespace {

using graphic::Element;
using graphic::ElementKind;
using graphic::SfcChart;
using graphic::StepId;

constexpr graphic::SfcMetrics metrics{.margin = 40,
                                      .character = 8,
                                      .small_character = 8,
                                      .line = 20,
                                      .step_padding = 10,
                                      .step_padding_y = 10,
                                      .min_step_width = 60,
                                      .action_gap = 40,
                                      .action_row = 30,
                                      .cell_padding = 10,
                                      .bar = 10,
                                      .text_gap = 10,
                                      .node_gap = 40,
                                      .channel_padding = 20,
                                      .track = 20,
                                      .overhang = 10,
                                      .arrow = 20};

bool contains(const std::vector<StepId>& steps, std::size_t step) {
  return std::find(steps.begin(), steps.end(), StepId(static_cast<std::uint32_t>(step))) != steps.end();
}

std::string branch(std::size_t index) {
  return "branch" + std::to_string(index + 1);
}

graphic::DiagramBody statements(const std::string& text) {
  graphic::DiagramBody body;
  body.text = plain_text(text);
  return body;
}

class ChartDrawing {
 public:
  explicit ChartDrawing(const SfcChart& chart)
      : chart_(chart),
        layout_(graphic::lay_out(chart, metrics)),
        drawing_(graphic::DiagramLanguage::Chart),
        priorities_(chart.transitions.size()) {
    for (const graphic::PlacedJump& jump : layout_.jumps) jumps_.insert({jump.transition, jump.target.value});
  }

  graphic::Diagram draw() {
    // Elements in the order of the chart; what a step comes from is known when its transitions are drawn.
    set_priorities();
    for (std::size_t i = 0; i < chart_.steps.size(); ++i) step(i);
    for (std::size_t i = 0; i < chart_.transitions.size(); ++i) transition(i);
    for (std::size_t i = 0; i < chart_.steps.size(); ++i) enter_step(i);
    for (const graphic::PlacedJump& jump : layout_.jumps) jump_step(jump);
    for (std::size_t i = 0; i < chart_.steps.size(); ++i) actions(i);
    return drawing_.take();
  }

 private:
  std::vector<std::size_t> leaving(std::size_t step) const {
    std::vector<std::size_t> list;
    for (std::size_t t = 0; t < chart_.transitions.size(); ++t)
      if (contains(chart_.transitions[t].sources, step)) list.push_back(t);
    return list;
  }

  std::vector<std::size_t> entering(std::size_t step) const {
    std::vector<std::size_t> list;
    for (std::size_t t = 0; t < chart_.transitions.size(); ++t) {
      const bool drawn = jumps_.count({t, static_cast<std::uint32_t>(step)}) == 0;
      if (drawn && contains(chart_.transitions[t].targets, step)) list.push_back(t);
    }
    return list;
  }

  // Without numbers, branches are tested from left to right.
  void set_priorities() {
    std::vector<std::size_t> order(chart_.transitions.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return chart_.transitions[a].priority < chart_.transitions[b].priority;
    });
    bool plain = true;
    for (std::size_t i = 0; i < chart_.steps.size(); ++i) {
      const std::vector<std::size_t> outs = leaving(i);
      for (std::size_t k = 0; k + 1 < outs.size(); ++k)
        plain = plain && layout_.transitions[outs[k]].axis < layout_.transitions[outs[k + 1]].axis &&
                chart_.transitions[outs[k]].priority == 0 && chart_.transitions[outs[k + 1]].priority == 0;
    }
    for (std::size_t rank = 0; rank < order.size() && !plain; ++rank) priorities_[order[rank]] = rank + 1;
  }

  // The step, and the selection divergence below it if several transitions leave it.
  void step(std::size_t index) {
    const graphic::Step& step = chart_.steps[index];
    const graphic::PlacedStep& placed = layout_.steps[index];
    const std::vector<std::size_t> outs = leaving(index);
    Element& node = drawing_.add(ElementKind::Step, placed.x, placed.y, placed.width, placed.height);
    step_ids_.push_back(node.id);
    node.name = plain_text(step.name);
    node.initial = step.initial;
    if (!outs.empty()) node.outputs.push_back(output_pin());
    if (!step.actions.empty()) node.action_output = output_pin();
    node.documentation = step.comment;
    if (outs.size() < 2) return;
    std::vector<int> axes;
    for (const std::size_t t : outs) axes.push_back(layout_.transitions[t].axis);
    Element& bar = bar_at(ElementKind::SelectionDivergence, axes, placed.y + placed.height + 10, 1);
    divergence_ids_[index] = bar.id;
    bar.inputs.push_back(input_from({{step_ids_[index], ""}}));
    for (std::size_t i = 0; i < outs.size(); ++i) bar.outputs.push_back(output_pin(branch(i)));
  }

  Element& bar_at(ElementKind kind, const std::vector<int>& axes, int y, int height) {
    const auto [left, right] = std::minmax_element(axes.begin(), axes.end());
    return drawing_.add(kind, *left - 10, y, *right - *left + 20, height);
  }

  // What a transition is connected to where it leaves `step`.
  Source below(std::size_t step, std::size_t transition) const {
    const auto found = divergence_ids_.find(step);
    if (found == divergence_ids_.end()) return {step_ids_[step], ""};
    const std::vector<std::size_t> outs = leaving(step);
    const auto place = std::find(outs.begin(), outs.end(), transition);
    return {found->second, branch(static_cast<std::size_t>(place - outs.begin()))};
  }

  // The transition, with the simultaneous convergence above and the divergence below it.
  void transition(std::size_t index) {
    const graphic::Transition& transition = chart_.transitions[index];
    const graphic::PlacedTransition& placed = layout_.transitions[index];
    std::vector<Source> sources;
    std::vector<int> axes{placed.axis};
    for (const StepId id : transition.sources) {
      sources.push_back(below(id.value, index));
      axes.push_back(layout_.steps[id.value].axis);
    }
    if (sources.size() > 1) {
      Element& bar = bar_at(ElementKind::SimultaneousConvergence, axes, placed.y - 20, 3);
      for (const Source& source : sources) bar.inputs.push_back(input_from({source}));
      bar.outputs.push_back(output_pin());
      sources = {{bar.id, ""}};
    }
    Element& node =
        drawing_.add(ElementKind::Transition, placed.axis - metrics.bar, placed.y, 2 * metrics.bar, 2);
    node.inputs.push_back(input_from(sources));
    node.outputs.push_back(output_pin());
    if (priorities_[index] != 0) node.priority = priorities_[index];
    node.condition.source = graphic::ConditionSource::Inline;
    node.condition.reference = transition.name;
    node.condition.body.push_back(statements(graphic::to_st(transition.condition)));
    node.documentation = transition.comment;
    const std::uint64_t id = node.id;
    for (const StepId target : transition.targets) after_[{index, target.value}] = {id, ""};
    if (transition.targets.size() < 2) return;
    axes = {placed.axis};
    for (const StepId target : transition.targets) axes.push_back(layout_.steps[target.value].axis);
    Element& bar = bar_at(ElementKind::SimultaneousDivergence, axes, placed.y + 20, 3);
    bar.inputs.push_back(input_from({{id, ""}}));
    for (std::size_t i = 0; i < transition.targets.size(); ++i) {
      bar.outputs.push_back(output_pin(branch(i)));
      after_[{index, transition.targets[i].value}] = {bar.id, branch(i)};
    }
  }

  // Connects a step upwards, through a selection convergence if several transitions enter it.
  void enter_step(std::size_t index) {
    const std::vector<std::size_t> ins = entering(index);
    if (ins.empty()) return;
    const auto from = [&](std::size_t t) { return after_.at({t, static_cast<std::uint32_t>(index)}); };
    std::vector<Source> sources{from(ins.front())};
    if (ins.size() > 1) {
      const graphic::PlacedStep& placed = layout_.steps[index];
      std::vector<int> axes{placed.axis};
      for (const std::size_t t : ins) axes.push_back(layout_.transitions[t].axis);
      Element& bar = bar_at(ElementKind::SelectionConvergence, axes, placed.top - 10, 1);
      for (const std::size_t t : ins) bar.inputs.push_back(input_from({from(t)}));
      bar.outputs.push_back(output_pin());
      sources = {{bar.id, ""}};
    }
    drawing_.at(step_ids_[index]).inputs.push_back(input_from(sources));
  }

  void jump_step(const graphic::PlacedJump& jump) {
    Element& node =
        drawing_.add(ElementKind::JumpStep, jump.axis - metrics.bar, jump.y, 2 * metrics.bar, metrics.arrow);
    node.name = plain_text(chart_.steps[jump.target.value].name);
    node.inputs.push_back(input_from({after_.at({jump.transition, jump.target.value})}));
  }

  void actions(std::size_t index) {
    const graphic::PlacedStep& placed = layout_.steps[index];
    if (placed.actions.empty()) return;
    const int width = placed.qualifier_width + placed.target_width;
    const int height = metrics.action_row * static_cast<int>(placed.actions.size());
    Element& node = drawing_.add(ElementKind::ActionBlock, placed.actions_x, placed.y, width, height);
    node.inputs.push_back(input_from({{step_ids_[index], ""}}));
    for (std::size_t i = 0; i < placed.actions.size(); ++i) {
      const graphic::ActionBlock& block = *placed.actions[i].block;
      graphic::DiagramAction& action = node.actions.emplace_back();
      action.qualifier = graphic::to_string(block.qualifier);
      action.duration = block.duration;
      action.indicator = block.indicator;
      action.reference = block.target;
      action.position = graphic::Place{0, static_cast<double>(metrics.action_row) * static_cast<double>(i)};
    }
  }

  const SfcChart& chart_;
  graphic::SfcLayout layout_;
  Drawing drawing_;
  std::vector<std::uint64_t> priorities_;  // of the transitions; 0 = none
  std::set<std::pair<std::size_t, std::uint32_t>> jumps_;
  std::vector<std::uint64_t> step_ids_;
  std::map<std::size_t, std::uint64_t> divergence_ids_;
  std::map<std::pair<std::size_t, std::uint32_t>, Source> after_;  // (transition, target step)
};

}  // namespace

graphic::DrawnBody draw_chart(const SfcChart& chart) {
  graphic::DrawnBody drawn;
  drawn.body.language = graphic::BodyLanguage::Diagram;
  drawn.body.diagram = ChartDrawing(chart).draw();
  drawn.final_scan = chart.final_scan;
  for (const graphic::Action& action : chart.actions) {
    graphic::NamedBody& named = drawn.actions.emplace_back();
    named.name = action.name;
    named.body = statements(action.st_body);
  }
  return drawn;
}

}  // namespace stepwright::exchange
