// The LD body of PLCopen TC6 XML. Contacts and coils are themselves; a comparison is the standard function,
// joined to the power by an AND, so that no reader needs to know what an output of a function without power
// holds.

#include <algorithm>
#include <pugixml.hpp>

#include "ladder/exchange/plcopen_parts.h"
#include "ladder/exchange/st_assignments.h"

namespace stepwright::exchange::plcopen {
namespace {

using graphic::Coil;
using graphic::CoilKind;
using graphic::CompareOp;
using graphic::Condition;
using graphic::ConditionKind;
using graphic::Edge;

const char* function_of(CompareOp op) {
  constexpr const char* names[] = {"EQ", "NE", "LT", "LE", "GT", "GE"};
  return names[static_cast<std::size_t>(op)];
}

class LadderWriter {
 public:
  LadderWriter(pugi::xml_node ld, const graphic::Pou& pou) : pou_(pou), ld_(ld), body_(ld_) {}

  result::Diagnostics write() {
    pugi::xml_node rail = body_.add("leftPowerRail", 20, 20, 3, 40);
    add_point_out(rail, "");
    rail_ = body_.last_id();
    const auto& rungs = std::get<graphic::LadderProgram>(pou_.body).rungs;
    for (std::size_t i = 0; i < rungs.size(); ++i) rung(rungs[i], i);
    pugi::xml_node right = body_.add("rightPowerRail", 900, 20, 3, std::max(40, y_ - 20));
    for (const Source& end : ends_) add_point_in(right, {end});
    rail.attribute("height") = std::max(40, y_ - 20);
    return std::move(diagnostics_);
  }

 private:
  struct Power {
    std::vector<Source> sources;  // several are a wired OR
    int x = 0;
  };

  bool at_rail(const Power& power) const { return power.sources.size() == 1 && power.sources[0].id == rail_; }

  void rung(const graphic::Rung& rung, std::size_t index) {
    if (!rung.comment.empty()) {
      pugi::xml_node comment = body_.add("comment", 40, y_, 400, 20);
      add_text(comment, "content", rung.comment);
      y_ += 30;
    }
    if (!rung.label.empty()) {
      body_.add("label", 40, y_, 80, 20).append_attribute("label") = rung.label.c_str();
      y_ += 30;
    }
    row_ = y_;
    const Power power = condition(rung.condition, {{{rail_, ""}}, 60});
    for (const graphic::Block& each : rung.blocks) block(each, power, index);
    for (const Coil& each : rung.coils) coil(each, power);
    if (!rung.jump_to.empty()) {
      pugi::xml_node jump = body_.add("jump", 820, row_, 60, 20);
      jump.append_attribute("label") = rung.jump_to.c_str();
      add_point_in(jump, power.sources);
      next_row(40);
    }
    if (rung.is_return) {
      add_point_in(body_.add("return", 820, row_, 60, 20), power.sources);
      next_row(40);
    }
    y_ = std::max(y_, row_) + 20;
  }

  void next_row(int height) {
    row_ += height;
    y_ = std::max(y_, row_);
  }

  Power condition(const Condition& node, Power in) {
    switch (node.kind) {
      case ConditionKind::True:
        return in;
      case ConditionKind::Contact:
        return contact(node, in);
      case ConditionKind::Comparison:
        return joined(comparison(node, in.x), in);
      case ConditionKind::Expression:
        return joined(value(graphic::to_st(node), in.x, row_), in);
      case ConditionKind::All:
        for (const Condition& child : node.children) in = condition(child, in);
        return in;
      case ConditionKind::Any:
        return parallel(node, in);
    }
    return in;
  }

  Power parallel(const Condition& node, const Power& in) {
    Power out{{}, in.x};
    const int top = row_;
    for (std::size_t i = 0; i < node.children.size(); ++i) {
      if (i > 0) next_row(60);
      const Power branch = condition(node.children[i], in);
      out.sources.insert(out.sources.end(), branch.sources.begin(), branch.sources.end());
      out.x = std::max(out.x, branch.x);
    }
    next_row(40);
    row_ = top;
    return out;
  }

  Power contact(const Condition& node, const Power& in) {
    pugi::xml_node contact = body_.add("contact", in.x, row_, 20, 20);
    if (node.negated) contact.append_attribute("negated") = true;
    if (node.edge != Edge::None)
      contact.append_attribute("edge") = node.edge == Edge::Rising ? "rising" : "falling";
    add_point_in(contact, in.sources);
    add_point_out(contact);
    contact.append_child("variable").text() = node.name.c_str();
    y_ = std::max(y_, row_ + 40);
    return {{{body_.last_id(), ""}}, in.x + 100};
  }

  Source value(const std::string& expression, int x, int y) {
    pugi::xml_node node = body_.add("inVariable", x, y, 80, 20);
    add_point_out(node);
    node.append_child("expression").text() = expression.c_str();
    return {body_.last_id(), ""};
  }

