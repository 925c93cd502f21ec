// The standard function blocks: bistables, edges, counters, timers.

#include "tests/fuzz/st/extras/extra.h"

namespace stepwright::st_fuzz {

namespace {

class StandardBlocks : public Extra {
 public:
  const char* name() const override { return "standard blocks"; }

  std::string declarations(const Pou& pou, Random&) const override {
    if (pou.kind == PouKind::Function) return {};
    return "VAR zb1 : SR; zb2 : RS; zb3 : R_TRIG; zb4 : F_TRIG; zb5 : CTU; zb6 : CTD; zb7 : CTUD; zb8 : TON; "
           "zb9 : "
           "TOF; zb10 : TP; zb11 : ARRAY[0..2] OF TON; zb12 : CTU_ULINT; END_VAR\n";
  }

  std::string statement(Material& m) const override {
    if (m.is_function()) return {};
    const auto b = [&] { return m.value(Scalar::Bool); };
    const auto time = [&] {
      return m.random.chance(60) ? m.pick({"T#0s", "T#10ms", "T#25ms", "T#-1s"}) : m.value(Scalar::Time);
    };
    switch (m.random.below(12)) {
      case 0:
        return "zb1(S1 := " + b() + ", R := " + b() + ");";
      case 1:
        return "zb2(S := " + b() + ", R1 := " + b() + ");";
      case 2:
        return m.pick({"zb3", "zb4"}) + "(CLK := " + b() + ");";
      case 3:
        return "zb5(CU := " + b() + ", R := " + b() + ", PV := " + m.value(Scalar::Int) + ");";
      case 4:
        return "zb6(CD := " + b() + ", LD := " + b() + ", PV := " + m.value(Scalar::Int) + ");";
      case 5:
        return "zb7(CU := " + b() + ", CD := " + b() + ", R := " + b() + ", LD := " + b() +
               ", PV := " + m.value(Scalar::Int) + ");";
      case 6:
      case 7:
        return m.pick({"zb8", "zb9", "zb10"}) + "(IN := " + b() + ", PT := " + time() + ");";
      case 8:
        return "zb11[" + m.between(Scalar::Int, 0, 2) + "](IN := " + b() + ", PT := " + time() + ");";
      case 9:
        return "zb12(CU := " + b() + ", PV := " + m.value(Scalar::Ulint) + ");";
      case 10: {
        const std::string to = m.target(Scalar::Time);
        return to.empty() ? "" : to + " := " + m.pick({"zb8.ET", "zb9.ET", "zb10.ET", "zb11[1].ET"}) + ";";
      }
      default: {
        const std::string to = m.target(Scalar::Bool);
        return to.empty()
                   ? ""
                   : to + " := " +
                         m.pick({"zb1.Q1", "zb3.Q", "zb5.Q", "zb7.QD", "zb8.Q AND zb9.Q", "zb10.Q"}) + ";";
      }
    }
  }
};

}  // namespace

std::unique_ptr<Extra> standard_blocks() {
  return std::make_unique<StandardBlocks>();
}

}  // namespace stepwright::st_fuzz
