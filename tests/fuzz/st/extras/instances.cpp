// Function blocks with VAR_IN_OUT of every kind, instances as parameters, inputs with edges, blocks in
// structures of arrays.

#include "tests/fuzz/st/extras/extra.h"

namespace stepwright::st_fuzz {

namespace {

class Instances : public Extra {
 public:
  const char* name() const override { return "instances as parameters"; }

  std::string before(Random&) const override {
    return "TYPE zis : STRUCT a : ARRAY[0..1] OF ARRAY[0..2] OF INT; END_STRUCT; END_TYPE\n"
           "FUNCTION_BLOCK Zicount\nVAR_INPUT up : BOOL R_EDGE; down : BOOL F_EDGE; by : INT := 2; END_VAR\n"
           "VAR_IN_OUT s : zis; k : INT; END_VAR\nVAR_OUTPUT n : INT; END_VAR\nVAR_TEMP t : zis; END_VAR\n"
           "  IF up THEN n := n + by; END_IF; IF down THEN n := n - 1; END_IF;\n"
           "  t := s; s.a[1][2] := s.a[1][2] + n; k := k + t.a[0][1]; s.a[0][1] := t.a[1][2];\n"
           "END_FUNCTION_BLOCK\n"
           "FUNCTION zitwice : INT\nVAR_IN_OUT c : Zicount; s : zis; END_VAR\nVAR_INPUT x : BOOL; "
           "END_VAR\nVAR k : INT; "
           "END_VAR\n"
           "  c(up := x, s := s, k := k); c(up := NOT x, down := x, s := s, k := k); zitwice := c.n + k;\n"
           "END_FUNCTION\n";
  }

  std::string declarations(const Pou& pou, Random&) const override {
    if (pou.kind == PouKind::Function) return {};
    return "VAR zi1 : Zicount; zi2 : ARRAY[0..1] OF Zicount; zi3 : zis; zi4 : ARRAY[1..2] OF zis; zi5, zi6 : "
           "INT; "
           "END_VAR\n";
  }

  std::string statement(Material& m) const override {
    if (m.is_function()) return {};
    const std::string instance = m.random.chance(50) ? "zi1" : "zi2[" + m.between(Scalar::Int, 0, 1) + "]";
    const std::string part = m.random.chance(50) ? "zi3" : "zi4[" + m.between(Scalar::Int, 1, 2) + "]";
    switch (m.random.below(4)) {
      case 0:
        return "zi6 := zitwice(c := " + instance + ", s := " + part + ", x := " + m.value(Scalar::Bool) +
               ");";
      case 1:
        return part + ".a[" + m.between(Scalar::Int, 0, 1) + "][" + m.between(Scalar::Int, 0, 2) +
               "] := " + m.value(Scalar::Int) + ";";
      case 2:
        return m.pick({"zi4[1] := zi3;", "zi3 := zi4[2];", "zi1.by := zi6;"});
      default:
        return instance + "(up := " + m.value(Scalar::Bool) + ", down := " + m.value(Scalar::Bool) +
               ", s := " + part + ", k := zi5, n => zi6);";
    }
  }
};

}  // namespace

std::unique_ptr<Extra> instances() {
  return std::make_unique<Instances>();
}

}  // namespace stepwright::st_fuzz
