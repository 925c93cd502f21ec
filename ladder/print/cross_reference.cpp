#include "ladder/print/cross_reference.h"

#include <map>

#include "ladder/graphic/identifier.h"
#include "ladder/graphic/sfc_layout.h"
#include "ladder/print/body_uses.h"

namespace stepwright::print {

namespace {

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

  void note(const BodyUse& each, const std::string& place) {
    const std::string& name = each.use.name;
    const std::string key = graphic::upper(name);
    auto found = uses_.find(key);
    if (found == uses_.end()) {
      if (!each.drawn && name.rfind('%', 0) != 0) return;
      found = uses_.emplace(key, VariableUses{}).first;
      found->second.name = name;
    }
    std::vector<std::string>& places = each.use.write ? found->second.written : found->second.read;
    if (places.empty() || places.back() != place) places.push_back(place);
  }

 private:
  std::map<std::string, VariableUses> uses_;  // by upper-case name
};

// What people call the place of a use.
struct Places {
  const std::uint32_t block;
  const TextUse& use;
  const std::vector<std::uint32_t>& rungs;  // numbers of networks, by rung

  std::string operator()(const graphic::Listing& listing) const {
    return std::to_string(listing.first_line + use.line - 1);
  }
  std::string operator()(const graphic::LadderProgram&) const { return std::to_string(rungs[block]); }
  std::string operator()(const graphic::SfcChart& chart) const {
    std::size_t index = block;
    if (index < chart.steps.size()) return chart.steps[index].name;
    index -= chart.steps.size();
    if (index < chart.transitions.size()) return graphic::drawn_label(chart, index);
    return chart.actions[index - chart.transitions.size()].name + ":" + std::to_string(use.line);
  }
};

}  // namespace

std::vector<VariableUses> cross_reference(const graphic::Sheet& sheet) {
  Collector collector(sheet);
  std::vector<std::uint32_t> rungs;
  if (const auto* ladder = std::get_if<graphic::LadderProgram>(&sheet.body)) rungs = network_numbers(*ladder);
  for (const BodyUse& each : body_uses(sheet))
    collector.note(each, std::visit(Places{each.block, each.use, rungs}, sheet.body));
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
