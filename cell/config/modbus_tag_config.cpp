#include "cell/config/modbus_tag_config.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "runtime/ground/naming/direct_address.h"
#include "runtime/modbus/map/table.h"

namespace stepwright::config {
namespace {

using modbus::client::ImageField;
using modbus::client::ImageType;
using modbus::client::LossValue;
using modbus::client::Tag;
using modbus::client::WireType;
using modbus::map::kLastAddress;
using settings::TomlTable;

// A number of the slave and what it is without further words in the program.
struct WireName {
  const char* name;
  WireType type;
  ImageType natural;
};
constexpr std::array kWireTypes = {
    WireName{"int16", WireType::Int16, ImageType::Int},
    WireName{"uint16", WireType::Uint16, ImageType::Uint},
    WireName{"int32", WireType::Int32, ImageType::Dint},
    WireName{"uint32", WireType::Uint32, ImageType::Udint},
    WireName{"int64", WireType::Int64, ImageType::Lint},
    WireName{"uint64", WireType::Uint64, ImageType::Ulint},
    WireName{"real", WireType::Real, ImageType::Real},
    WireName{"lreal", WireType::Lreal, ImageType::Lreal},
    WireName{"bool", WireType::Bool, ImageType::Bool},
};

// The first of a width is the one that an address has without further words, as in [safe_state].
struct ImageName {
  const char* name;
  ImageType type;
};
constexpr std::array kImageTypes = {
    ImageName{"BOOL", ImageType::Bool},   ImageName{"USINT", ImageType::Usint},
    ImageName{"SINT", ImageType::Sint},   ImageName{"INT", ImageType::Int},
    ImageName{"UINT", ImageType::Uint},   ImageName{"DINT", ImageType::Dint},
    ImageName{"UDINT", ImageType::Udint}, ImageName{"REAL", ImageType::Real},
    ImageName{"LINT", ImageType::Lint},   ImageName{"ULINT", ImageType::Ulint},
    ImageName{"LREAL", ImageType::Lreal},
};

std::uint8_t bits_of(ImageType type) {
  return type == ImageType::Bool ? std::uint8_t{1}
                                 : static_cast<std::uint8_t>(8 * modbus::client::bytes_of(type));
}

template <typename Names>
std::vector<std::string> words_of(const Names& names) {
  std::vector<std::string> words;
  for (const auto& entry : names) words.emplace_back(entry.name);
  return words;
}

class TagReader {
 public:
  TagReader(const TomlTable& table, const ModbusTagFrame& frame, result::Diagnostics& problems)
      : table_(table), frame_(frame), problems_(problems) {}

  std::optional<ReadModbusTag> read() {
    Tag& tag = read_.tag;
    tag.where = table_.where("address");
    tag.address = table_.required_text("address");
    tag.name = table_.text("name", tag.address);
    const bool addressed = read_address();
    const bool joined = read_object();
    tag.order = read_modbus_order(table_, frame_.order);
    const bool typed = addressed && joined && read_types();
    const bool scaled = read_scale();
    read_loss();
    if (const auto quality = read_input_field(table_, "quality", 8, frame_.input_bytes, problems_))
      tag.quality_byte = quality->byte;
    read_age();
    if (!addressed || !joined || !typed || !scaled) return std::nullopt;
    return std::move(read_);
  }

 private:
  bool fail(const char* code, const char* key, std::string message, std::string hint) {
    problems_.push_back({code, result::Severity::Error, table_.where(table_.has(key) ? key : ""),
                         std::move(message), std::move(hint)});
    return false;
  }

