#include "ladder/syntax/namespaces.h"

#include <algorithm>
#include <string>
#include <unordered_set>
#include <utility>

#include "ladder/source/codes.h"
#include "ladder/source/suggestion.h"
#include "ladder/syntax/namespace_lookup.h"

namespace stepwright::syntax {

namespace {

namespace code = source::code;

class Resolver {
 public:
  Resolver(SyntaxContext& context, Unit& unit)
      : context_(context), names_(context.names), unit_(unit), lookup_(context.names, unit) {
    add_globals(unit.globals);
    for (const Configuration& configuration : unit.configurations) {
      add_globals(configuration.globals);
      for (const Resource& each : configuration.resources) add_globals(each.globals);
    }
  }

  void run() {
    for (const NameScope& each : unit_.scopes) check_used(each);
    for (TypeDeclaration& each : unit_.types) {
      enter(each.scope);
      type(*each.type);
      expression(each.initial.get());
    }
    for (PouDeclaration& each : unit_.pous) pou(each);
    for (TestDeclaration& each : unit_.tests) pou(each.body);
    for (PouDeclaration& each : unit_.mocks) {
      enter(each.scope);
      resolve(each.name);
      pou(each);
    }
    globals();
    for (Configuration& each : unit_.configurations) configuration(each);
  }

 private:
  void add_globals(const std::vector<VariableDeclaration>& list) {
    for (const VariableDeclaration& line : list)
      for (const Name& each : line.names) globals_.insert(each.id.value);
  }

  void enter(const NameScope* scope) {
    scope_ = scope;
    locals_.clear();
    result_.reset();
  }

  void check_used(const NameScope& scope) {
    for (const Name& each : scope.used)
      if (!lookup_.is_namespace(each.id))
        context_.sink.error(code::kUndeclared, each.where,
                            "there is no namespace '" + std::string(each.text) + "'",
                            context_.sink.is_full() ? "" : source::did_you_mean(each.text, spaces()));
  }

  std::vector<std::string_view> spaces() const {
    std::vector<std::string_view> list;
    for (const NamespacePart& each : unit_.namespaces)
      if (each.is_namespace) list.push_back(each.name.text);
    return list;
  }

  void globals() {
    std::size_t at = 0;
    for (const GlobalScope& each : unit_.global_scopes) {
      enter(each.scope);
      for (; at < each.end; ++at) variable(unit_.globals[at]);
    }
  }

  void configuration(Configuration& configuration) {
    enter(configuration.scope);
    variables(configuration.globals);
    for (Resource& each : configuration.resources) variables(each.globals);
    for (ConfiguredVariable& each : configuration.configured) {
      if (each.type) type(*each.type);
      expression(each.initial.get());
    }
  }

  void pou(PouDeclaration& pou) {
    enter(pou.scope);
    for (const VariableDeclaration& line : pou.variables)
      for (const Name& each : line.names) locals_.insert(each.id.value);
    const std::string& full = names_.folded(pou.name.id);
    const std::size_t dot = full.rfind('.');
    if (pou.kind == PouKind::Function && dot != std::string::npos) {
      const std::string own = full.substr(dot + 1);
      result_ = {names_.intern(own), pou.name.id};
    }
    if (pou.result) type(*pou.result);
    variables(pou.variables);
    statements(pou.body);
  }

  void variables(std::vector<VariableDeclaration>& list) {
    for (VariableDeclaration& each : list) variable(each);
  }

  // What a lowering added names standard blocks, whatever the namespaces around it have.
  void variable(VariableDeclaration& line) {
    if (line.type && !line.generated) type(*line.type);
    expression(line.initial.get());
  }

  void type(TypeSpec& spec) {
    if (spec.kind == TypeKind::Named || spec.kind == TypeKind::Subrange) resolve(spec.name);
    if (spec.element) type(*spec.element);
    for (const ArrayRange& each : spec.ranges) {
      expression(each.low.get());
      expression(each.high.get());
    }
    expression(spec.length.get());
    variables(spec.fields);
    for (const Enumerator& each : spec.enumerators) expression(each.value.get());
  }

