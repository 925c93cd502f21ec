// MOCK: a POU that stands for another one while the tests of its file run.

#include <algorithm>
#include <utility>

#include "ladder/semantics/internal/test_suite.h"
#include "ladder/source/suggestion.h"

namespace stepwright::semantics::internal {

namespace {

std::vector<const Variable*> parameters_of(const Pou& pou) {
  std::vector<const Variable*> list;
  for (const Variable& each : pou.variables) {
    const bool passed =
        each.section == Section::Input || each.section == Section::Output || each.section == Section::InOut;
    if (passed) list.push_back(&each);
  }
  return list;
}

// "VAR_INPUT channel : INT"
std::string spelt(const Variable& parameter) {
  const char* const section = parameter.section == Section::Input    ? "VAR_INPUT "
                              : parameter.section == Section::Output ? "VAR_OUTPUT "
                                                                     : "VAR_IN_OUT ";
  return section + parameter.spelling + " : " + parameter.type->name;
}

// The POU that a mock hides, with its variables; it is not part of the model and has no body.
std::unique_ptr<Pou> lay_out_hidden(Analysis& a, TypeResolver& types,
                                    const syntax::PouDeclaration& original) {
  auto pou = std::make_unique<Pou>();
  // No source can write this name.
  pou->name = a.names.intern("MOCKED#" + std::string(original.name.text));
  pou->spelling = std::string(original.name.text);
  pou->kind = original.kind;
  pou->where = original.name.where;
  pou->declaration = &original;
  if (original.kind != PouKind::Function) {
    Type* type = a.type_table().create(TypeKind::Instance, pou->spelling);
    type->pou = pou.get();
    pou->type = type;
  }
  types.lay_out(*pou);
  return pou;
}

void report(Analysis& a, Position where, const Pou& mock, std::string what) {
  a.error(code::kBadMock, where, "the mock of " + quote(mock.spelling) + " " + std::move(what),
          "a mock has the parameters and the result of what it stands for, in their order");
}

void compare(Analysis& a, const Pou& mock, const Pou& original) {
  const auto given = parameters_of(mock);
  const auto wanted = parameters_of(original);
  for (std::size_t i = 0; i < std::max(given.size(), wanted.size()); ++i) {
    const Variable* here = i < given.size() ? given[i] : nullptr;
    const Variable* there = i < wanted.size() ? wanted[i] : nullptr;
    // What has no type was reported.
    if ((here != nullptr && here->type == nullptr) || (there != nullptr && there->type == nullptr)) return;
    if (here == nullptr) return report(a, mock.where, mock, "lacks " + spelt(*there));
    if (there == nullptr) return report(a, here->where, mock, "has " + quote(here->spelling) + " too many");
    if (here->name == there->name && here->section == there->section && here->type == there->type) continue;
    return report(a, here->where, mock, "has " + spelt(*here) + " instead of " + spelt(*there));
  }
  if (mock.has_result != original.has_result)
    return report(a, mock.where, mock, mock.has_result ? "has a result" : "has no result");
  if (mock.result != nullptr && original.result != nullptr && mock.result != original.result)
    report(a, mock.where, mock, "gives " + mock.result->name + " instead of " + original.result->name);
}

}  // namespace

const syntax::PouDeclaration& mock_of(const syntax::PouDeclaration& original, const TestGroup& group) {
  for (const syntax::PouDeclaration* each : group.mocks)
    if (each->name.id == original.name.id && each->kind == original.kind) return *each;
  return original;
}

void check_mocks(Analysis& a, TypeResolver& types, const syntax::Unit& unit, const TestGroup& group) {
  std::vector<NameId> seen;
  for (const syntax::PouDeclaration* mock : group.mocks) {
    const syntax::Name& name = mock->name;
    const auto original =
        std::ranges::find_if(unit.pous, [&](const auto& each) { return each.name.id == name.id; });
    if (std::ranges::find(seen, name.id) != seen.end()) {
      a.error(code::kDuplicate, name.where, "there is another mock of " + quote(name.text));
    } else if (original == unit.pous.end()) {
      std::vector<std::string_view> candidates;
      for (const auto& each : unit.pous) candidates.push_back(each.name.text);
      const std::string meant = source::did_you_mean(name.text, candidates);
      a.error(code::kBadMock, name.where,
              "there is no POU " + quote(name.text) + " that the mock could stand for",
              meant.empty() ? "standard functions cannot be replaced" : meant);
    } else if (original->kind != mock->kind) {
      a.error(code::kBadMock, name.where,
              quote(name.text) + (original->kind == PouKind::Function ? " is a FUNCTION"
                                  : original->kind == PouKind::FunctionBlock
                                      ? " is a FUNCTION_BLOCK"
                                      : " is a PROGRAM, which has no mock"));
    } else {
      const auto hidden = lay_out_hidden(a, types, *original);
      const auto found = a.pous.find(name.id.value);
      if (found != a.pous.end()) compare(a, *found->second, *hidden);
    }
    seen.push_back(name.id);
  }
}

}  // namespace stepwright::semantics::internal