  bool read_address() {
    const std::string& text = read_.tag.address;
    if (text.empty()) return false;  // told
    address_ = naming::parse_direct_address(text);
    if (!address_)
      return fail("C0302", "address", "'" + text + "' is no address", "for example %IX0.3, %IW2 or %QD3");
    read_.output = address_->area == naming::Area::Output;
    const std::uint32_t bytes = read_.output ? frame_.output_bytes : frame_.input_bytes;
    const std::uint32_t end = address_->byte + std::max(1, address_->bits / 8);
    if (address_->area == naming::Area::Marker || end > bytes) {
      const char* const key = read_.output ? "output_bytes" : "input_bytes";
      return fail("C0303", "address", text + " is not among the inputs and outputs of the cell",
                  "the area has " + std::to_string(bytes) + " bytes, see [image] " + key);
    }
    read_.tag.field.byte = address_->byte;
    read_.tag.field.bit = address_->bit;
    return true;
  }

  bool read_object() {
    using Object = std::pair<const char*, modbus::client::Table>;
    constexpr std::array kObjects = {Object{"coil", modbus::client::Table::Coils},
                                     Object{"discrete", modbus::client::Table::DiscreteInputs},
                                     Object{"input", modbus::client::Table::InputRegisters},
                                     Object{"holding", modbus::client::Table::HoldingRegisters}};
    int found = 0;
    const char* key = "";
    for (const auto& [name, table] : kObjects) {
      if (!table_.has(name)) continue;
      ++found;
      key = name;
      read_.tag.table = table;
      read_.tag.first = static_cast<std::uint16_t>(table_.integer(name, 0, {0, kLastAddress}));
    }
    if (table_.has("bit")) read_.tag.bit = static_cast<std::uint8_t>(table_.integer("bit", 0, {0, 15}));
    if (found != 1) {
      return fail(
          "C0522", "address",
          "this tag names " + std::string(found == 0 ? "no object" : "several objects") + " of the device",
          "one of coil, discrete, input and holding, with the address from 0: holding = 100");
    }
    const bool writable = read_.tag.table == modbus::client::Table::Coils ||
                          read_.tag.table == modbus::client::Table::HoldingRegisters;
    if (read_.output && !writable)
      return fail("C0522", key, "a master cannot write this table",
                  "coil or holding for %Q, or read it into %I");
    return true;
  }

  bool read_types() {
    Tag& tag = read_.tag;
    const bool one_bit = address_->bits == 1;
    const bool bit_object = modbus::client::is_bits(tag.table) || tag.bit != Tag::kWholeRegister;
    if (one_bit != bit_object) {
      return fail("C0525", "address",
                  one_bit ? "a register does not fit into " + tag.address
                          : "a bit of the device does not fill " + tag.address,
                  one_bit ? "bit = 0 to 15 takes one of the register's" : "bits belong to %IX and %QX");
    }
    const char* const usual = one_bit                ? "bool"
                              : address_->bits == 8  ? "uint16"
                              : address_->bits == 16 ? "int16"
                              : address_->bits == 32 ? "int32"
                                                     : "int64";
    const std::string name = table_.choice("type", usual, words_of(kWireTypes));
    const WireName& wire =
        *std::ranges::find_if(kWireTypes, [&](const auto& entry) { return entry.name == name; });
    if ((wire.type == WireType::Bool) != one_bit)
      return fail("C0525", "type", "the type " + name + " does not fit " + tag.address,
                  "bool goes with bits only");
    tag.wire = wire.type;
    const ImageName& plain = *std::ranges::find_if(
        kImageTypes, [&](const auto& entry) { return bits_of(entry.type) == address_->bits; });
    tag.field.type = bits_of(wire.natural) == address_->bits ? wire.natural : plain.type;
    if (table_.has("iec") && !read_iec()) return false;
    if (tag.end() <= kLastAddress + 1) return true;
    return fail("C0522", "address", "the number goes beyond the last address, 65535", "");
  }

  bool read_iec() {
    const std::string name = table_.choice("iec", "BOOL", words_of(kImageTypes));
    const ImageName& found =
        *std::ranges::find_if(kImageTypes, [&](const auto& entry) { return entry.name == name; });
    if (bits_of(found.type) != address_->bits) {
      return fail("C0525", "iec",
                  name + " has " + std::to_string(bits_of(found.type)) + " bits, " + read_.tag.address +
                      " has " + std::to_string(address_->bits),
                  "");
    }
    read_.tag.field.type = found.type;
    return true;
  }

