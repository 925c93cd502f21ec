// Bytes, words and double words of bit strings; byte order; BCD.

#include "tests/fuzz/st/extras/extra.h"

namespace stepwright::st_fuzz {

namespace {

class BitParts : public Extra {
 public:
  const char* name() const override { return "parts of bit strings"; }

  std::string declarations(const Pou&, Random&) const override {
    return "VAR zp1 : LWORD := 16#1122334455667788; zp2 : DWORD; zp3 : WORD; zp4 : BYTE; zp5 : UINT; zp6 : "
           "BOOL; "
           "END_VAR\n";
  }

  std::string statement(Material& m) const override {
    const auto n = [&](std::int64_t last) { return std::to_string(m.random.between(0, last)); };
    switch (m.random.below(12)) {
      case 0:
        return "zp1.%B" + n(7) + " := " + m.value(Scalar::Byte) + ";";
      case 1:
        return "zp1.%W" + n(3) + " := zp3;";
      case 2:
        return "zp1.%D" + n(1) + " := " + m.value(Scalar::Dword) + ";";
      case 3:
        return "zp2.%X" + n(31) + " := " + m.value(Scalar::Bool) + ";";
      case 4:
        return "zp4 := zp1.%B" + n(7) + " XOR zp2.%B" + n(3) + ";";
      case 5:
        return "zp3 := zp2.%W" + n(1) + ";";
      case 6:
        return "zp2 := zp1.%D" + n(1) + ";";
      case 7:
        return "zp2 := TO_BIG_ENDIAN(" + m.value(Scalar::Dword) + ");";
      case 8:
        return "zp3 := FROM_BIG_ENDIAN(zp3);";
      case 9:
        return "zp3 := UINT_TO_BCD_WORD(" + m.between(Scalar::Uint, 0, 9999) +
               "); zp5 := WORD_BCD_TO_UINT(zp3);";
      case 10:
        return "zp6 := IS_VALID_BCD(" + m.value(Scalar::Word) + ");";
      default:
        return "zp6 := IS_VALID(" + m.value(Scalar::Real) + ");";
    }
  }
};

}  // namespace

std::unique_ptr<Extra> bit_parts() {
  return std::make_unique<BitParts>();
}

}  // namespace stepwright::st_fuzz
