// FC 43/14: who the device is.

#include "runtime/modbus/pdu/identification.h"

#include <gtest/gtest.h>

#include "runtime/modbus/pdu/serve.h"
#include "tests/unit/runtime/modbus/pdu/table_model.h"

namespace stepwright::modbus::pdu {
namespace {

class Identification : public testing::Test {
 protected:
  Bytes answer(unsigned code, unsigned object) {
    Bytes out(kMaxPdu);
    out.resize(serve(model_, bytes({43, 14, code, object}), out));
    return out;
  }

  TableModel model_;
};

TEST_F(Identification, WhenBasicStream_ThenTheThreeMandatoryObjects) {
  model_.objects = {"A", "BC", "1"};
  EXPECT_EQ(hex(answer(1, 0)), "2b 0e 01 82 00 00 03 00 01 41 01 02 42 43 02 01 31");
}

TEST_F(Identification, WhenRegularStream_ThenTheObjectsThatExist) {
  model_.objects = {"A", "B", "C", "", "E"};
  EXPECT_EQ(hex(answer(2, 0)), "2b 0e 02 82 00 00 04 00 01 41 01 01 42 02 01 43 04 01 45");
  EXPECT_EQ(hex(answer(3, 0)), "2b 0e 03 82 00 00 04 00 01 41 01 01 42 02 01 43 04 01 45");
  EXPECT_EQ(hex(answer(2, 4)), "2b 0e 02 82 00 00 01 04 01 45");
}

TEST_F(Identification, WhenAStreamBeginsAtAnUnknownObject_ThenAtTheFirst) {
  model_.objects = {"A", "B", "C"};
  EXPECT_EQ(hex(answer(1, 5)), "2b 0e 01 82 00 00 03 00 01 41 01 01 42 02 01 43");
  EXPECT_EQ(answer(2, 200), answer(2, 0));
}

TEST_F(Identification, WhenOneObject_ThenItOrException2) {
  model_.objects = {"A", "B", "C"};
  EXPECT_EQ(hex(answer(4, 1)), "2b 0e 04 82 00 00 01 01 01 42");
  EXPECT_EQ(hex(answer(4, 3)), "ab 02");
  EXPECT_EQ(hex(answer(4, 255)), "ab 02");
}

TEST_F(Identification, WhenTheCodeIsNone_ThenException3) {
  EXPECT_EQ(hex(answer(0, 0)), "ab 03");
  EXPECT_EQ(hex(answer(5, 0)), "ab 03");
  Bytes out(kMaxPdu);
  EXPECT_EQ(serve(model_, bytes({43, 13, 1, 0}), out), 2u);
  EXPECT_EQ(out[1], std::byte{1});
}

TEST_F(Identification, WhenTheObjectsDoNotFit_ThenMoreFollows) {
  model_.objects = {std::string(200, 'a'), std::string(200, 'b'), "c"};
  const Bytes first = answer(1, 0);
  EXPECT_EQ(hex(std::span(first).first(7)), "2b 0e 01 82 ff 01 01");
  EXPECT_EQ(first.size(), 7u + 202u);
  const Bytes second = answer(1, 1);
  EXPECT_EQ(hex(std::span(second).first(7)), "2b 0e 01 82 00 00 02");
  EXPECT_EQ(second.size(), 7u + 202u + 3u);
}

}  // namespace
}  // namespace stepwright::modbus::pdu
