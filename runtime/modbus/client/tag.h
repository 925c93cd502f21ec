#pragma once

// The vocabulary of remote I/O over Modbus: a tag joins an object of a slave (a coil, a bit, one to four
// registers) with a field of the process image, and says how the value is turned into the other's form.
// Plain data; any thread.

#include <cstdint>
#include <optional>
#include <string>

#include "runtime/ground/result/diagnostic.h"

namespace stepwright::modbus::client {

// Tables of a slave (Modbus Application Protocol V1.1b3, 4.3). Addresses are those of the PDU, from 0.
enum class Table : std::uint8_t { Coils, DiscreteInputs, InputRegisters, HoldingRegisters };

constexpr bool is_bits(Table table) {
  return table == Table::Coils || table == Table::DiscreteInputs;
}

// Type of the value in the slave.
enum class WireType : std::uint8_t { Bool, Int16, Uint16, Int32, Uint32, Int64, Uint64, Real, Lreal };

constexpr std::uint16_t registers_of(WireType type) {
  switch (type) {
    case WireType::Int32:
    case WireType::Uint32:
    case WireType::Real:
      return 2;
    case WireType::Int64:
    case WireType::Uint64:
    case WireType::Lreal:
      return 4;
    default:
      return 1;
  }
}

// How the bytes ABCD of a number, A the most significant, come over the wire. The protocol orders the bytes
// of a register only (ABCD within one); slaves differ for more.
enum class Order : std::uint8_t {
  Abcd,  // most significant register first
  Cdab,  // least significant register first
  Badc,  // bytes of each register exchanged
  Dcba,  // both
};

// Type of the value in the program (IEC 61131-3, 6.4.2).
enum class ImageType : std::uint8_t { Bool, Sint, Usint, Int, Uint, Dint, Udint, Lint, Ulint, Real, Lreal };

constexpr std::uint32_t bytes_of(ImageType type) {
  switch (type) {
    case ImageType::Bool:
    case ImageType::Sint:
    case ImageType::Usint:
      return 1;
    case ImageType::Int:
    case ImageType::Uint:
      return 2;
    case ImageType::Dint:
    case ImageType::Udint:
    case ImageType::Real:
      return 4;
    default:
      return 8;
  }
}

// A field of the input or output area. Numbers are little-endian.
struct ImageField {
  std::uint32_t byte = 0;
  std::uint8_t bit = 0;  // of the byte, ImageType::Bool only
  ImageType type = ImageType::Bool;
};

// image = wire x factor + offset, held between the limits; the other way round for outputs.
struct Scale {
  double factor = 1.0;  // not zero
  double offset = 0.0;
  std::optional<double> low;
  std::optional<double> high;

  bool plain() const { return factor == 1.0 && offset == 0.0 && !low && !high; }
};

// Value of an input when its slave is lost.
enum class LossValue : std::uint8_t { Hold, Zero, Value };

// How far a value may be trusted: the quality byte of OPC Data Access 2.05, 6.8 (192 good, 64 and more
// uncertain, below it bad), which HMIs know.
enum class Quality : std::uint8_t {
  NotConnected = 8,    // bad: no connection, or nothing read yet
  DeviceFailure = 12,  // bad: the slave refuses with an exception
  CommFailure = 24,    // bad: no answer in time, or a wrong one
  LastUsable = 68,     // uncertain: the newest attempt failed, the value is younger than loss_after
  RangeExceeded = 84,  // uncertain: the value was held at a limit, or is not a number
  Good = 192,
};

struct Tag {
  static constexpr std::uint8_t kWholeRegister = 0xFF;

  std::string name;
  std::string address;  // "%IW3", as it was written
  Table table = Table::HoldingRegisters;
  std::uint16_t first = 0;            // of the slave's objects
  std::uint8_t bit = kWholeRegister;  // 0 (least significant) to 15: of one register
  WireType wire = WireType::Uint16;
  Order order = Order::Abcd;
  ImageField field;
  Scale scale;
  LossValue on_loss = LossValue::Hold;        // inputs
  double loss_value = 0.0;                    // LossValue::Value, as the image has it
  std::optional<std::uint32_t> quality_byte;  // where its quality stands among the inputs
  std::optional<ImageField>
      age;  // where the age of its value stands there, in ms: UINT or UDINT, held at its end
  result::Location where;

  std::uint16_t count() const { return is_bits(table) ? std::uint16_t{1} : registers_of(wire); }
  std::uint32_t end() const { return std::uint32_t{first} + count(); }
};

inline const char* name_of(Quality quality) {
  switch (quality) {
    case Quality::NotConnected:
      return "bad: not connected";
    case Quality::DeviceFailure:
      return "bad: refused by the slave";
    case Quality::CommFailure:
      return "bad: no answer";
    case Quality::LastUsable:
      return "uncertain: last usable value";
    case Quality::RangeExceeded:
      return "uncertain: out of range";
    case Quality::Good:
      return "good";
  }
  return "";
}

}  // namespace stepwright::modbus::client
