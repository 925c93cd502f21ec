#include "ladder/print/cross_reference.h"

#include <map>

#include "ladder/graphic/identifier.h"
#include "ladder/graphic/sfc_layout.h"
#include "ladder/print/text_uses.h"

namespace stepwright::print {

namespace {

using graphic::Condition;
using graphic::ConditionKind;

class Collector {
 public:
  explicit Collector(const graphic::Sheet& sheet) {
    for (const graphic::Variable& each : sheet.variables) {
      VariableUses& uses = uses_[graphic::upper(each.name)];
      uses.name = each.name;
      uses.type = each.type;
      uses.address = each.address;
    }
    // A function writes its result under its own name.
    if (sheet.result_type.empty()) return;
    uses_[graphic::upper(sheet.name)].name = sheet.name;
    uses_[graphic::upper(sheet.name)].type = sheet.result_type;
  }

  std::vector<VariableUses> take() {
    std::vector<VariableUses> result;
    for (auto& [key, each] : uses_)
      if (!each.written.empty() || !each.read.empty()) result.push_back(std::move(each));
    return result;
  }

  void add(const graphic::Listing& listing) {
    std::string text;
    for (const std::string& line : listing.lines) text += line + "\n";
    for (const TextUse& use : texts_.of(text))
      note(use.name, std::to_string(listing.first_line + use.line - 1), use.write, false);
  }

  void add(const graphic::LadderProgram& program) {
    std::size_t number = 0;
    for (const graphic::Rung& rung : program.rungs) {
      if (!rung.goes_on || number == 0) ++number;
      const std::string place = std::to_string(number);
      add(rung.condition, place);
      for (const graphic::Block& block : rung.blocks) add(block, place);
      for (const graphic::Coil& coil : rung.coils) path(coil.variable, place, true);
    }
  }

  void add(const graphic::SfcChart& chart) {
    for (const graphic::Step& step : chart.steps) {
      for (const graphic::ActionBlock& block : step.actions) {
        note(block.target, step.name, true, false);
        text(block.duration, step.name);
        text(block.indicator, step.name);
      }
    }
    for (std::size_t i = 0; i < chart.transitions.size(); ++i)
      text(to_st(chart.transitions[i].condition), graphic::drawn_label(chart, i));
    for (const graphic::Action& action : chart.actions)
      for (const TextUse& use : texts_.of(action.st_body))
        note(use.name, action.name + ":" + std::to_string(use.line), use.write, false);
  }

 private:
  void note(const std::string& name, const std::string& place, bool write, bool always) {
    const std::string key = graphic::upper(name);
    auto found = uses_.find(key);
    if (found == uses_.end()) {
      if (!always && name.rfind('%', 0) != 0) return;
      found = uses_.emplace(key, VariableUses{}).first;
      found->second.name = name;
    }
    std::vector<std::string>& places = write ? found->second.written : found->second.read;
    if (places.empty() || places.back() != place) places.push_back(place);
  }

  void text(const std::string& st, const std::string& place) {
    for (const TextUse& use : texts_.of(st)) note(use.name, place, use.write, false);
  }

  // A variable of a contact or coil: of a path its first name.
  void path(const std::string& variable, const std::string& place, bool write) {
    const std::size_t end = variable.find_first_of(".[^");
    if (end == std::string::npos || variable.rfind('%', 0) == 0) return note(variable, place, write, true);
    note(variable.substr(0, end), place, write, true);
    text(variable.substr(end), place);
  }

  void add(const Condition& condition, const std::string& place) {
    if (condition.kind == ConditionKind::Contact) path(condition.name, place, false);
    if (condition.kind == ConditionKind::Comparison || condition.kind == ConditionKind::Expression) {
      text(condition.name, place);
      text(condition.operand, place);
    }
    for (const Condition& child : condition.children) add(child, place);
  }

  void add(const graphic::Block& block, const std::string& place) {
    if (!block.instance.empty()) note(block.instance, place, true, true);
    for (const auto& [pin, value] : block.inputs) text(value, place);
    for (const auto& [pin, value] : block.outputs)
      if (!value.empty()) path(value, place, true);
    text(block.st_body, place);
  }

  std::map<std::string, VariableUses> uses_;  // by upper-case name
  TextUses texts_;
};

}  // namespace

std::vector<VariableUses> cross_reference(const graphic::Sheet& sheet) {
  Collector collector(sheet);
  std::visit([&collector](const auto& body) { collector.add(body); }, sheet.body);
  return collector.take();
}

graphic::LadderNotes ladder_notes(const std::vector<VariableUses>& uses) {
  graphic::LadderNotes notes;
  for (const VariableUses& each : uses) {
    const std::string key = graphic::upper(each.name);
    if (!each.written.empty()) notes.contacts[key] = "←" + joined(each.written);
    if (!each.read.empty()) notes.coils[key] = "→" + joined(each.read);
  }
  return notes;
}

std::string joined(const std::vector<std::string>& places, const char* between) {
  std::string text;
  for (const std::string& each : places) text += (text.empty() ? "" : between) + each;
  return text;
}

}  // namespace stepwright::print
