// EN and ENO of functions, function blocks and standard functions.

#include "tests/fuzz/st/extras/extra.h"

namespace stepwright::st_fuzz {

namespace {

class Enables : public Extra {
 public:
  const char* name() const override { return "EN and ENO"; }

  std::string before(Random&) const override {
    return "FUNCTION zebump : INT\nVAR_INPUT by : INT; END_VAR\nVAR_IN_OUT v : INT; END_VAR\nVAR_OUTPUT o : "
           "INT; "
           "END_VAR\n  v := v + by; o := v * 2; zebump := v;\nEND_FUNCTION\n"
           "FUNCTION_BLOCK Zeblock\nVAR_INPUT x : INT; END_VAR\nVAR_OUTPUT n : INT; END_VAR\n  n := n + x;\n"
           "END_FUNCTION_BLOCK\n";
  }

  std::string declarations(const Pou& pou, Random&) const override {
    const std::string block = pou.kind == PouKind::Function ? "" : "ze4 : Zeblock; ze5 : CTU; ";
    return "VAR ze1 : BOOL; ze2, ze3, ze6 : INT; " + block + "END_VAR\n";
  }

  std::string statement(Material& m) const override {
    const std::string head = "EN := " + m.value(Scalar::Bool) + ", ";
    const std::string tail = m.random.chance(70) ? ", ENO => ze1" : "";
    switch (m.random.below(m.is_function() ? 3 : 5)) {
      case 0:
        return "ze3 := zebump(" + head + "by := " + m.value(Scalar::Int) + ", v := ze2, o => ze6" + tail +
               ");";
      case 1:
        return "ze3 := ADD(" + head + "IN1 := " + m.value(Scalar::Int) + ", IN2 := ze2" + tail + ");";
      case 2: {
        const std::string to = m.target(Scalar::Int);
        const std::string function = m.pick({"SUB", "MUL", "DIV"});
        if (to.empty()) return {};
        return to + " := " + function + "(" + head + "IN1 := ze3, IN2 := " + m.between(Scalar::Int, 1, 9) +
               tail + ");";
      }
      case 3:
        return "ze4(" + head + "x := " + m.value(Scalar::Int) + ", n => ze6" + tail + ");";
      default:
        return "ze5(" + head + "CU := " + m.value(Scalar::Bool) + ", PV := 3" + tail + ");";
    }
  }
};

}  // namespace

std::unique_ptr<Extra> enables() {
  return std::make_unique<Enables>();
}

}  // namespace stepwright::st_fuzz
