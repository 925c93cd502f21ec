// VAR_GLOBAL and VAR_EXTERNAL in programs and blocks, constants among them; VAR RETAIN and NON_RETAIN.

#include "tests/fuzz/st/extras/extra.h"

namespace stepwright::st_fuzz {

namespace {

class Globals : public Extra {
 public:
  const char* name() const override { return "VAR_EXTERNAL"; }

  std::string before(Random& random) const override {
    return "TYPE zgn : STRUCT u : BOOL; v : LREAL; END_STRUCT; END_TYPE\n"
           "TYPE zgs : STRUCT a : ARRAY[0..2] OF INT; n : ARRAY[1..2] OF zgn; END_STRUCT; END_TYPE\n"
           "VAR_GLOBAL zg1 : INT := " +
           std::to_string(random.between(-9, 9)) +
           "; zg2 : BOOL; zg3 : ARRAY[0..3] OF DINT; zg4 : zgs; zg5 : REAL; END_VAR\n"
           "VAR_GLOBAL CONSTANT zg6 : INT := 3; END_VAR\n";
  }

  std::string declarations(const Pou& pou, Random&) const override {
    if (pou.kind == PouKind::Function) return {};
    return "VAR_EXTERNAL zg1 : INT; zg2 : BOOL; zg3 : ARRAY[0..3] OF DINT; zg4 : zgs; zg5 : REAL; END_VAR\n"
           "VAR_EXTERNAL CONSTANT zg6 : INT; END_VAR\n";
  }

  std::string statement(Material& m) const override {
    if (m.is_function()) return {};
    switch (m.random.below(8)) {
      case 0:
        return "zg1 := zg1 + " + m.value(Scalar::Int) + " * zg6;";
      case 1:
        return "zg2 := " + m.value(Scalar::Bool) + ";";
      case 2:
        return "zg3[" + m.between(Scalar::Int, 0, 3) + "] := " + m.value(Scalar::Dint) + ";";
      case 3:
        return "zg4.a[" + m.between(Scalar::Int, 0, 2) + "] := zg1;";
      case 4:
        return "zg4.n[" + m.between(Scalar::Int, 1, 2) + "].v := " + m.value(Scalar::Lreal) + ";";
      case 5:
        return "zg4.n[" + m.between(Scalar::Int, 1, 2) + "].u := zg2;";
      case 6:
        return "zg5 := zg5 + " + m.value(Scalar::Real) + ";";
      default: {
        const std::string to = m.target(Scalar::Dint);
        return to.empty() ? "" : to + " := zg3[" + m.between(Scalar::Int, 0, zg3_last) + "] - zg6;";
      }
    }
  }

 private:
  static constexpr std::int64_t zg3_last = 3;
};

class Retained : public Extra {
 public:
  const char* name() const override { return "RETAIN"; }

  std::string declarations(const Pou& pou, Random&) const override {
    if (pou.kind == PouKind::Function) return {};
    return "VAR RETAIN zt1 : DINT := 5; zt2 : ARRAY[1..2] OF LREAL; zt3 : BOOL; END_VAR\n"
           "VAR NON_RETAIN zt4 : DINT := 6; END_VAR\n";
  }

  std::string statement(Material& m) const override {
    if (m.is_function()) return {};
    return m.pick({"zt1 := zt1 + " + m.value(Scalar::Dint) + ";", "zt4 := zt1 - zt4;",
                   "zt3 := " + m.value(Scalar::Bool) + ";",
                   "zt2[" + m.between(Scalar::Int, 1, 2) + "] := " + m.value(Scalar::Lreal) + ";"});
  }
};

}  // namespace

std::unique_ptr<Extra> globals() {
  return std::make_unique<Globals>();
}
std::unique_ptr<Extra> retained() {
  return std::make_unique<Retained>();
}

}  // namespace stepwright::st_fuzz
