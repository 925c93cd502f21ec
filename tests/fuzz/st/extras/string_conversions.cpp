// X_TO_STRING, STRING_TO_X and the same with WSTRING, mostly of texts that have a value.

#include "tests/fuzz/st/extras/extra.h"

namespace stepwright::st_fuzz {

namespace {

class StringConversions : public Extra {
 public:
  const char* name() const override { return "conversion of strings"; }

  std::string declarations(const Pou&, Random&) const override {
    return "VAR zc1 : STRING[40]; zc2 : WSTRING[40]; zc3 : STRING[6]; END_VAR\n";
  }

  std::string statement(Material& m) const override {
    const auto type = static_cast<Scalar>(m.random.below(kScalars));
    const std::string st = st_name(type);
    const std::string text = m.pick({"STRING", "WSTRING"});
    const std::string to_text = st + "_TO_" + text + "(" + m.value(type) + ")";
    const std::string variable = text == "STRING" ? m.pick({"zc1", "zc3"}) : "zc2";
    switch (m.random.below(5)) {
      case 0:
        return variable + " := " + to_text + ";";
      case 1:
        return m.pick({"zc1 := WSTRING_TO_STRING(zc2);", "zc2 := STRING_TO_WSTRING(zc1);",
                       "zc3 := WSTRING_TO_STRING(CONCAT(zc2, zc2));"});
      default:
        break;
    }
    const std::string to = m.target(type);
    if (to.empty()) return variable + " := " + to_text + ";";
    if (m.random.chance(4)) return to + " := STRING_TO_" + st + "(zc1);";
    return to + " := " + text + "_TO_" + st + "(" + to_text + ");";
  }
};

}  // namespace

std::unique_ptr<Extra> string_conversions() {
  return std::make_unique<StringConversions>();
}

}  // namespace stepwright::st_fuzz
