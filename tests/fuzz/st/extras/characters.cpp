// CHAR and WCHAR, characters of strings by their position, CASE of characters.

#include "tests/fuzz/st/extras/extra.h"

namespace stepwright::st_fuzz {

namespace {

class Characters : public Extra {
 public:
  const char* name() const override { return "characters"; }

  std::string declarations(const Pou&, Random&) const override {
    return "VAR zh1 : STRING[6] := 'letter'; zh2 : WSTRING[4] := \"wide\"; zh3 : CHAR; zh4 : WCHAR; zh5 : "
           "STRING[3]; END_VAR\n";
  }

  std::string statement(Material& m) const override {
    // The texts keep their lengths: most positions are good.
    const std::string first = "zh1[" + m.between(Scalar::Int, 1, 6) + "]";
    const std::string second = "zh2[" + m.between(Scalar::Dint, 1, 4) + "]";
    switch (m.random.below(8)) {
      case 0:
        return "zh3 := " + first + ";";
      case 1:
        return first + " := zh3;";
      case 2:
        return "zh4 := " + second + ";";
      case 3:
        return second + " := WCHAR#\"" + m.pick({"x", "Y", "$20AC"}) + "\";";
      case 4:
        return "zh3 := INT_TO_CHAR(" + m.between(Scalar::Int, 33, 126) + ");";
      case 5:
        return "zh5 := CONCAT(zh3, zh5);";
      case 6: {
        const std::string to = m.target(Scalar::Int);
        return to.empty() ? "" : to + " := CHAR_TO_INT(" + first + ");";
      }
      default: {
        const std::string to = m.target(Scalar::Int);
        if (to.empty()) return {};
        return "CASE zh3 OF 'a'..'g': " + to + " := 1; 'h', 't': " + to + " := 2; ELSE " + to +
               " := 3; END_CASE;";
      }
    }
  }
};

}  // namespace

std::unique_ptr<Extra> characters() {
  return std::make_unique<Characters>();
}

}  // namespace stepwright::st_fuzz
