// One variable by several ways at once: as a global, by VAR_IN_OUT, by reference, by overlapping addresses,
// as the only element of an array or the only member of a structure; in loops of few turns, which native code
// keeps in registers where it can.

#include "tests/fuzz/st/extras/extra.h"

namespace stepwright::st_fuzz {

namespace {

constexpr const char* kGlobals =
    "zag : INT; zah : ARRAY[2..2] OF INT; zas : zaone; zam : ARRAY[0..0] OF ARRAY[1..1] OF DINT; zaw : INT; "
    "zab : USINT; zad : DINT; zax : BOOL;";

class Aliases : public Extra {
 public:
  const char* name() const override { return "aliases"; }

  std::string before(Random& random) const override {
    std::string out =
        "TYPE zaone : STRUCT v : INT; END_STRUCT; END_TYPE\n"
        "VAR_GLOBAL zag : INT; zah : ARRAY[2..2] OF INT; zas : zaone; zam : ARRAY[0..0] OF ARRAY[1..1] OF "
        "DINT;\n  zaw AT %MW10 : INT; zab AT %MB20 : USINT; zad AT %MD5 : DINT; zax AT %MX21.3 : BOOL; "
        "END_VAR\n"
        "FUNCTION_BLOCK Zalias\nVAR_INPUT r : REF_TO INT; turns, z : INT; END_VAR\n"
        "VAR_IN_OUT p : INT; a : ARRAY[2..2] OF INT; s : zaone; END_VAR\nVAR_EXTERNAL ";
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
               "VAR za1 : Zalias; za2 : ARRAY[4..4] OF Zalias; za3 : ARRAY[2..2] OF INT; za4 : zaone; za5, "
               "za6, za8 : INT; za7 : REF_TO INT; END_VAR\nVAR_EXTERNAL ") +
           kGlobals + " END_VAR\n";
  }

  std::string statement(Material& m) const override {
    if (m.is_function()) return {};
    switch (m.random.below(5)) {
      case 0:
        return "za7 := REF(" + integer(m) + ");";
      case 1:
      case 2:
        return call(m);
      default: {
        std::string out = "FOR za6 := 1 TO " + std::to_string(m.random.between(0, 3)) + " DO ";
        for (auto statements = m.random.between(2, 5); statements > 0; --statements) out += of_loop(m);
        return out + "END_FOR;";
      }
    }
  }

 private:
  static std::string of_block(Random& random) {
    return random.pick(
        {"    zag := zag + p;\n", "    p := p + 1;\n", "    a[z + 2] := a[2] + zag;\n",
         "    zah[z + 2] := zah[z + 2] + 1;\n", "    s.v := s.v + p;\n", "    zas.v := zas.v + s.v;\n",
         "    own[z] := own[z] + p;\n", "    IF r <> NULL THEN r^ := r^ + k; END_IF;\n",
         "    IF p > 3 THEN p := p - zag; END_IF;\n", "    zam[z][z + 1] := zam[0][1] + zag;\n",
         "    s := zas;\n", "    a := zah;\n", "    zaw := zaw + 1;\n", "    zab := USINT#7;\n",
         "    zad := zad + zaw;\n", "    zax := NOT zax;\n"});
  }

  static std::string of_loop(Material& m) {
    const std::string zero = m.random.chance(98) ? "za8" : m.value(Scalar::Int);
    switch (m.random.below(10)) {
      case 0:
        return "za3[" + zero + " + 2] := za3[2] + " + m.value(Scalar::Int) + "; ";
      case 1:
        return "IF za7 <> NULL THEN za7^ := za7^ + za6; END_IF; ";
      case 2:
        return "zah[" + zero + " + 2] := zah[2] + zag; ";
      case 3:
        return "zam[za8][" + zero + " + 1] := zam[0][1] + za6; ";
      case 4:
        return integer(m) + " := " + integer(m) + " + za6; ";
      case 5:
        return "zaw := zaw + " + m.value(Scalar::Int) + "; ";
      case 6:
        return "zab := zab + USINT#1; zad := zad - zaw; ";
      case 7:
        return "zax := " + m.value(Scalar::Bool) + "; ";
      case 8:
        return m.pick({"za4 := zas; ", "zah := za3; ", "zas := za4; "});
      default: {
        const std::string to = m.target(Scalar::Int);
        return to.empty() ? "za5 := za5 + 1; " : to + " := " + integer(m) + "; ";
      }
    }
  }

  static std::string integer(Material& m) {
    return m.pick({"zag", "zah[2]", "zah[za8 + 2]", "zas.v", "za3[2]", "za3[za8 + 2]", "za4.v", "za5"});
  }

  static std::string call(Material& m) {
    const std::string instance = m.pick({"za1", "za2[4]", "za2[za8 + 4]"});
    return instance + "(r := za7, turns := " + m.between(Scalar::Int, 0, 2) +
           ", z := za8, p := " + integer(m) + ", a := " + m.pick({"zah", "za3"}) +
           ", s := " + m.pick({"zas", "za4"}) + ");";
  }
};

}  // namespace

std::unique_ptr<Extra> aliases() {
  return std::make_unique<Aliases>();
}

}  // namespace stepwright::st_fuzz
