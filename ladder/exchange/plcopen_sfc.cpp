// The SFC body of PLCopen TC6 XML.

#include <algorithm>
#include <map>
#include <pugixml.hpp>
#include <set>

#include "ladder/exchange/plcopen_parts.h"
#include "ladder/graphic/sfc_layout.h"

namespace stepwright::exchange::plcopen {
namespace {

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

class SfcWriter {
 public:
  SfcWriter(pugi::xml_node sfc, const SfcChart& chart)
      : chart_(chart), layout_(graphic::lay_out(chart, metrics)), sfc_(sfc), body_(sfc_) {
    for (const graphic::PlacedJump& jump : layout_.jumps) jumps_.insert({jump.transition, jump.target.value});
  }

  void write() {
    // Elements in the order of the chart; what connects them is known from the start, so the ids are too.
    for (std::size_t i = 0; i < chart_.steps.size(); ++i) step(i);
    for (std::size_t i = 0; i < chart_.transitions.size(); ++i) transition(i);
    for (std::size_t i = 0; i < chart_.steps.size(); ++i) enter_step(i);
    for (const graphic::PlacedJump& jump : layout_.jumps) jump_step(jump);
    for (std::size_t i = 0; i < chart_.steps.size(); ++i) actions(i);
  }

 private:
  std::vector<std::size_t> leaving(std::size_t step) const {
    std::vector<std::size_t> list;
    for (std::size_t t = 0; t < chart_.transitions.size(); ++t) {
      const std::vector<StepId>& ids = chart_.transitions[t].sources;
      if (std::find(ids.begin(), ids.end(), StepId(static_cast<std::uint32_t>(step))) != ids.end())
        list.push_back(t);
    }
    return list;
  }

  std::vector<std::size_t> entering(std::size_t step) const {
    std::vector<std::size_t> list;
    for (std::size_t t = 0; t < chart_.transitions.size(); ++t) {
      const std::vector<StepId>& ids = chart_.transitions[t].targets;
      const auto id = static_cast<std::uint32_t>(step);
      const bool leads = std::find(ids.begin(), ids.end(), StepId(id)) != ids.end();
      if (leads && jumps_.count({t, id}) == 0) list.push_back(t);
    }
    return list;
  }

  // The step, and the selection divergence below it if several transitions leave it.
  void step(std::size_t index) {
    const graphic::Step& step = chart_.steps[index];
    const graphic::PlacedStep& placed = layout_.steps[index];
    const std::vector<std::size_t> outs = leaving(index);
    pugi::xml_node node = body_.add("step", placed.x, placed.y, placed.width, placed.height);
    step_ids_.push_back(body_.last_id());
    step_nodes_.push_back(node);
    node.append_attribute("name") = step.name.c_str();
    if (step.initial) node.append_attribute("initialStep") = true;
    if (!outs.empty()) add_point_out(node, "");
    if (!step.actions.empty()) {
      node.append_child("connectionPointOutAction").append_attribute("formalParameter") = "";
    }
    if (!step.comment.empty()) add_text(node, "documentation", step.comment);
    if (outs.size() < 2) return;
    std::vector<int> axes;
    for (const std::size_t t : outs) axes.push_back(layout_.transitions[t].axis);
    pugi::xml_node bar = bar_at("selectionDivergence", axes, placed.y + placed.height + 10, 1);
    divergence_ids_[index] = body_.last_id();
    add_point_in(bar, {{step_ids_[index], ""}});
    for (std::size_t i = 0; i < outs.size(); ++i) add_point_out(bar, branch(i).c_str());
  }

  static std::string branch(std::size_t index) { return "branch" + std::to_string(index + 1); }

