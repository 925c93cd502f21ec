// Literals that mean a value, and others: the page holds the same ones against values by itself
// (tests/unit/hmi_web/client/literals_test.mjs).

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cstring>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "runtime/bytecode/reader/parse_string.h"
#include "runtime/bytecode/reader/parse_value.h"
#include "runtime/bytecode/reader/read_value.h"

namespace stepwright::reader {
namespace {

using bytecode::ElementaryType;
using nlohmann::json;

constexpr std::uint16_t kCapacity = 40;

ElementaryType type_named(const std::string& name) {
  for (std::uint8_t i = 0; i < bytecode::kElementaryTypeCount; ++i) {
    const auto type = static_cast<ElementaryType>(i);
    if (bytecode::name_of(type) == name) return type;
  }
  ADD_FAILURE() << name;
  return {};
}

Variable variable_of(const json& group) {
  Variable variable;
  variable.type = type_named(group["type"]);
  variable.capacity = kCapacity;
  if (!group.contains("names")) return variable;
  Enumerators names;
  for (const auto& [number, name] : group["names"].items()) names.emplace(std::stoll(number), name);
  variable.enumerators = std::make_shared<const Enumerators>(std::move(names));
  return variable;
}

// The variable's memory with that value; empty for no literal of its type.
std::vector<std::byte> image_of(const Variable& variable, const std::string& literal) {
  if (bytecode::is_string(variable.type)) {
    const auto bytes = parse_string(variable, literal);
    if (!bytes) return {};
    std::vector<std::byte> image(bytecode::string_bytes(variable.type, variable.capacity));
    std::memcpy(image.data(), &variable.capacity, sizeof variable.capacity);
    std::memcpy(image.data() + kStringLengthAt, bytes->data(), bytes->size());
    return image;
  }
  const auto bits = parse_value(variable, literal);
  if (!bits) return {};
  const auto bytes = std::bit_cast<std::array<std::byte, sizeof *bits>>(*bits);
  return {bytes.begin(), bytes.end()};
}

bool means(const std::string& literal, const json& group) {
  const Variable variable = variable_of(group);
  const std::vector<std::byte> image = image_of(variable, literal);
  if (image.empty()) return false;
  const json& value = group["value"];
  return value.is_string() ? read_text(variable, image) == value.get<std::string>()
                           : read_quantity(variable, image) == value.get<double>();
}

TEST(Literals, WhenTheyMeanAValue_ThenTheyAreReadAsIt) {
  std::ifstream file(STEPWRIGHT_SOURCE_DIR "/tests/unit/hmi_web/client/literals.json");
  const json groups = json::parse(file);
  ASSERT_GE(groups.size(), 15U);
  for (const json& group : groups) {
    for (const std::string literal : group["same"]) EXPECT_TRUE(means(literal, group)) << literal << group;
    for (const std::string literal : group["others"]) EXPECT_FALSE(means(literal, group)) << literal << group;
  }
}

}  // namespace
}  // namespace stepwright::reader