  // A function of inputs IN1, IN2, ... without EN.
  Source function(const char* name, const std::vector<Source>& inputs, int x) {
    pugi::xml_node block = body_.add("block", x, row_, 60, 40);
    block.append_attribute("typeName") = name;
    pugi::xml_node in = block.append_child("inputVariables");
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      pugi::xml_node variable = in.append_child("variable");
      variable.append_attribute("formalParameter") = ("IN" + std::to_string(i + 1)).c_str();
      add_point_in(variable, {inputs[i]});
    }
    block.append_child("inOutVariables");
    pugi::xml_node out = block.append_child("outputVariables").append_child("variable");
    out.append_attribute("formalParameter") = "OUT";
    add_point_out(out);
    y_ = std::max(y_, row_ + 60);
    return {body_.last_id(), "OUT"};
  }

  Source comparison(const Condition& node, int x) {
    const Source left = value(node.name, x, row_);
    const Source right = value(node.operand, x, row_ + 20);
    return function(function_of(node.op), {left, right}, x + 100);
  }

  // `test` and the power: the test alone at the rail, else an AND.
  Power joined(const Source& test, const Power& in) {
    if (at_rail(in)) return {{test}, in.x + 200};
    return {{function("AND", {single(in), test}, in.x + 200)}, in.x + 300};
  }

  // Inputs of blocks take one connection: parallel branches go through an OR.
  Source single(const Power& power) {
    if (power.sources.size() == 1) return power.sources[0];
    return function("OR", power.sources, power.x);
  }

  void coil(const Coil& coil, const Power& power) {
    pugi::xml_node node = body_.add("coil", 820, row_, 20, 20);
    if (coil.kind == CoilKind::Negated) node.append_attribute("negated") = true;
    if (coil.kind == CoilKind::RisingEdge) node.append_attribute("edge") = "rising";
    if (coil.kind == CoilKind::FallingEdge) node.append_attribute("edge") = "falling";
    if (coil.kind == CoilKind::Set) node.append_attribute("storage") = "set";
    if (coil.kind == CoilKind::Reset) node.append_attribute("storage") = "reset";
    add_point_in(node, power.sources);
    add_point_out(node);
    node.append_child("variable").text() = coil.variable.c_str();
    ends_.push_back({body_.last_id(), ""});
    next_row(40);
  }

  void block(const graphic::Block& block, const Power& power, std::size_t rung) {
    if (!block.type.empty()) {
      call(block, power);
      return;
    }
    const auto assignments = assignments_of(block.st_body);
    if (!assignments) {
      result::Diagnostic diagnostic;
      diagnostic.code = "E0601";
      diagnostic.message = "POU '" + pou_.name + "', rung " + std::to_string(rung + 1) +
                           ": PLCopen ladder diagrams cannot hold the statements \"" + block.st_body + "\"";
      diagnostic.hint = "export the chart, or keep the statements to assignments";
      diagnostics_.push_back(std::move(diagnostic));
      return;
    }
    for (const Assignment& assignment : *assignments) {
      graphic::Block move;
      move.type = "MOVE";
      move.inputs.emplace_back("IN", assignment.expression);
      move.outputs.emplace_back("OUT", assignment.target);
      call(move, power);
    }
  }

  void call(const graphic::Block& block, const Power& power) {
    const bool enabled = block.power_input.empty();
    std::vector<std::pair<std::string, Source>> inputs{{enabled ? "EN" : block.power_input, single(power)}};
    for (const auto& [pin, expression] : block.inputs) {
      inputs.emplace_back(pin, value(expression, power.x + 60, row_ + 20 * static_cast<int>(inputs.size())));
    }
    const int height = 20 + 20 * static_cast<int>(std::max(inputs.size(), block.outputs.size() + 1));
    pugi::xml_node node = body_.add("block", power.x + 160, row_, 80, height);
    const std::uint64_t id = body_.last_id();
    node.append_attribute("typeName") = block.type.c_str();
    if (!block.instance.empty()) node.append_attribute("instanceName") = block.instance.c_str();
    pugi::xml_node in = node.append_child("inputVariables");
    for (const auto& [pin, source] : inputs) {
      pugi::xml_node variable = in.append_child("variable");
      variable.append_attribute("formalParameter") = pin.c_str();
      add_point_in(variable, {source});
    }
    node.append_child("inOutVariables");
    pugi::xml_node out = node.append_child("outputVariables");
    const auto output = [&](const std::string& pin) {
      pugi::xml_node variable = out.append_child("variable");
      variable.append_attribute("formalParameter") = pin.c_str();
      add_point_out(variable);
    };
    if (enabled) output("ENO");
    for (const auto& [pin, variable] : block.outputs) output(pin);
    int at = row_;
    for (const auto& [pin, variable] : block.outputs) {
      pugi::xml_node target = body_.add("outVariable", power.x + 260, at, 80, 20);
      add_point_in(target, {{id, pin}});
      target.append_child("expression").text() = variable.c_str();
      at += 20;
    }
    next_row(height + 20);
  }

  const graphic::Pou& pou_;
  pugi::xml_node ld_;
  Body body_;
  std::uint64_t rail_ = 0;
  std::vector<Source> ends_;
  int y_ = 40;    // below everything so far
  int row_ = 40;  // of what is written now
  result::Diagnostics diagnostics_;
};

}  // namespace

result::Diagnostics write_ladder(pugi::xml_node body, const graphic::Pou& pou) {
  return LadderWriter(body.append_child("LD"), pou).write();
}

}  // namespace stepwright::exchange::plcopen
