// ARRAY[*] parameters, of one and two dimensions, with their bounds.

#include "tests/fuzz/st/extras/extra.h"

namespace stepwright::st_fuzz {

namespace {

class OpenArrays : public Extra {
 public:
  const char* name() const override { return "ARRAY[*]"; }

  std::string before(Random&) const override {
    return "FUNCTION zasum : DINT\nVAR_IN_OUT a : ARRAY[*] OF INT; END_VAR\nVAR_INPUT by : INT; END_VAR\n"
           "VAR i : DINT; END_VAR\n"
           "  FOR i := LOWER_BOUND(a, 1) TO UPPER_BOUND(a, 1) DO zasum := zasum * 3 + a[i]; a[i] := a[i] + "
           "by; "
           "END_FOR;\nEND_FUNCTION\n"
           "FUNCTION zaput : DINT\nVAR_IN_OUT a : ARRAY[*, *] OF INT; END_VAR\nVAR_INPUT i, j : INT; v : "
           "INT; "
           "END_VAR\n"
           "  a[i, j] := v; zaput := UPPER_BOUND(a, 1) * 100 + LOWER_BOUND(a, 2);\nEND_FUNCTION\n"
           "FUNCTION zaat : BOOL\nVAR_IN_OUT a : ARRAY[*] OF BOOL; END_VAR\nVAR_INPUT i : DINT; END_VAR\n"
           "  zaat := a[i]; a[i] := NOT a[i];\nEND_FUNCTION\n"
           "FUNCTION zaall : DINT\nVAR_IN_OUT a : ARRAY[*] OF INT; END_VAR\n"
           "  zaall := zasum(a := a, by := 1) + zasum(a := a, by := -1);\nEND_FUNCTION\n";
  }

  std::string declarations(const Pou&, Random&) const override {
    return "VAR za1 : ARRAY[-2..5] OF INT; za2 : ARRAY[1..3] OF INT; za3 : ARRAY[0..2, 1..4] OF INT; za4 : "
           "ARRAY[-1..6] OF BOOL; za5 : DINT; za6 : BOOL; END_VAR\n";
  }

  std::string statement(Material& m) const override {
    switch (m.random.below(6)) {
      case 0:
        return "za5 := zasum(a := " + m.pick({"za1", "za2"}) + ", by := " + m.value(Scalar::Int) + ");";
      case 1:
        return "za5 := zaput(a := za3, i := " + m.between(Scalar::Int, 0, 2) +
               ", j := " + m.between(Scalar::Int, 1, 4) + ", v := " + m.value(Scalar::Int) + ");";
      case 2:
        return "za6 := zaat(a := za4, i := " + m.between(Scalar::Dint, -1, 6) + ");";
      case 3:
        return "za5 := zaall(za1);";
      case 4:
        return "za1[" + m.between(Scalar::Int, -2, 5) + "] := " + m.value(Scalar::Int) + ";";
      default: {
        const std::string to = m.target(Scalar::Int);
        return to.empty() ? ""
                          : to + " := za3[" + m.between(Scalar::Int, 0, 2) + ", " +
                                m.between(Scalar::Int, 1, 4) + "];";
      }
    }
  }
};

}  // namespace

std::unique_ptr<Extra> open_arrays() {
  return std::make_unique<OpenArrays>();
}

}  // namespace stepwright::st_fuzz
