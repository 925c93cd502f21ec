#include "plant_models/fmu/model_instance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <fstream>
#include <iterator>

#include "plant_models/fmu/numbers.h"

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

double number_of(const ModelDescription& model, ModelInstance& instance, const char* name) {
  double found = -1.0;
  EXPECT_TRUE(instance.get(*model.find(name), found)) << name;
  return found;
}

class ModelInstanceOf : public testing::TestWithParam<const char*> {
 protected:
  ModelDescription model_ = description_of(GetParam());
  std::unique_ptr<ModelInstance> made() const {
    return make_instance(model_, library_of(GetParam()), "/nowhere/some folder").value();
  }
  double number(ModelInstance& instance, const char* name) const { return number_of(model_, instance, name); }
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

TEST(ModelInstance, WhenVariablesAreArrays_ThenEachElementGoesInAndOut) {
  const ModelDescription model = description_of("mixer3");
  const auto mixer = make_instance(model, library_of("mixer3"), "/nowhere").value();
  const auto set = [&](const char* name, double value) {
    ASSERT_TRUE(mixer->set(*model.find(name), value)) << name;
  };
  set("share[2,1]", 0.5);
  set("share[2,3]", -1.0);
  ASSERT_TRUE(mixer->begin_initialization());
  set("inflow[3]", 4.0);
  ASSERT_TRUE(mixer->finish_initialization());
  EXPECT_EQ(number_of(model, *mixer, "outflow[1]"), 1.0) << "the start values: 1 of inflow 1";
  EXPECT_EQ(number_of(model, *mixer, "outflow[2]"), 0.5 * 1.0 + 2.0 - 4.0);
  set("inflow[1]", 10.0);
  set("open[2]", 0.0);
  ASSERT_TRUE(mixer->step(0.0, 0.1));
  EXPECT_EQ(number_of(model, *mixer, "outflow[1]"), 10.0);
  EXPECT_EQ(number_of(model, *mixer, "outflow[2]"), 0.0);
  EXPECT_EQ(number_of(model, *mixer, "steps[1]"), 1.0);
  EXPECT_EQ(number_of(model, *mixer, "steps[2]"), 0.0) << "closed";
  set("open[2]", 1.0);
  ASSERT_TRUE(mixer->step(0.1, 0.1));
  EXPECT_EQ(number_of(model, *mixer, "outflow[2]"), 5.0 + 2.0 - 4.0);
  EXPECT_EQ(number_of(model, *mixer, "steps[2]"), 1.0);
}

TEST(ModelInstance, WhenAnArrayIsOfAnotherSizeThanItsDescription_ThenTheFmuRefusesIt) {
  ModelDescription model = description_of("mixer3");
  for (ModelVariable& each : model.variables)
    if (each.name.starts_with("outflow")) each.elements = 3;
  const auto mixer = make_instance(model, library_of("mixer3"), "/nowhere").value();
  double number = 0.0;
  EXPECT_FALSE(mixer->get(*model.find("outflow[1]"), number));
}

TEST(Numbers, WhenTheyAreBeyondAType_ThenItsEndIsTaken) {
  EXPECT_EQ(nearest<std::uint8_t>(300.0), 255u);
  EXPECT_EQ(nearest<std::uint8_t>(-1.0), 0u);
  EXPECT_EQ(nearest<std::int64_t>(1e30), INT64_MAX);
  EXPECT_EQ(nearest<std::uint64_t>(1e30), UINT64_MAX);
  EXPECT_EQ(nearest<std::int32_t>(-2.7), -2);
  EXPECT_EQ(nearest<std::int16_t>(std::nan("")), 0);
  EXPECT_TRUE(nearest<bool>(0.1));
  EXPECT_EQ(nearest<double>(1e300), 1e300);
}

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
