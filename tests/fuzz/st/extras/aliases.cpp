// One variable by several ways at once: as a global, by VAR_IN_OUT, by reference, by overlapping addresses,
// as the only element of an array or the only member of a structure; in loops of few turns, which native code
// keeps in registers where it can.

#include "tests/fuzz/st/extras/extra.h"

namespace stepwright::st_fuzz {

namespace {

constexpr const char* kGlobals =
    "zjg : INT; zjh : ARRAY[2..2] OF INT; zjs : zjone; zjm : ARRAY[0..0] OF ARRAY[1..1] OF DINT; zjw : INT; "
    "zjb : USINT; zjd : DINT; zjx : BOOL;";

class Aliases : public Extra {
 public:
  const char* name() const override { return "aliases"; }

  std::string before(Random& random) const override {
    std::string out =
        "TYPE zjone : STRUCT v : INT; END_STRUCT; END_TYPE\n"
        "VAR_GLOBAL zjg : INT; zjh : ARRAY[2..2] OF INT; zjs : zjone; zjm : ARRAY[0..0] OF ARRAY[1..1] OF "
        "DINT;\n  zjw AT %MW10 : INT; zjb AT %MB20 : USINT; zjd AT %MD5 : DINT; zjx AT %MX21.3 : BOOL; "
        "END_VAR\n"
        "FUNCTION_BLOCK Zalias\nVAR_INPUT r : REF_TO INT; turns, z : INT; END_VAR\n"
        "VAR_IN_OUT p : INT; a : ARRAY[2..2] OF INT; s : zjone; END_VAR\nVAR_EXTERNAL ";
    out += kGlobals;
    out += " END_VAR\nVAR own : ARRAY[0..0] OF INT; k : INT; END_VAR\n";
    for (auto loops = random.between(1, 2); loops > 0; --loops) {
      out += "  FOR k := 1 TO turns DO\n";
      for (auto statements = random.between(2, 6); statements > 0; --statements) out += of_block(random);
      out += "  END_FOR;\n";
    }
    return out + "END_FUNCTION_BLOCK\n";
  }

  std::string declarations(const Pou& pou, Random&) const override {
    if (pou.kind == PouKind::Function) return {};
    return std::string(
               "VAR zj1 : Zalias; zj2 : ARRAY[4..4] OF Zalias; zj3 : ARRAY[2..2] OF INT; zj4 : zjone; zj5, "
               "zj6, zj8 : INT; zj7 : REF_TO INT; END_VAR\nVAR_EXTERNAL ") +
           kGlobals + " END_VAR\n";
  }

  std::string statement(Material& m) const override {
    if (m.is_function()) return {};
    switch (m.random.below(5)) {
      case 0:
        return "zj7 := REF(" + integer(m) + ");";
      case 1:
      case 2:
        return call(m);
      default: {
        std::string out = "FOR zj6 := 1 TO " + std::to_string(m.random.between(0, 3)) + " DO ";
        for (auto statements = m.random.between(2, 5); statements > 0; --statements) out += of_loop(m);
        return out + "END_FOR;";
      }
    }
  }

 private:
  static std::string of_block(Random& random) {
    return random.pick(
        {"    zjg := zjg + p;\n", "    p := p + 1;\n", "    a[z + 2] := a[2] + zjg;\n",
         "    zjh[z + 2] := zjh[z + 2] + 1;\n", "    s.v := s.v + p;\n", "    zjs.v := zjs.v + s.v;\n",
         "    own[z] := own[z] + p;\n", "    IF r <> NULL THEN r^ := r^ + k; END_IF;\n",
         "    IF p > 3 THEN p := p - zjg; END_IF;\n", "    zjm[z][z + 1] := zjm[0][1] + zjg;\n",
         "    s := zjs;\n", "    a := zjh;\n", "    zjw := zjw + 1;\n", "    zjb := USINT#7;\n",
         "    zjd := zjd + zjw;\n", "    zjx := NOT zjx;\n"});
  }

  static std::string of_loop(Material& m) {
    const std::string zero = m.random.chance(98) ? "zj8" : m.value(Scalar::Int);
    switch (m.random.below(10)) {
      case 0:
        return "zj3[" + zero + " + 2] := zj3[2] + " + m.value(Scalar::Int) + "; ";
      case 1:
        return "IF zj7 <> NULL THEN zj7^ := zj7^ + zj6; END_IF; ";
      case 2:
        return "zjh[" + zero + " + 2] := zjh[2] + zjg; ";
      case 3:
        return "zjm[zj8][" + zero + " + 1] := zjm[0][1] + zj6; ";
      case 4:
        return integer(m) + " := " + integer(m) + " + zj6; ";
      case 5:
        return "zjw := zjw + " + m.value(Scalar::Int) + "; ";
      case 6:
        return "zjb := zjb + USINT#1; zjd := zjd - zjw; ";
      case 7:
        return "zjx := " + m.value(Scalar::Bool) + "; ";
      case 8:
        return m.pick({"zj4 := zjs; ", "zjh := zj3; ", "zjs := zj4; "});
      default: {
        const std::string to = m.target(Scalar::Int);
        return to.empty() ? "zj5 := zj5 + 1; " : to + " := " + integer(m) + "; ";
      }
    }
  }

  static std::string integer(Material& m) {
    return m.pick({"zjg", "zjh[2]", "zjh[zj8 + 2]", "zjs.v", "zj3[2]", "zj3[zj8 + 2]", "zj4.v", "zj5"});
  }

  static std::string call(Material& m) {
    const std::string instance = m.pick({"zj1", "zj2[4]", "zj2[zj8 + 4]"});
    return instance + "(r := zj7, turns := " + m.between(Scalar::Int, 0, 2) +
           ", z := zj8, p := " + integer(m) + ", a := " + m.pick({"zjh", "zj3"}) +
           ", s := " + m.pick({"zjs", "zj4"}) + ");";
  }
};

}  // namespace

std::unique_ptr<Extra> aliases() {
  return std::make_unique<Aliases>();
}

}  // namespace stepwright::st_fuzz
