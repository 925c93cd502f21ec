#include "cell/device_status/lost_devices.h"

#include <gtest/gtest.h>

namespace stepwright::device_status {
namespace {

std::string device(const std::string& name, bool lost, const std::string& error = "") {
  return R"({"name":")" + name + R"(","endpoint":"10.0.0.2:502","lost":)" + (lost ? "true" : "false") +
         R"(,"error":")" + error + R"("})";
}

std::string status(const std::string& devices) {
  return R"({"cell":"c","devices":[)" + devices + "]}";
}

TEST(LostDevices, WhenSomeAreLost_ThenTheyAreNamedWithTheirReasons) {
  EXPECT_EQ(describe_lost(status(device("press", true, "no route to host") + "," + device("rack", false) +
                                 "," + device("oven", true))),
            "device 'press' (10.0.0.2:502): no route to host; device 'oven' (10.0.0.2:502) does not answer");
}

TEST(LostDevices, WhenThereAreMany_ThenTheSentenceIsBounded) {
  std::string all = device("d0", true);
  for (int i = 1; i < 20; ++i) all += "," + device("d" + std::to_string(i), true);
  const std::string told = describe_lost(status(all));
  EXPECT_NE(told.find("d7"), std::string::npos);
  EXPECT_EQ(told.find("d8"), std::string::npos);
  EXPECT_TRUE(told.ends_with("; and 12 others")) << told;
}

TEST(LostDevices, WhenNoneIsLostOrNothingIsUnderstood_ThenThatIsSaid) {
  EXPECT_NE(describe_lost(status(device("press", false))).find("has all its devices"), std::string::npos);
  for (const char* wrong :
       {"", "{", "[]", "{\"devices\":[{}]}", "{\"devices\":[{\"lost\":1}]}", "{\"devices\":3}"})
    EXPECT_EQ(describe_lost(wrong), "the Modbus client says what is not understood") << wrong;
}

TEST(LostDevices, WhenNobodyAnswers_ThenThatIsTheReason) {
  EXPECT_NE(ask_lost("/nonexistent/socket").find("R0127"), std::string::npos);
}

}  // namespace
}  // namespace stepwright::device_status
