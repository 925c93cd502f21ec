#include "runtime/modbus/client/poll/conversion.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace stepwright::modbus::client {
namespace {

using Words = std::vector<std::uint16_t>;

Tag tag_of(WireType wire, ImageType image, Order order = Order::Abcd) {
  Tag tag;
  tag.wire = wire;
  tag.order = order;
  tag.field.type = image;
  return tag;
}

double read(const Tag& tag, const Words& words) {
  return number_of(tag.field.type, to_image(tag, words).bits);
}

TEST(Conversion, WhenTheOrderIsGiven_ThenTheBytesAreTakenInIt) {
  constexpr double kValue = 0x0A0B0C0D;
  EXPECT_EQ(read(tag_of(WireType::Uint32, ImageType::Udint, Order::Abcd), {0x0A0B, 0x0C0D}), kValue);
  EXPECT_EQ(read(tag_of(WireType::Uint32, ImageType::Udint, Order::Cdab), {0x0C0D, 0x0A0B}), kValue);
  EXPECT_EQ(read(tag_of(WireType::Uint32, ImageType::Udint, Order::Badc), {0x0B0A, 0x0D0C}), kValue);
  EXPECT_EQ(read(tag_of(WireType::Uint32, ImageType::Udint, Order::Dcba), {0x0D0C, 0x0B0A}), kValue);
  EXPECT_EQ(read(tag_of(WireType::Uint16, ImageType::Uint, Order::Badc), {0x0B0A}), 0x0A0B);
  EXPECT_EQ(to_image(tag_of(WireType::Uint64, ImageType::Ulint, Order::Cdab), Words{4, 3, 2, 1}).bits,
            0x0001'0002'0003'0004u);
}

// Values from IEEE 754: 123.456 as REAL is 0x42F6E979, -2.5 as LREAL is 0xC004000000000000.
TEST(Conversion, WhenTheNumberIsReal_ThenItIsThatOfTheStandard) {
  EXPECT_FLOAT_EQ(static_cast<float>(read(tag_of(WireType::Real, ImageType::Real), {0x42F6, 0xE979})),
                  123.456f);
  EXPECT_EQ(read(tag_of(WireType::Lreal, ImageType::Lreal), {0xC004, 0, 0, 0}), -2.5);
  const WireValue wire = to_wire(tag_of(WireType::Real, ImageType::Real, Order::Cdab), 0x42F6E979);
  EXPECT_EQ(wire.words[0], 0xE979);
  EXPECT_EQ(wire.words[1], 0x42F6);
}

TEST(Conversion, WhenAWholeNumberHasNoScale_ThenNoBitIsLost) {
  const Words largest(4, 0xFFFF);
  EXPECT_EQ(to_image(tag_of(WireType::Uint64, ImageType::Ulint), largest).bits, ~std::uint64_t{0});
  const auto odd = to_image(tag_of(WireType::Int64, ImageType::Lint), Words{0x7FFF, 0xFFFF, 0xFFFF, 0xFFFD});
  EXPECT_EQ(odd.bits, 0x7FFF'FFFF'FFFF'FFFDu);
  EXPECT_FALSE(odd.exceeded);
}

TEST(Conversion, WhenTheTargetIsTooSmall_ThenTheValueIsHeldAtItsEndAndSaid) {
  const auto check = [](WireType wire, ImageType image, const Words& words, double value) {
    const ImageValue got = to_image(tag_of(wire, image), words);
    EXPECT_EQ(number_of(image, got.bits), value);
    EXPECT_TRUE(got.exceeded);
  };
  check(WireType::Uint16, ImageType::Int, {40'000}, 32'767);
  check(WireType::Int16, ImageType::Uint, {0xFFFF}, 0);
  check(WireType::Int32, ImageType::Int, {0xFFFF, 0x0000}, -32'768);
  check(WireType::Uint64, ImageType::Lint, {0xFFFF, 0, 0, 0}, 9.223372036854775807e18);
  check(WireType::Int16, ImageType::Usint, {0xFFFF}, 0);
  check(WireType::Lreal, ImageType::Real, {0x7FE0, 0, 0, 0}, std::numeric_limits<float>::max());
  EXPECT_TRUE(to_wire(tag_of(WireType::Int16, ImageType::Dint), 40'000).exceeded);
  EXPECT_EQ(to_wire(tag_of(WireType::Int16, ImageType::Dint), 40'000).words[0], 0x7FFF);
  EXPECT_EQ(to_wire(tag_of(WireType::Uint16, ImageType::Int), 0xFFFF).words[0], 0);  // -1
}

TEST(Conversion, WhenItIsScaled_ThenBothWaysAreTheSameLine) {
  Tag tag = tag_of(WireType::Int16, ImageType::Real);
  tag.scale = {0.1, -20.0, std::nullopt, std::nullopt};
  EXPECT_NEAR(read(tag, {1'235}), 103.5, 1e-5);
  EXPECT_NEAR(read(tag, {0xFFFF}), -20.1, 1e-5);
  const std::uint64_t bits = image_bits_of(ImageType::Real, 103.5);
  EXPECT_EQ(to_wire(tag, bits).words[0], 1'235);
  tag.field.type = ImageType::Int;
  EXPECT_EQ(read(tag, {1'239}), 104);  // 103.9, to the nearest
}

TEST(Conversion, WhenItHasLimits_ThenTheyHoldInTheUnitsOfTheImage) {
  Tag tag = tag_of(WireType::Uint16, ImageType::Real);
  tag.scale = {0.5, 0.0, 10.0, 20.0};
  EXPECT_EQ(read(tag, {100}), 20.0);
  EXPECT_TRUE(to_image(tag, Words{100}).exceeded);
  EXPECT_EQ(read(tag, {30}), 15.0);
  EXPECT_FALSE(to_image(tag, Words{30}).exceeded);
  const WireValue low = to_wire(tag, image_bits_of(ImageType::Real, 1.0));
  EXPECT_EQ(low.words[0], 20);
  EXPECT_TRUE(low.exceeded);
}

TEST(Conversion, WhenItIsNotANumber_ThenThatIsSaid) {
  EXPECT_TRUE(to_image(tag_of(WireType::Real, ImageType::Real), Words{0x7FC0, 0}).not_a_number);
  EXPECT_TRUE(to_image(tag_of(WireType::Real, ImageType::Int), Words{0x7FC0, 0}).not_a_number);
  const WireValue wire = to_wire(tag_of(WireType::Int16, ImageType::Real), 0x7FC00000);
  EXPECT_TRUE(wire.exceeded);
  EXPECT_EQ(wire.words[0], 0);
}

TEST(Conversion, WhenItIsABit_ThenItIsThatOne) {
  Tag tag = tag_of(WireType::Bool, ImageType::Bool);
  tag.bit = 9;
  EXPECT_EQ(to_image(tag, Words{0x0200}).bits, 1u);
  EXPECT_EQ(to_image(tag, Words{0xFDFF}).bits, 0u);
  tag.order = Order::Badc;
  EXPECT_EQ(to_image(tag, Words{0x0002}).bits, 1u);
}

// What goes out and comes back is the same, for every order and type.
TEST(Conversion, WhenARandomValueGoesThereAndBack_ThenItIsTheSame) {
  std::mt19937_64 random(11);
  struct Pair {
    WireType wire;
    ImageType image;
  };
  for (const Pair& pair : {Pair{WireType::Int16, ImageType::Int},
                           {WireType::Uint16, ImageType::Uint},
                           {WireType::Int32, ImageType::Dint},
                           {WireType::Uint32, ImageType::Udint},
                           {WireType::Int64, ImageType::Lint},
                           {WireType::Uint64, ImageType::Ulint}}) {
    for (const Order order : {Order::Abcd, Order::Cdab, Order::Badc, Order::Dcba}) {
      const Tag tag = tag_of(pair.wire, pair.image, order);
      for (int i = 0; i < 200; ++i) {
        const std::uint64_t bits = random() >> (64 - 8 * bytes_of(pair.image));
        const WireValue wire = to_wire(tag, bits);
        ASSERT_EQ(to_image(tag, std::span(wire.words).first(tag.count())).bits, bits);
        ASSERT_FALSE(wire.exceeded);
      }
    }
  }
}

TEST(Conversion, WhenAFieldIsPut_ThenItsNeighboursStay) {
  std::vector<std::byte> area(8, std::byte{0xFF});
  put_field(area, {2, 0, ImageType::Int}, 0x1234);
  EXPECT_EQ(area[1], std::byte{0xFF});
  EXPECT_EQ(area[2], std::byte{0x34});
  EXPECT_EQ(area[4], std::byte{0xFF});
  put_field(area, {5, 3, ImageType::Bool}, 0);
  EXPECT_EQ(area[5], std::byte{0xF7});
  EXPECT_EQ(get_field(area, {5, 3, ImageType::Bool}), 0u);
  EXPECT_EQ(get_field(area, {2, 0, ImageType::Int}), 0x1234u);
}

}  // namespace
}  // namespace stepwright::modbus::client
