#include "tests/fuzz/st/generator.h"

#include <bit>
#include <limits>
#include <string_view>
#include <utility>

#include "tests/fuzz/st/extras/chart.h"
#include "tests/fuzz/st/statement_generator.h"

namespace stepwright::st_fuzz {

namespace {

class Generator {
 public:
  Generator(std::uint64_t seed, Language language)
      : random_(seed), whole_(language == Language::Whole), out_(std::make_unique<Program>()) {
    out_->seed = seed;
  }

  std::unique_ptr<Program> run() && {
    types();
    if (whole_) choose_extras();
    const auto functions = random_.between(0, 3);
    for (int i = 0; i < functions; ++i) function(i);
    const auto blocks = random_.between(0, 2);
    for (int i = 0; i < blocks; ++i) block(i);
    main();
    if (whole_ && random_.chance(30)) several_tasks();
    return std::move(out_);
  }

 private:
  const Type* elementary(Scalar type) { return &out_->types[static_cast<unsigned>(type)]; }
  const Type* elementary() { return &out_->types[random_.below(kScalars)]; }

  const Type* scalar() {
    if (random_.chance(85)) return elementary();
    std::vector<const Type*> known;
    for (const Type& each : out_->types)
      if (each.kind == TypeKind::Subrange || each.kind == TypeKind::Enumeration) known.push_back(&each);
    return random_.pick(known);
  }

  const Type* array_of(const Type* element) {
    Type type{.kind = TypeKind::Array, .name = "A" + std::to_string(out_->types.size()), .element = element};
    const bool large = element->kind == TypeKind::Block;
    const int dimensions = !large && random_.chance(30) ? 2 : 1;
    for (int i = 0; i < dimensions; ++i) {
      const std::int64_t low = random_.between(-3, 4);
      const std::int64_t most = large || dimensions == 2 ? 3 : 7;
      // Often one element: its place is known whatever the index.
      type.bounds.push_back({low, low + (random_.chance(30) ? 0 : random_.between(1, most))});
    }
    out_->types.push_back(std::move(type));
    return &out_->types.back();
  }

  // Few enough to meet one another often.
  void choose_extras() {
    for (const auto& each : all_extras_) {
      if (!random_.chance(35)) continue;
      extras_.push_back(each.get());
      out_->before += each->before(random_);
      out_->ladder = out_->ladder || std::string_view(each->name()) == kLadderName;
    }
  }

  // The same program twice, at two intervals: its code runs on two instances and in the frames of two tasks.
  void several_tasks() {
    const std::string slow = random_.pick({"T#20ms", "T#30ms", "T#10ms"});
    const std::string priority = std::to_string(random_.between(0, 2));
    out_->configuration =
        "CONFIGURATION zconfiguration\n  RESOURCE zresource ON cpu\n"
        "    TASK zfast(INTERVAL := T#10ms, PRIORITY := 1);\n    TASK zslow(INTERVAL := " +
        slow + ", PRIORITY := " + priority +
        ");\n    PROGRAM main WITH zfast : main;\n    PROGRAM zother WITH zslow : main;\n"
        "  END_RESOURCE\nEND_CONFIGURATION\n";
  }

  const Type* structure() {
    Type type{.kind = TypeKind::Struct, .name = "S" + std::to_string(out_->types.size())};
    const auto fields = random_.between(1, 4);
    for (int i = 0; i < fields; ++i) {
      std::string name = "f" + std::to_string(i);
      const Type* const part = inner_ != nullptr && random_.chance(40) ? inner_ : scalar();
      const Type* field = random_.chance(25) ? array_of(part) : part;
      type.fields.push_back({std::move(name), field});
    }
    type.name = "S" + std::to_string(out_->types.size());
    out_->types.push_back(std::move(type));
    return &out_->types.back();
  }

