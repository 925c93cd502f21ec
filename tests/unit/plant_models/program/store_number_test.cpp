#include "plant_models/program/store_number.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace stepwright::program_plant {
namespace {

using bytecode::ElementaryType;

double stored(ElementaryType type, double number) {
  std::array<std::byte, 16> image{};
  const reader::Variable variable{.type = type, .address = 3};
  store_number(variable, number, image);
  return reader::read_number(variable, image);
}

TEST(StoreNumber, WhenItFits_ThenItIsReadAgain) {
  for (const auto type :
       {ElementaryType::Sint, ElementaryType::Int, ElementaryType::Dint, ElementaryType::Lint,
        ElementaryType::Time, ElementaryType::Real, ElementaryType::Lreal}) {
    EXPECT_EQ(stored(type, -100.0), -100.0);
  }
  for (const auto type : {ElementaryType::Usint, ElementaryType::Uint, ElementaryType::Udint,
                          ElementaryType::Ulint, ElementaryType::Byte, ElementaryType::Dword}) {
    EXPECT_EQ(stored(type, 200.0), 200.0);
  }
  EXPECT_EQ(stored(ElementaryType::Lreal, 0.1), 0.1);
  EXPECT_EQ(stored(ElementaryType::Bool, -0.5), 1.0);
  EXPECT_EQ(stored(ElementaryType::Int, 2.6), 3.0);
}

TEST(StoreNumber, WhenItIsBeyondItsType_ThenItStaysAtItsEnd) {
  EXPECT_EQ(stored(ElementaryType::Int, 1e9), 32'767.0);
  EXPECT_EQ(stored(ElementaryType::Int, -1e9), -32'768.0);
  EXPECT_EQ(stored(ElementaryType::Uint, -1.0), 0.0);
  EXPECT_EQ(stored(ElementaryType::Udint, 1e20), 4'294'967'295.0);
  EXPECT_EQ(stored(ElementaryType::Lint, HUGE_VAL), 9'223'372'036'854'775'807.0);
  EXPECT_EQ(stored(ElementaryType::Dint, std::nan("")), 0.0);
}

TEST(StoreNumber, WhenItIsABitOfAByte_ThenTheOthersStay) {
  std::array<std::byte, 4> image{std::byte{0xF0}};
  const reader::Variable bit{.type = ElementaryType::Bool, .address = 0, .bit = 1};
  store_number(bit, 1.0, image);
  EXPECT_EQ(image[0], std::byte{0xF2});
  store_number(bit, 0.0, image);
  EXPECT_EQ(image[0], std::byte{0xF0});
}

TEST(StoreNumber, WhenTheVariableLiesOutside_ThenNothingIsWritten) {
  std::array<std::byte, 4> image{};
  store_number({.type = ElementaryType::Lreal, .address = 0}, 1.0, image);
  store_number({.type = ElementaryType::Int, .address = 3}, 1.0, image);
  store_number({.type = ElementaryType::String, .address = 0}, 1.0, image);
  EXPECT_EQ(image, (std::array<std::byte, 4>{}));
}

}  // namespace
}  // namespace stepwright::program_plant
