#include "ladder/driver/chart_conversion.h"

#include <map>
#include <set>
#include <utility>

#include "ladder/source/suggestion.h"
#include "ladder/syntax/piece.h"

namespace stepwright::driver {

namespace {

namespace code = source::code;

class Conversion {
 public:
  Conversion(const syntax::Chart& chart, Marks marks, const source::SourceSet& sources,
             source::DiagnosticSink& sink)
      : chart_(chart), marks_(marks), sources_(sources), sink_(sink) {}

  graphic::SfcChart run() {
    graphic::SfcChart result;
    for (const syntax::StepDeclaration& each : chart_.steps) {
      steps_[each.name.id] = graphic::StepId(static_cast<std::uint32_t>(result.steps.size()));
      result.steps.push_back(step(each));
    }
    for (const syntax::TransitionDeclaration& each : chart_.transitions)
      result.transitions.push_back(transition(each));
    for (const syntax::ActionDeclaration& each : chart_.actions)
      result.actions.push_back(
          {std::string(each.name.text), marked(each.body), sources_.location(each.name.where)});
    result.final_scan = chart_.final_scan;
    return result;
  }

 private:
  graphic::Step step(const syntax::StepDeclaration& declaration) {
    graphic::Step result;
    result.name = std::string(declaration.name.text);
    result.initial = declaration.initial;
    result.where = sources_.location(declaration.name.where);
    for (const syntax::ActionUse& use : declaration.actions) result.actions.push_back(action_block(use));
    return result;
  }

  graphic::ActionBlock action_block(const syntax::ActionUse& use) {
    graphic::ActionBlock block;
    block.target = std::string(use.action.text);
    block.where = sources_.location(use.action.where);
    for (const syntax::TextSlice& each : use.indicators)
      block.indicator += (block.indicator.empty() ? "" : ", ") + std::string(each.text);
    const std::string qualifier = use.qualifier.empty() ? "N" : source::upper(use.qualifier);
    const auto known = graphic::qualifier_from(qualifier);
    if (!known) {
      sink_.error(code::kBadChart, use.qualifier_where, "there is no qualifier '" + qualifier + "'",
                  "qualifiers are N, S, R, L, D, P, P0, P1, SD, DS and SL");
      return block;
    }
    block.qualifier = *known;
    const bool timed = graphic::needs_duration(*known);
    if (timed && use.duration.text.empty()) {
      sink_.error(code::kBadChart, use.qualifier_where, "the qualifier " + qualifier + " needs a duration",
                  "write " + block.target + "(" + qualifier + ", T#5s)");
    } else if (!timed && !use.duration.text.empty()) {
      sink_.error(code::kBadChart, use.duration.where, "the qualifier " + qualifier + " takes no duration",
                  "remove it, or use L, D, SD, DS or SL");
    } else if (timed) {
      block.duration = marked(use.duration);
    }
    return block;
  }

  std::vector<graphic::StepId> steps(const std::vector<syntax::Name>& names) {
    std::vector<graphic::StepId> ids;
    for (const syntax::Name& name : names) {
      if (const auto found = steps_.find(name.id); found != steps_.end()) {
        ids.push_back(found->second);
        continue;
      }
      // One step that is declared mends all transitions.
      if (!unknown_.insert(name.id).second) continue;
      std::vector<std::string_view> candidates;
      if (!sink_.is_full())
        for (const syntax::StepDeclaration& each : chart_.steps) candidates.push_back(each.name.text);
      sink_.error(code::kBadChart, name.where, "there is no step '" + std::string(name.text) + "'",
                  source::did_you_mean(name.text, candidates));
    }
    return ids;
  }

  graphic::Transition transition(const syntax::TransitionDeclaration& declaration) {
    graphic::Transition result;
    if (declaration.name) result.name = std::string(declaration.name->text);
    if (declaration.priority) result.priority = static_cast<int>(*declaration.priority);
    result.where = sources_.location(declaration.name ? declaration.name->where : declaration.where);
    result.sources = steps(declaration.sources);
    result.targets = steps(declaration.targets);
    result.condition = condition_of(declaration.condition);
    return result;
  }

  // A text that the parser read, on one line where it is compiled: as long as it was.
  std::string marked(const syntax::TextSlice& slice) {
    if (marks_ == Marks::None) return std::string(slice.text);
    return "{@" + std::to_string(slice.where.file.value) + ":" + std::to_string(slice.where.offset) + "}" +
           reader_.bare_line(slice.text) + "{@}";
  }

  graphic::Condition condition_of(const syntax::TextSlice& slice) {
    const std::vector<syntax::Token> tokens = reader_.tokens(slice.text);
    const syntax::Token* only = tokens.size() == 2 ? &tokens.front() : nullptr;
    if (only != nullptr && only->is(syntax::Keyword::True)) return graphic::always();
    if (only != nullptr && only->is(syntax::TokenKind::Identifier) && marks_ == Marks::None)
      return graphic::contact(std::string(slice.text));
    graphic::Condition condition;
    condition.kind = graphic::ConditionKind::Expression;
    condition.name = marked(slice);
    return condition;
  }

  const syntax::Chart& chart_;
  syntax::PieceReader reader_;
  Marks marks_;
  const source::SourceSet& sources_;
  source::DiagnosticSink& sink_;
  std::map<source::NameId, graphic::StepId> steps_;
  std::set<source::NameId> unknown_;
};

}  // namespace

graphic::SfcChart to_graphic(const syntax::Chart& chart, Marks marks, const source::SourceSet& sources,
                             source::DiagnosticSink& sink) {
  return Conversion(chart, marks, sources, sink).run();
}

}  // namespace stepwright::driver