  bool read_scale() {
    modbus::client::Scale& scale = read_.tag.scale;
    scale.factor = table_.number("factor", 1.0);
    scale.offset = table_.number("offset", 0.0);
    if (table_.has("low")) scale.low = table_.number("low", 0.0);
    if (table_.has("high")) scale.high = table_.number("high", 0.0);
    if (scale.factor == 0.0) return fail("C0525", "factor", "a factor of 0 leaves nothing of the value", "");
    if (scale.low && scale.high && *scale.low > *scale.high)
      return fail("C0525", "low", "the lower limit lies above the upper one", "");
    const bool bits = address_ && address_->bits == 1;
    if (bits && !scale.plain()) return fail("C0525", "address", "a bit has neither scale nor limits", "");
    return true;
  }

  void read_loss() {
    Tag& tag = read_.tag;
    tag.on_loss = frame_.on_loss;
    if (table_.has("loss_value")) {
      tag.on_loss = LossValue::Value;
      tag.loss_value = table_.number("loss_value", 0.0);
      if (read_.output)
        fail("C0525", "loss_value", "an output has no value on loss here",
             "[safe_state] says what outputs do");
    } else if (tag.on_loss == LossValue::Value && !read_.output) {
      fail("C0525", "address", "this tag does not say what it is when the device is lost",
           "loss_value = 0, or another on_loss of the device");
    }
  }

  void read_age() {
    if (!table_.has("age")) return;
    const auto address = naming::parse_direct_address(table_.text("age", {}));
    const std::uint8_t bits = address && address->bits == 32 ? std::uint8_t{32} : std::uint8_t{16};
    read_.tag.age = read_input_field(table_, "age", bits, frame_.input_bytes, problems_);
    if (read_.tag.age) read_.tag.age->type = bits == 32 ? ImageType::Udint : ImageType::Uint;
  }

  const TomlTable& table_;
  const ModbusTagFrame& frame_;
  result::Diagnostics& problems_;
  std::optional<naming::DirectAddress> address_;
  ReadModbusTag read_;
};

}  // namespace

std::optional<ReadModbusTag> read_modbus_tag(const TomlTable& table, const ModbusTagFrame& frame,
                                             result::Diagnostics& problems) {
  return TagReader(table, frame, problems).read();
}

modbus::client::Order read_modbus_order(const TomlTable& table, modbus::client::Order fallback) {
  static const std::vector<std::string> kOrders = {"ABCD", "CDAB", "BADC", "DCBA"};
  const std::string word = table.choice("order", kOrders[static_cast<std::size_t>(fallback)], kOrders);
  return static_cast<modbus::client::Order>(std::ranges::find(kOrders, word) - kOrders.begin());
}

std::optional<ImageField> read_input_field(const TomlTable& table, const char* key, std::uint8_t bits,
                                           std::uint32_t input_bytes, result::Diagnostics& problems) {
  const std::string text = table.text(key, {});
  if (!table.has(key)) return std::nullopt;
  const auto address = naming::parse_direct_address(text);
  const auto fail = [&](const char* code, std::string message, std::string hint) {
    problems.push_back(
        {code, result::Severity::Error, table.where(key), std::move(message), std::move(hint)});
    return std::nullopt;
  };
  if (!address || address->bits != bits) {
    const char* const example = bits == 1 ? "%IX5.0" : bits == 8 ? "%IB20" : "%IW10 or %ID5";
    return fail("C0302", "'" + text + "' is no address that this can have",
                std::string("for example ") + example);
  }
  const std::uint32_t end = address->byte + std::max(1, bits / 8);
  if (address->area != naming::Area::Input || end > input_bytes) {
    return fail("C0303", text + " is not among the inputs of the cell",
                "the area has " + std::to_string(input_bytes) + " bytes, see [image] input_bytes");
  }
  return ImageField{address->byte, address->bit, ImageType::Bool};
}

}  // namespace stepwright::config