  void types() {
    for (unsigned i = 0; i < kScalars; ++i) {
      const auto type = static_cast<Scalar>(i);
      out_->types.push_back({.name = st_name(type), .scalar = type});
    }
    const Scalar base = random_.pick({Scalar::Sint, Scalar::Int, Scalar::Dint, Scalar::Lint, Scalar::Usint,
                                      Scalar::Uint, Scalar::Udint, Scalar::Ulint});
    const std::int64_t low = is_signed(base) ? random_.between(-40, 10) : random_.between(0, 10);
    out_->types.push_back({.kind = TypeKind::Subrange,
                           .name = "Range",
                           .scalar = base,
                           .low = low,
                           .high = low + random_.between(3, 60)});
    out_->types.push_back({.kind = TypeKind::Enumeration,
                           .name = "Colour",
                           .scalar = random_.pick({Scalar::Int, Scalar::Usint, Scalar::Dint}),
                           .low = random_.between(0, 3),
                           .enumerators = {"Red", "Amber", "Green", "Blue"}});
    // Structures in structures, and in arrays in them.
    if (random_.chance(40)) inner_ = structure();
    structure_ = random_.chance(70) ? structure() : inner_;
  }

  Variable& add(Pou& pou, const std::string& name, const Type* type, Section section) {
    Variable variable{.name = name, .type = type, .section = section};
    if (type->kind == TypeKind::Subrange || type->kind == TypeKind::Enumeration)
      variable.initial = extended(type->scalar, static_cast<std::uint64_t>(type->low));
    pou.variables.push_back(std::move(variable));
    return pou.variables.back();
  }

  const Type* aggregate() {
    if (structure_ != nullptr && random_.chance(40)) return structure_;
    if (structure_ != nullptr && random_.chance(25)) return array_of(structure_);
    if (random_.chance(20)) return array_of(array_of(scalar()));
    return array_of(scalar());
  }

  void fill(Pou& pou, int statements) {
    std::vector<const Variable*> counters;
    for (int i = 0; i < 3; ++i) {
      const auto type = static_cast<Scalar>(
          random_.between(static_cast<int>(Scalar::Sint), static_cast<int>(Scalar::Ulint)));
      // The ends of 64 bits are out of reach of the literals here.
      const Type* counter = elementary(type == Scalar::Ulint || type == Scalar::Lint ? Scalar::Dint : type);
      Variable& variable = add(pou, "i" + std::to_string(i), counter, Section::Local);
      variable.writable = false;
      counters.push_back(&variable);
    }
    for (const Extra* each : extras_) pou.declarations += each->declarations(pou, random_);
    const Scope scope(pou);
    StatementGenerator generator(random_, *out_, pou, scope, counters, extras_);
    if (whole_ && pou.kind == PouKind::Block && random_.chance(40)) return chart(pou, generator);
    pou.body = generator.block(statements, pou.kind == PouKind::Program ? 3 : 2);
  }

  void chart(Pou& pou, StatementGenerator& generator) {
    std::vector<std::string> actions;
    pou.declarations += "VAR zq0, zq1 : BOOL; END_VAR\n";
    pou.chart = random_chart(generator.material(), actions);
    for (const std::string& each : actions) pou.actions.push_back({each, generator.action(2)});
  }

  void function(int number) {
    Pou pou{.kind = PouKind::Function, .name = "F" + std::to_string(number), .result = scalar()};
    add(pou, pou.name, pou.result, Section::Result);
    const auto inputs = random_.between(1, 3);
    for (int i = 0; i < inputs; ++i) add(pou, "a" + std::to_string(i), scalar(), Section::Input);
    if (random_.chance(30)) add(pou, "o", elementary(), Section::Output);
    if (random_.chance(30)) add(pou, "io", elementary(), Section::InOut);
    const auto locals = random_.between(1, 3);
    for (int i = 0; i < locals; ++i) add(pou, "l" + std::to_string(i), scalar(), Section::Local);
    if (random_.chance(40)) add(pou, "t", aggregate(), Section::Local);
    fill(pou, static_cast<int>(random_.between(2, 5)));
    out_->pous.push_back(std::move(pou));
  }

