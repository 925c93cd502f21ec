#include "plant_models/fmu/model_instance.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

namespace stepwright::fmu {
namespace {

ModelDescription description_of(const std::string& name) {
  std::ifstream in(std::string(STEPWRIGHT_SOURCE_DIR) + "/tests/cells/shared_plant/fmu/" + name + ".xml");
  const std::string xml{std::istreambuf_iterator<char>(in), {}};
  return parse_description(xml, name).value();
}

std::string library_of(const std::string& name) {
  return std::string(STEPWRIGHT_TESTS_DIR) + "/" + name + ".so";
}

class ModelInstanceOf : public testing::TestWithParam<const char*> {
 protected:
  ModelDescription model_ = description_of(GetParam());
  std::unique_ptr<ModelInstance> made() const {
    return make_instance(model_, library_of(GetParam()), "/nowhere/some folder").value();
  }
  double number(ModelInstance& instance, const char* name) const {
    double found = -1.0;
    EXPECT_TRUE(instance.get(*model_.find(name), found)) << name;
    return found;
  }
};

TEST_P(ModelInstanceOf, WhenItIsStepped_ThenNumbersOfAllTypesGoInAndOut) {
  const auto tank = made();
  ASSERT_TRUE(tank->set(*model_.find("area"), 2.0));
  ASSERT_TRUE(tank->begin_initialization());
  ASSERT_TRUE(tank->finish_initialization());
  EXPECT_EQ(number(*tank, "level"), 0.2);
  ASSERT_TRUE(tank->set(*model_.find("valve"), 1.0));
  for (int i = 0; i < 10; ++i) ASSERT_TRUE(tank->step(0.1 * i, 0.1));
  EXPECT_NEAR(number(*tank, "level"), 0.2 + 0.01 / 2.0, 1e-12);
  EXPECT_EQ(number(*tank, "steps"), 10.0);
  EXPECT_EQ(number(*tank, "full"), 0.0);
  ASSERT_TRUE(tank->set(*model_.find("leak"), -1e6));
  ASSERT_TRUE(tank->step(1.0, 0.1));
  EXPECT_EQ(number(*tank, "full"), 1.0);
}

TEST_P(ModelInstanceOf, WhenItRefuses_ThenItsWordsAreKept) {
  const auto tank = made();
  ASSERT_TRUE(tank->set(*model_.find("area"), -1.0));
  ASSERT_TRUE(tank->begin_initialization());
  EXPECT_FALSE(tank->finish_initialization());
  EXPECT_NE(tank->said().find("no tank has"), std::string::npos);
}

TEST_P(ModelInstanceOf, WhenAStepFails_ThenItSaysWhy) {
  const auto tank = made();
  ASSERT_TRUE(tank->begin_initialization());
  ASSERT_TRUE(tank->finish_initialization());
  ASSERT_TRUE(tank->set(*model_.find("trap"), 3.0));
  EXPECT_FALSE(tank->step(0.0, 0.1));
  EXPECT_NE(tank->said().find("gave up"), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(Versions, ModelInstanceOf, testing::Values("tank2", "tank3"));

TEST(ModelInstance, WhenTheLibraryIsNone_ThenItSaysSo) {
  const ModelDescription model = description_of("tank2");
  EXPECT_EQ(make_instance(model, "/no/such.so", "/nowhere").error().front().code, "C0334");
}

TEST(ModelInstance, WhenTheLibraryIsOfTheOtherVersion_ThenWhatItLacksIsNamed) {
  const auto made = make_instance(description_of("tank2"), library_of("tank3"), "/nowhere");
  ASSERT_FALSE(made);
  EXPECT_NE(made.error().front().message.find("fmi2Instantiate"), std::string::npos);
}

TEST(ModelInstance, WhenTheTokenIsAnotherOne_ThenTheFmuMakesNoInstance) {
  ModelDescription model = description_of("tank3");
  model.token = "another";
  const auto made = make_instance(model, library_of("tank3"), "/nowhere");
  ASSERT_FALSE(made);
  EXPECT_NE(made.error().front().message.find("no instance"), std::string::npos);
}

}  // namespace
}  // namespace stepwright::fmu
