#include "tests/fuzz/st/extras/ladder.h"

#include "tests/fuzz/st/extras/extra.h"

namespace stepwright::st_fuzz {

namespace {

using graphic::Condition;

class LadderWriter {
 public:
  explicit LadderWriter(std::uint64_t seed) : random_(seed * 7919 + 13) {}

  graphic::LadderProgram run() && {
    graphic::LadderProgram out;
    const auto count = random_.between(3, 8);
    for (std::int64_t i = 0; i < count; ++i) out.rungs.push_back(rung());
    // Forward only, so that every scan ends.
    if (random_.chance(40)) {
      out.rungs[0].jump_to = "zlast";
      out.rungs.back().label = "zlast";
    }
    if (random_.chance(20)) out.rungs[1].is_return = true;
    return out;
  }

 private:
  graphic::Rung rung() {
    graphic::Rung out;
    out.condition = condition(3);
    if (random_.chance(20)) out.blocks.push_back(timer());
    if (random_.chance(25)) out.blocks.push_back(statements());
    const auto coils = random_.between(out.blocks.empty() ? 1 : 0, 2);
    for (std::int64_t i = 0; i < coils; ++i) {
      using graphic::CoilKind;
      const CoilKind kind =
          random_.pick({CoilKind::Normal, CoilKind::Normal, CoilKind::Negated, CoilKind::Set, CoilKind::Reset,
                        CoilKind::RisingEdge, CoilKind::FallingEdge});
      out.coils.push_back({kind, random_.pick({"zc0", "zc1", "zc2", "zq0", "zq1"})});
    }
    return out;
  }

  Condition condition(int depth) {
    const std::size_t kind = random_.below(depth > 0 ? 10 : 5);
    if (kind >= 5) {
      std::vector<Condition> children;
      const auto count = random_.between(2, 3);
      for (std::int64_t i = 0; i < count; ++i) children.push_back(condition(depth - 1));
      return kind < 8 ? graphic::all(std::move(children)) : graphic::any(std::move(children));
    }
    if (kind == 0) {
      using graphic::CompareOp;
      const CompareOp op = random_.pick({CompareOp::Equal, CompareOp::Less, CompareOp::GreaterEqual});
      return graphic::compare(random_.pick({"zn", "zm"}), op, random_.pick({"zm", "3", "-2"}));
    }
    Condition out = graphic::contact(random_.pick({"zg0", "zg1", "zg2", "zc0", "zc1", "zc2", "zq0", "zt.Q"}),
                                     random_.chance(35));
    if (random_.chance(15)) {
      out.negated = false;
      out.edge = random_.chance(50) ? graphic::Edge::Rising : graphic::Edge::Falling;
    }
    return out;
  }

  graphic::Block timer() {
    graphic::Block out;
    out.type = "TON";
    out.instance = "zt";
    out.power_input = "IN";
    out.inputs.emplace_back("PT", random_.pick({"T#10ms", "T#20ms", "T#0s"}));
    return out;
  }

  graphic::Block statements() {
    graphic::Block out;
    out.st_body = random_.pick(
        {"zm := zm + zn;", "zm := zn - zm; zc0 := NOT zc0;", "zm := zn / 2;", "zm := zm MOD zn;"});
    return out;
  }

  Random random_;
};

class Ladder : public Extra {
 public:
  const char* name() const override { return kLadderName; }

  std::string declarations(const Pou& pou, Random&) const override {
    return pou.kind == PouKind::Function ? "" : "VAR zl1 : Zladder; zl2 : ARRAY[0..1] OF Zladder; END_VAR\n";
  }

  std::string statement(Material& m) const override {
    if (m.is_function()) return {};
    const std::string instance = m.random.chance(60) ? "zl1" : "zl2[" + m.between(Scalar::Int, 0, 1) + "]";
    if (m.random.chance(25)) {
      const std::string to = m.target(Scalar::Bool);
      return to.empty() ? "" : to + " := " + m.pick({"zl1.zq0", "zl1.zq1", "zl2[1].zq0"}) + ";";
    }
    return instance + "(zg0 := " + m.value(Scalar::Bool) + ", zg1 := " + m.value(Scalar::Bool) +
           ", zg2 := " + m.value(Scalar::Bool) + ", zn := " + m.value(Scalar::Int) + ");";
  }
};

}  // namespace

graphic::Project random_ladder(std::uint64_t seed) {
  graphic::Project out;
  out.name = "fuzz";
  graphic::Pou& pou = out.pous.emplace_back();
  pou.name = "Zladder";
  pou.kind = graphic::PouKind::FunctionBlock;
  const auto add = [&](const char* name, const char* type, graphic::VariableSection section) {
    graphic::Variable& variable = pou.variables.emplace_back();
    variable.name = name;
    variable.type = type;
    variable.section = section;
  };
  using graphic::VariableSection;
  for (const char* const each : {"zg0", "zg1", "zg2"}) add(each, "BOOL", VariableSection::Input);
  add("zn", "INT", VariableSection::Input);
  for (const char* const each : {"zq0", "zq1"}) add(each, "BOOL", VariableSection::Output);
  add("zm", "INT", VariableSection::Output);
  for (const char* const each : {"zc0", "zc1", "zc2"}) add(each, "BOOL", VariableSection::Local);
  add("zt", "TON", VariableSection::Local);
  pou.body = LadderWriter(seed).run();
  return out;
}

std::unique_ptr<Extra> ladder() {
  return std::make_unique<Ladder>();
}

}  // namespace stepwright::st_fuzz
