#include "ladder/graphic/externals.h"

#include <cctype>
#include <utility>

namespace stepwright::graphic {
namespace {

bool is_of_a_name(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

}  // namespace

bool mentions(std::string_view text, std::string_view name) {
  for (std::size_t at = text.find(name); at != std::string_view::npos; at = text.find(name, at + 1)) {
    const std::size_t end = at + name.size();
    const bool starts = at == 0 || !is_of_a_name(text[at - 1]);
    if (starts && (end == text.size() || !is_of_a_name(text[end]))) return true;
  }
  return false;
}

std::vector<Variable> externals(const std::vector<Variable>& globals, std::string_view text) {
  std::vector<Variable> declared;
  for (const Variable& shared : globals) {
    if (!mentions(text, shared.name)) continue;
    Variable external;
    external.name = shared.name;
    external.type = shared.type;
    external.section = VariableSection::External;
    declared.push_back(std::move(external));
  }
  return declared;
}

std::string text_of(const SfcChart& chart) {
  std::string text;
  for (const Step& step : chart.steps) {
    for (const ActionBlock& block : step.actions) text += block.target + "\n";
  }
  for (const Action& action : chart.actions) text += action.st_body;
  for (const Transition& transition : chart.transitions) text += to_st(transition.condition) + "\n";
  return text;
}

}  // namespace stepwright::graphic
