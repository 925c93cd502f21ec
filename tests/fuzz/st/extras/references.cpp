// REF_TO: to variables, elements and structures; NULL; the assignment attempt; references as inputs.

#include "tests/fuzz/st/extras/extra.h"

namespace stepwright::st_fuzz {

namespace {

class References : public Extra {
 public:
  const char* name() const override { return "references"; }

  std::string before(Random&) const override {
    return "TYPE zrpoint : STRUCT x : INT; y : ARRAY[1..3] OF INT; b : BOOL; END_STRUCT; END_TYPE\n"
           "FUNCTION zrbump : INT\nVAR_INPUT r : REF_TO INT; by : INT; END_VAR\n"
           "  IF r <> NULL THEN r^ := r^ + by; zrbump := r^; END_IF;\nEND_FUNCTION\n";
  }

  // A function's variables are gone with the call: nothing may lead there.
  std::string declarations(const Pou& pou, Random&) const override {
    if (pou.kind == PouKind::Function) return {};
    return "VAR zr1, zr2 : REF_TO INT; zr3 : REF_TO zrpoint; zr4 : REF_TO BOOL; zr5, zr6 : INT; zr7 : "
           "zrpoint; zr8 "
           ": BOOL; zr9 : ARRAY[0..3] OF zrpoint; END_VAR\n";
  }

  std::string statement(Material& m) const override {
    if (m.is_function()) return {};
    const std::string r = m.pick({"zr1", "zr2"});
    // Mostly not followed where it is NULL.
    const auto followed = [&](const std::string& reference, const std::string& text) {
      return m.random.chance(95) ? "IF " + reference + " <> NULL THEN " + text + " END_IF;" : text;
    };
    switch (m.random.below(12)) {
      case 0:
      case 1:
        return r + " := REF(" + integer(m) + ");";
      case 2:
        return m.pick({"zr1 := zr2;", "zr2 ?= zr1;", "zr1 := NULL;", "zr3 := REF(zr7);", "zr4 := REF(zr8);"});
      case 3:
        return "zr3 := REF(zr9[" + m.between(Scalar::Int, 0, 3) + "]);";
      case 4:
        return followed(r, r + "^ := " + m.value(Scalar::Int) + ";");
      case 5:
        return followed("zr3",
                        "zr3^.y[" + m.between(Scalar::Int, 1, 3) + "] := " + m.value(Scalar::Int) + ";");
      case 6:
        return followed("zr3", m.pick({"zr7 := zr3^;", "zr3^ := zr7;", "zr3^.b := NOT zr3^.b;"}));
      case 7:
        return followed("zr4", "zr4^ := " + m.value(Scalar::Bool) + ";");
      case 8:
        return "zr5 := zrbump(" + r + ", " + m.value(Scalar::Int) + ");";
      case 9:
        return "zr8 := " + m.pick({"zr1 = zr2", "zr1 <> NULL", "zr3 = NULL"}) + ";";
      case 10:
        return followed("zr3", "zr1 := REF(zr3^.y[" + m.between(Scalar::Int, 1, 3) + "]);");
      default: {
        const std::string to = m.target(Scalar::Int);
        return to.empty() ? "" : followed(r, to + " := " + r + "^;");
      }
    }
  }

 private:
  std::string integer(Material& m) const {
    return m.pick({"zr5", "zr6", "zr7.x", "zr7.y[" + m.between(Scalar::Int, 1, 3) + "]",
                   "zr9[" + m.between(Scalar::Int, 0, 3) + "].x"});
  }
};

}  // namespace

std::unique_ptr<Extra> references() {
  return std::make_unique<References>();
}

}  // namespace stepwright::st_fuzz
