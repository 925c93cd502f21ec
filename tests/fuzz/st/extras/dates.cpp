// DATE, TOD, DT, LTIME: arithmetic of table 35, joining and splitting of table 36, comparison.

#include "tests/fuzz/st/extras/extra.h"

namespace stepwright::st_fuzz {

namespace {

class Dates : public Extra {
 public:
  const char* name() const override { return "dates"; }

  std::string declarations(const Pou&, Random&) const override {
    return "VAR zd1 : DATE := D#2024-02-29; zd2 : TOD := TOD#23:59:59.5; zd3 : DT := DT#1969-12-31-12:00:00; "
           "zd4 : "
           "LTIME; zd5 : LDT; zd6 : LDATE; zd7 : LTOD; END_VAR\n";
  }

  std::string statement(Material& m) const override {
    const std::string sign = m.pick({" + ", " - "});
    switch (m.random.below(12)) {
      case 0:
        return "zd3 := zd3" + sign + span(m) + ";";
      case 1:
        return "zd2 := zd2" + sign + span(m) + ";";
      case 2:
        return "zd4 := " + m.pick({"zd3 - zd5", "zd1 - zd6", "zd2 - zd7", "SUB_DT_DT(zd3, zd5)"}) + ";";
      case 3:
        return "zd1 := " + m.pick({"DT_TO_DATE(zd3)", "zd6", "DT_TO_DATE(zd5 + zd4)"}) + ";";
      case 4:
        return "zd2 := " + m.pick({"DT_TO_TOD(zd3)", "zd7", "DT_TO_TOD(zd3 - zd4)"}) + ";";
      case 5:
        return "zd3 := " + m.pick({"CONCAT_DATE_TOD(zd1, zd2)", "DATE_TO_DT(zd1)", "zd5", "MAX(zd3, zd5)"}) +
               ";";
      case 6:
        return "zd1 := CONCAT_DATE(" + m.between(Scalar::Int, 1900, 2100) + ", " +
               m.between(Scalar::Int, 1, 12) + ", " + m.between(Scalar::Int, 1, 28) + ");";
      case 7:
        return "zd7 := CONCAT_TOD(" + m.between(Scalar::Int, 0, 23) + ", " + m.between(Scalar::Int, 0, 59) +
               ", " + m.between(Scalar::Int, 0, 59) + ", " + m.between(Scalar::Int, 0, 999) + ");";
      case 8:
        return split(m);
      case 9:
        return "zd4 := " + m.pick({"zd4 + ", "zd4 - "}) + span(m) + ";";
      case 10:
        return "zd5 := ADD_DT_TIME(zd3, zd4); zd6 := DT_TO_DATE(zd5);";
      default: {
        const std::string to = m.target(Scalar::Bool);
        if (to.empty()) return {};
        return to + " := " +
               m.pick({"zd3 < zd5", "zd1 = zd6", "zd2 >= zd7", "zd4 > T#1s", "DAY_OF_WEEK(zd1) = 3"}) + ";";
      }
    }
  }

 private:
  std::string span(Material& m) const { return m.random.chance(70) ? m.value(Scalar::Time) : "zd4"; }

  std::string split(Material& m) const {
    const std::string year = m.plain_target(Scalar::Int);
    if (year.empty()) return {};
    return m.pick({"SPLIT_DATE(IN := zd1, YEAR => " + year + ");",
                   "SPLIT_DT(IN := zd3, DAY => " + year + ");",
                   "SPLIT_TOD(IN := zd2, MINUTE => " + year + ");", year + " := DAY_OF_WEEK(zd1);"});
  }
};

}  // namespace

std::unique_ptr<Extra> dates() {
  return std::make_unique<Dates>();
}

}  // namespace stepwright::st_fuzz