  void block(int number) {
    Pou pou{.kind = PouKind::Block, .name = "B" + std::to_string(number)};
    const auto inputs = random_.between(1, 3);
    for (int i = 0; i < inputs; ++i) add(pou, "a" + std::to_string(i), scalar(), Section::Input);
    add(pou, "q0", scalar(), Section::Output);
    if (random_.chance(50)) add(pou, "q1", scalar(), Section::Output);
    if (random_.chance(30)) add(pou, "io", elementary(), Section::InOut);
    const auto locals = random_.between(1, 3);
    for (int i = 0; i < locals; ++i) add(pou, "s" + std::to_string(i), scalar(), Section::Local);
    if (random_.chance(40)) add(pou, "t", aggregate(), Section::Local);
    if (random_.chance(40)) add(pou, "x", scalar(), Section::Temp);
    if (number > 0 && random_.chance(50)) add(pou, "inner", block_types_.back(), Section::Local);
    fill(pou, static_cast<int>(random_.between(2, 5)));
    out_->pous.push_back(std::move(pou));
    out_->types.push_back(
        {.kind = TypeKind::Block, .name = out_->pous.back().name, .block = &out_->pous.back()});
    out_->pous.back().type = &out_->types.back();
    block_types_.push_back(&out_->types.back());
  }

  void main() {
    Pou pou{.kind = PouKind::Program, .name = "main"};
    for (unsigned i = 0; i < kScalars; ++i) {
      const auto type = static_cast<Scalar>(i);
      add(pou, "in" + std::to_string(i), elementary(type), Section::Local).writable = false;
      add(pou, "v" + std::to_string(i), elementary(type), Section::Local);
    }
    for (const Type& each : out_->types)
      if (each.kind == TypeKind::Subrange || each.kind == TypeKind::Enumeration)
        add(pou, "d" + each.name, &each, Section::Local);
    locate(pou);
    const auto aggregates = random_.between(1, 3);
    for (int i = 0; i < aggregates; ++i) add(pou, "t" + std::to_string(i), aggregate(), Section::Local);
    if (structure_ != nullptr) add(pou, "p", structure_, Section::Local);
    for (std::size_t i = 0; i < block_types_.size(); ++i) {
      const bool several = random_.chance(30);
      add(pou, "b" + std::to_string(i), several ? array_of(block_types_[i]) : block_types_[i],
          Section::Local);
    }
    fill(pou, static_cast<int>(random_.between(6, 14)));
    out_->pous.push_back(std::move(pou));
    for (const Variable& each : out_->pous.back().variables)
      if (each.name.starts_with("in")) out_->inputs.push_back(&each);
  }

  void locate(Pou& pou) {
    add(pou, "qx", elementary(Scalar::Bool), Section::Local).location = "%QX0.3";
    add(pou, "qw", elementary(Scalar::Word), Section::Local).location = "%QW1";
    add(pou, "mx", elementary(Scalar::Bool), Section::Local).location = "%MX0.6";
    add(pou, "md", elementary(Scalar::Dint), Section::Local).location = "%MD1";
  }

  Random random_;
  bool whole_;
  std::unique_ptr<Program> out_;
  const Extras all_extras_ = all_extras();
  std::vector<const Extra*> extras_;
  const Type* inner_ = nullptr;
  const Type* structure_ = nullptr;
  std::vector<const Type*> block_types_;
};

}  // namespace

std::unique_ptr<Program> generate(std::uint64_t seed, Language language) {
  return Generator(seed, language).run();
}

std::uint64_t input_value(std::uint64_t seed, std::uint64_t scan, std::size_t input, Scalar type) {
  Random random(seed * 1000003 + scan * 101 + input);
  if (type == Scalar::Bool) return random.below(2);
  if (is_real(type)) {
    const double value = random.chance(70)
                             ? static_cast<double>(random.between(-4000, 4000)) / 8
                             : random.pick({0.0, -0.0, 1.0, 0.5, 1.5, 2.5, -3.5, 0.1, 16777217.0, 3e9, -1e15,
                                            1e38, 1e-40, std::numeric_limits<double>::infinity(),
                                            std::numeric_limits<double>::quiet_NaN()});
    if (type == Scalar::Lreal) return std::bit_cast<std::uint64_t>(value);
    return std::bit_cast<std::uint32_t>(static_cast<float>(value));
  }
  const std::uint64_t top = std::uint64_t{1} << (bits_of(type) - 1);
  if (random.chance(60)) return extended(type, static_cast<std::uint64_t>(random.between(-5, 20)));
  return extended(type, random.pick<std::uint64_t>(
                            {0, 1, top - 1, top, top + 1, ~std::uint64_t{0}, random.next(), random.next()}));
}

}  // namespace stepwright::st_fuzz