  void statements(Statements& list) {
    for (const StatementPtr& each : list) statement(*each);
  }

  void statement(Statement& statement) {
    for (Expression* each :
         {statement.target.get(), statement.value.get(), statement.limit.get(), statement.step.get()})
      expression(each);
    for (Branch& branch : statement.branches) {
      expression(branch.condition.get());
      for (const CaseLabel& each : branch.labels) {
        expression(each.low.get());
        expression(each.high.get());
      }
      statements(branch.body);
    }
    statements(statement.otherwise);
    statements(statement.body);
  }

  void argument(const Argument& argument) { expression(argument.value.get()); }

  void expression(Expression* expression) {
    if (expression == nullptr) return;
    if (expression->prefix) resolve(*expression->prefix);
    if (expression->kind == ExpressionKind::Call) called(*expression);
    // The result of a function has its name.
    const bool is_name =
        expression->kind == ExpressionKind::Variable || expression->kind == ExpressionKind::Call;
    if (is_name && result_ && expression->name.id == result_->first &&
        !locals_.contains(expression->name.id.value))
      expression->name.id = result_->second;
    for (const ExpressionPtr& each : expression->operands) this->expression(each.get());
    for (const Argument& each : expression->arguments) argument(each);
    if (expression->enable) argument(*expression->enable);
    if (expression->enabled) argument(*expression->enabled);
  }

  bool is_variable(source::NameId name) const {
    return locals_.contains(name.value) || globals_.contains(name.value);
  }

  // f(x) and Space.f(x), unless it is an instance that is called.
  void called(Expression& call) {
    if (call.operands.empty()) {
      if (!is_variable(call.name.id)) resolve(call.name);
      return;
    }
    std::string path;
    const Expression* at = call.operands[0].get();
    for (; at->kind == ExpressionKind::Field; at = at->operands[0].get())
      path = "." + names_.folded(at->name.id) + path;
    if (at->kind != ExpressionKind::Variable || is_variable(at->name.id)) return;
    const auto found = found_of(names_.folded(at->name.id) + path, at->where);
    if (!found) return;
    const char* const begin = at->name.text.data();
    const std::string_view last = call.operands[0]->name.text;
    call.name = {*found, {begin, static_cast<std::size_t>(last.data() + last.size() - begin)}, at->where};
    call.operands.clear();
  }

  void resolve(Name& name) {
    if (const auto found = found_of(names_.folded(name.id), name.where)) name.id = *found;
  }

  // What a name means here; nothing if no declaration has it. Reports what cannot be used.
  std::optional<source::NameId> found_of(const std::string& name, source::Position where) {
    const auto found = lookup_.find(name, scope_);
    if (!found) return std::nullopt;
    if (found->several)
      context_.sink.error(code::kUndeclared, where, "several of the namespaces that are used have this name",
                          "write it with its namespace: " + names_.folded(found->id));
    if (const auto barrier = lookup_.barrier(found->id, scope_))
      context_.sink.error(code::kUnknownMember, where,
                          "'" + std::string(barrier->part) + "' is INTERNAL to its namespace",
                          "only what stands in " + std::string(barrier->owner) + " can use it");
    return found->id;
  }

  SyntaxContext& context_;
  source::NameTable& names_;
  Unit& unit_;
  NamespaceLookup lookup_;
  std::unordered_set<std::uint32_t> globals_;
  std::unordered_set<std::uint32_t> locals_;
  std::optional<std::pair<source::NameId, source::NameId>> result_;  // plain and full name of a function
  const NameScope* scope_ = nullptr;
};

}  // namespace

void resolve_namespaces(SyntaxContext& context, Unit& unit) {
  const auto uses = [](const NameScope& scope) { return !scope.used.empty(); };
  if (unit.namespaces.empty() && std::ranges::none_of(unit.scopes, uses)) return;
  Resolver(context, unit).run();
}

}  // namespace stepwright::syntax