  pugi::xml_node bar_at(const char* kind, const std::vector<int>& axes, int y, int height) {
    const auto [left, right] = std::minmax_element(axes.begin(), axes.end());
    return body_.add(kind, *left - 10, y, *right - *left + 20, height);
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
      pugi::xml_node bar = bar_at("simultaneousConvergence", axes, placed.y - 20, 3);
      for (const Source& source : sources) add_point_in(bar, {source});
      add_point_out(bar);
      sources = {{body_.last_id(), ""}};
    }
    pugi::xml_node node = body_.add("transition", placed.axis - metrics.bar, placed.y, 2 * metrics.bar, 2);
    if (transition.priority > 0) node.append_attribute("priority") = transition.priority;
    add_point_in(node, sources);
    add_point_out(node);
    pugi::xml_node inline_body = node.append_child("condition").append_child("inline");
    inline_body.append_attribute("name") = transition.name.c_str();
    add_text(inline_body, "ST", graphic::to_st(transition.condition));
    if (!transition.comment.empty()) add_text(node, "documentation", transition.comment);
    const std::uint64_t id = body_.last_id();
    for (const StepId target : transition.targets) after_[{index, target.value}] = {id, ""};
    if (transition.targets.size() < 2) return;
    axes = {placed.axis};
    for (const StepId target : transition.targets) axes.push_back(layout_.steps[target.value].axis);
    pugi::xml_node bar = bar_at("simultaneousDivergence", axes, placed.y + 20, 3);
    add_point_in(bar, {{id, ""}});
    for (std::size_t i = 0; i < transition.targets.size(); ++i) {
      add_point_out(bar, branch(i).c_str());
      after_[{index, transition.targets[i].value}] = {body_.last_id(), branch(i)};
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
      pugi::xml_node bar = bar_at("selectionConvergence", axes, placed.top - 10, 1);
      for (const std::size_t t : ins) add_point_in(bar, {from(t)});
      add_point_out(bar);
      sources = {{body_.last_id(), ""}};
    }
    // The schema wants the input before the outputs.
    add_point_in(step_nodes_[index], sources);
    pugi::xml_node point = step_nodes_[index].child("connectionPointIn");
    step_nodes_[index].insert_move_after(point, step_nodes_[index].child("position"));
  }

  void jump_step(const graphic::PlacedJump& jump) {
    pugi::xml_node node =
        body_.add("jumpStep", jump.axis - metrics.bar, jump.y, 2 * metrics.bar, metrics.arrow);
    node.append_attribute("targetName") = chart_.steps[jump.target.value].name.c_str();
    add_point_in(node, {after_.at({jump.transition, jump.target.value})});
  }

  void actions(std::size_t index) {
    const graphic::PlacedStep& placed = layout_.steps[index];
    if (placed.actions.empty()) return;
    const int width = placed.qualifier_width + placed.target_width;
    const int height = metrics.action_row * static_cast<int>(placed.actions.size());
    pugi::xml_node node = body_.add("actionBlock", placed.actions_x, placed.y, width, height);
    add_point_in(node, {{step_ids_[index], ""}});
    for (std::size_t i = 0; i < placed.actions.size(); ++i) {
      const graphic::ActionBlock& block = *placed.actions[i].block;
      pugi::xml_node action = node.append_child("action");
      action.append_attribute("localId") = i;
      action.append_attribute("qualifier") = graphic::to_string(block.qualifier);
      if (!block.duration.empty()) action.append_attribute("duration") = block.duration.c_str();
      if (!block.indicator.empty()) action.append_attribute("indicator") = block.indicator.c_str();
      pugi::xml_node position = action.append_child("relPosition");
      position.append_attribute("x") = 0;
      position.append_attribute("y") = metrics.action_row * static_cast<int>(i);
      action.append_child("reference").append_attribute("name") = block.target.c_str();
    }
  }

  const SfcChart& chart_;
  graphic::SfcLayout layout_;
  pugi::xml_node sfc_;
  Body body_;
  std::set<std::pair<std::size_t, std::uint32_t>> jumps_;
  std::vector<std::uint64_t> step_ids_;
  std::vector<pugi::xml_node> step_nodes_;
  std::map<std::size_t, std::uint64_t> divergence_ids_;
  std::map<std::pair<std::size_t, std::uint32_t>, Source> after_;  // (transition, target step)
};

}  // namespace

void write_sfc(pugi::xml_node body, const SfcChart& chart) {
  SfcWriter(body.append_child("SFC"), chart).write();
}

}  // namespace stepwright::exchange::plcopen
