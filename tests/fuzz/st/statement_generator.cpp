#include "tests/fuzz/st/statement_generator.h"

#include <algorithm>
#include <utility>

namespace stepwright::st_fuzz {

namespace {

constexpr int kExpressionDepth = 3;

}  // namespace

Statements StatementGenerator::block(int count, int depth) {
  Statements out;
  for (int i = 0; i < count; ++i) add(out, depth);
  // A statement that leaves stands at the end, and alone it would leave nothing to test.
  if (depth < 3 && random_.chance(8)) leave(out);
  return out;
}

Statements StatementGenerator::action(int count) {
  may_return_ = false;
  Statements out = block(count, 1);
  may_return_ = true;
  return out;
}

bool StatementGenerator::extra(Statements& out) {
  const Extra& chosen = *random_.pick(extras_);
  Statement made = make(StatementKind::Text);
  made.text = chosen.statement(material_);
  made.construct = chosen.name();
  if (made.text.empty()) return false;
  out.push_back(std::move(made));
  return true;
}

void StatementGenerator::add(Statements& out, int depth) {
  if (!extras_.empty() && random_.chance(45) && extra(out)) return;
  const std::size_t kind = random_.below(100);
  if (depth > 0) {
    if (kind < 10) return branches(out, depth - 1);
    if (kind < 16) return select(out, depth - 1);
    if (kind < 26 && count(out, depth - 1)) return;
    if (kind < 34 && loop(out, depth - 1)) return;
  }
  if (kind >= 34 && kind < 46 && call_block(out)) return;
  if (kind >= 46 && kind < 54 && call_function(out)) return;
  if (kind >= 54 && kind < 58 && copy(out)) return;
  assign(out);
}

void StatementGenerator::assign(Statements& out) {
  const Way& way = random_.pick(scope_.writable);
  Statement made = make(StatementKind::Assign);
  made.target = expressions_.maybe_bit(expressions_.place(way, kExpressionDepth - 1));
  made.value = made.target.bit >= 0 ? expressions_.exact(Scalar::Bool, kExpressionDepth)
                                    : expressions_.assignable(*way.type, kExpressionDepth);
  out.push_back(std::move(made));
}

bool StatementGenerator::copy(Statements& out) {
  std::vector<const Way*> targets;
  for (const Way& each : scope_.aggregates)
    if (each.writable) targets.push_back(&each);
  if (targets.empty()) return false;
  const Way& target = *random_.pick(targets);
  std::vector<const Way*> sources;
  for (const Way& each : scope_.aggregates)
    if (each.type == target.type) sources.push_back(&each);
  Statement made = make(StatementKind::Copy);
  made.target = expressions_.place(target, 1);
  made.source = expressions_.place(*random_.pick(sources), 1);
  out.push_back(std::move(made));
  return true;
}

// A writable variable of exactly this type without computed elements on the way.
const Way* StatementGenerator::writable(const Type& type) {
  std::vector<const Way*> known;
  for (const Way& each : scope_.writable) {
    const bool direct = std::ranges::none_of(each.steps, [](const WayStep& s) { return s.array != nullptr; });
    if (each.type == &type && direct && each.variable->location.empty()) known.push_back(&each);
  }
  return known.empty() ? nullptr : random_.pick(known);
}

bool StatementGenerator::call_block(Statements& out) {
  if (scope_.blocks.empty()) return false;
  const Way& way = random_.pick(scope_.blocks);
  Statement made = make(StatementKind::CallBlock);
  made.target = expressions_.place(way, 1);
  for (const Variable& each : way.type->block->variables) {
    if (each.section == Section::Input && random_.chance(75))
      made.arguments.push_back({&each, expressions_.assignable(*each.type, kExpressionDepth - 1), {}});
    const bool out_parameter = each.section == Section::Output && random_.chance(30);
    if (each.section != Section::InOut && !out_parameter) continue;
    const Way* target = writable(*each.type);
    if (target != nullptr) {
      made.arguments.push_back({&each, nullptr, expressions_.place(*target, 0)});
    } else if (each.section == Section::InOut) {
      --program_.statements;
      return false;
    }
  }
  out.push_back(std::move(made));
  return true;
}

bool StatementGenerator::call_function(Statements& out) {
  std::vector<const Pou*> known;
  for (const Pou& each : program_.pous)
    if (each.kind == PouKind::Function && &each != &pou_) known.push_back(&each);
  if (known.empty()) return false;
  const Pou& callee = *random_.pick(known);
  Statement made = make(StatementKind::CallFunction);
  const Way* result = writable(*callee.result);
  bool sound = result != nullptr;
  made.callee = &callee;
  for (const Variable& each : callee.variables) {
    if (!sound) break;
    if (each.section == Section::Input)
      made.arguments.push_back({&each, expressions_.assignable(*each.type, kExpressionDepth - 1), {}});
    if (each.section != Section::InOut && each.section != Section::Output) continue;
    const Way* target = writable(*each.type);
    sound = target != nullptr;
    if (sound) made.arguments.push_back({&each, nullptr, expressions_.place(*target, 0)});
  }
  if (!sound) {
    --program_.statements;
    return false;
  }
  made.target = expressions_.place(*result, 0);
  out.push_back(std::move(made));
  return true;
}

void StatementGenerator::branches(Statements& out, int depth) {
  Statement made = make(StatementKind::If);
  const auto conditions = random_.between(1, 3);
  for (int i = 0; i < conditions; ++i) {
    Branch branch;
    branch.condition = expressions_.exact(Scalar::Bool, kExpressionDepth);
    branch.body = block(static_cast<int>(random_.between(1, 3)), depth);
    made.branches.push_back(std::move(branch));
  }
  if (random_.chance(50)) {
    made.branches.emplace_back();
    made.branches.back().body = block(static_cast<int>(random_.between(1, 2)), depth);
  }
  out.push_back(std::move(made));
}

std::vector<CaseLabel> StatementGenerator::labels(const Type& type, std::int64_t& next) {
  std::vector<CaseLabel> out;
  const auto number = random_.between(1, 3);
  for (int i = 0; i < number; ++i) {
    const bool enumeration = type.kind == TypeKind::Enumeration;
    const std::int64_t last = enumeration ? type.low + std::ssize(type.enumerators) - 1 : 100;
    if (next > last) break;
    const std::int64_t high = enumeration ? next : next + (random_.chance(40) ? random_.between(1, 4) : 0);
    out.push_back({extended(type.scalar, static_cast<std::uint64_t>(next)),
                   extended(type.scalar, static_cast<std::uint64_t>(high))});
    next = high + random_.between(1, 3);
  }
  return out;
}

void StatementGenerator::select(Statements& out, int depth) {
  Statement made = make(StatementKind::Case);
  if (!scope_.enumerations.empty() && random_.chance(30)) {
    made.value = expressions_.of_enumeration(*random_.pick(scope_.enumerations).type, 1);
  } else {
    made.value = expressions_.exact(
        random_.pick({Scalar::Sint, Scalar::Int, Scalar::Usint, Scalar::Dint, Scalar::Ulint, Scalar::Word}),
        2);
  }
  const Type& type = *made.value->type;
  std::int64_t next = type.kind == TypeKind::Enumeration ? type.low : is_signed(type.scalar) ? -6 : 0;
  const auto branches = random_.between(1, 4);
  for (int i = 0; i < branches; ++i) {
    Branch branch;
    branch.labels = labels(type, next);
    if (branch.labels.empty()) break;
    branch.body = block(static_cast<int>(random_.between(1, 2)), depth);
    made.branches.push_back(std::move(branch));
  }
  if (random_.chance(50)) {
    made.branches.emplace_back();
    made.branches.back().body = block(1, depth);
  }
  out.push_back(std::move(made));
}

// Literal bounds, also at the ends of the type; or computed ones.
void StatementGenerator::steps(Statement& out, Scalar type) {
  const bool has_sign = is_signed(type);
  const unsigned kind = static_cast<unsigned>(random_.below(4));
  if (kind == 0) {
    const std::int64_t top =
        has_sign ? (std::int64_t{1} << (bits_of(type) - 1)) - 1 : (std::int64_t{1} << bits_of(type)) - 1;
    const std::int64_t bottom = has_sign ? -top - 1 : 0;
    const bool down = has_sign && random_.chance(40);
    const auto span = random_.between(0, 9);
    const auto step = random_.between(1, 4);
    out.value = expressions_.small_literal(type, down ? bottom + 1 + span : top - span,
                                           down ? bottom + 1 + span : top - span);
    out.limit = expressions_.small_literal(type, down ? bottom + 1 : top, down ? bottom + 1 : top);
    if (down || random_.chance(60))
      out.step = expressions_.small_literal(type, down ? -step : step, down ? -step : step);
    return;
  }
  if (random_.chance(30)) {  // no turn, one or two
    const auto first = random_.between(1, 6);
    out.value = expressions_.small_literal(type, first, first);
    out.limit = expressions_.small_literal(type, first - 1, first + 1);
    return;
  }
  out.value = expressions_.small_literal(type, has_sign ? -4 : 0, 6);
  out.limit = expressions_.small_literal(type, has_sign ? -3 : 0, 8);
  const bool computed = random_.chance(60);
  const auto varied = [&](std::int64_t low, std::int64_t high) {
    Type bounds{.kind = TypeKind::Subrange, .scalar = type, .low = low, .high = high};
    return expressions_.bounded(bounds, 2);
  };
  if (computed) out.limit = varied(has_sign ? -3 : 0, 8);
  if (random_.chance(30)) out.value = varied(has_sign ? -4 : 0, 6);
  if (kind == 1) out.step = has_sign && random_.chance(50) ? varied(-4, -1) : varied(1, 4);
  if (kind == 2) {
    const auto step = random_.between(1, 3);
    const std::int64_t number = has_sign && random_.chance(50) ? -step : step;
    out.step = expressions_.small_literal(type, number, number);
  }
}

bool StatementGenerator::count(Statements& out, int depth) {
  if (loops_ >= counters_.size()) return false;
  Statement made = make(StatementKind::For);
  made.counter = counters_[loops_++];
  steps(made, made.counter->type->scalar);
  made.body = block(static_cast<int>(random_.between(1, 3)), depth);
  --loops_;
  out.push_back(std::move(made));
  return true;
}

bool StatementGenerator::loop(Statements& out, int depth) {
  if (loops_ >= counters_.size()) return false;
  Statement made = make(random_.chance(50) ? StatementKind::While : StatementKind::Repeat);
  made.counter = counters_[loops_++];
  made.turns = static_cast<int>(random_.chance(40) ? random_.between(0, 2) : random_.between(1, 6));
  made.value = expressions_.exact(Scalar::Bool, kExpressionDepth);
  made.body = block(static_cast<int>(random_.between(1, 3)), depth);
  --loops_;
  out.push_back(std::move(made));
  return true;
}

bool StatementGenerator::leave(Statements& out) {
  if (loops_ == 0 && (!may_return_ || random_.chance(50))) return false;
  const StatementKind kind =
      loops_ == 0 ? StatementKind::Return
                  : random_.pick({StatementKind::Exit, StatementKind::Continue, StatementKind::Exit,
                                  may_return_ ? StatementKind::Return : StatementKind::Exit});
  out.push_back(make(kind));
  return true;
}

}  // namespace stepwright::st_fuzz
