#pragma once

// A program, its image in a snapshot, and a map on both.

#include <gtest/gtest.h>

#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "ladder/driver/compile.h"
#include "runtime/bytecode/reader/resolve_name.h"
#include "runtime/modbus/map/build_map.h"

namespace stepwright::modbus::map {

using pdu::Exception;

inline reader::ProgramInfo compiled(const std::string& source) {
  driver::CompileInput input;
  input.texts.push_back({"test.st", source});
  auto output = driver::compile(input);
  if (!output) throw std::runtime_error(result::to_string(output.error()));
  return reader::ProgramInfo::read(output->container).value();
}

class MappedProgram {
 public:
  MappedProgram(const std::string& source, const MapConfig& config)
      : info(compiled(source)),
        image(info.sizes().input_bytes + info.sizes().output_bytes + info.sizes().marker_bytes +
              info.sizes().data_bytes),
        built(build_map(info, config)),
        writer_(host::SnapshotWriter::create({}).value()),
        reader_(host::SnapshotReader::open(writer_->descriptor()).value()) {}

  template <typename T>
  void set(const std::string& name, T value) {
    const auto variable = reader::resolve_name(info, name).value().variable;
    if (variable.bit != bytecode::kNoBit) {
      const auto mask = static_cast<std::byte>(1u << variable.bit);
      image[variable.address] = value ? image[variable.address] | mask : image[variable.address] & ~mask;
      return;
    }
    std::memcpy(&image[variable.address], &value, sizeof value);
  }
  template <typename T>
  T get(const std::string& name) const {
    T value{};
    std::memcpy(&value, &image[reader::resolve_name(info, name).value().variable.address], sizeof value);
    return value;
  }

  // The registers as numbers; empty: an exception, which stands in `exception`.
  std::vector<std::uint16_t> registers(Table table, std::uint16_t address, std::uint16_t count) {
    std::vector<std::byte> words(count * 2u, std::byte{0xEE});
    read([&](const host::SnapshotView& view) {
      return built.map.read_registers(view, table, address, count, words);
    });
    std::vector<std::uint16_t> out;
    for (std::size_t i = 0; exception == Exception::None && i < count; ++i)
      out.push_back(static_cast<std::uint16_t>(std::to_integer<unsigned>(words[2 * i]) << 8 |
                                               std::to_integer<unsigned>(words[2 * i + 1])));
    return out;
  }
  // "0110"; empty: an exception.
  std::string bits(Table table, std::uint16_t address, std::uint16_t count) {
    std::vector<std::byte> packed((count + 7u) / 8u, std::byte{0xEE});
    read([&](const host::SnapshotView& view) {
      return built.map.read_bits(view, table, address, count, packed);
    });
    std::string out;
    for (std::size_t i = 0; exception == Exception::None && i < count; ++i)
      out += (std::to_integer<unsigned>(packed[i / 8]) >> i % 8 & 1) != 0 ? '1' : '0';
    return out;
  }
  Exception write(std::uint16_t address, const std::vector<std::uint16_t>& values) {
    std::vector<std::byte> words;
    for (const std::uint16_t value : values) {
      words.push_back(static_cast<std::byte>(value >> 8));
      words.push_back(static_cast<std::byte>(value & 0xFF));
    }
    Parts parts;
    return apply(built.map.write_registers(address, static_cast<std::uint16_t>(values.size()), words, parts),
                 parts);
  }
  Exception write_bits(std::uint16_t address, const std::string& values) {
    std::vector<std::byte> packed((values.size() + 7) / 8);
    for (std::size_t i = 0; i < values.size(); ++i)
      if (values[i] == '1') packed[i / 8] |= static_cast<std::byte>(1u << i % 8);
    Parts parts;
    return apply(built.map.write_coils(address, static_cast<std::uint16_t>(values.size()), packed, parts),
                 parts);
  }
  Exception mask(std::uint16_t address, std::uint16_t and_mask, std::uint16_t or_mask) {
    Parts parts;
    return apply(built.map.mask_register(address, and_mask, or_mask, parts), parts);
  }
  std::vector<std::string> codes() const {
    std::vector<std::string> out;
    for (const auto& problem : built.problems) out.push_back(problem.code);
    return out;
  }

  reader::ProgramInfo info;
  std::vector<std::byte> image;
  BuiltMap built;
  Exception exception = Exception::None;
  std::size_t parts_of_last_write = 0;

 private:
  template <typename Read>
  void read(const Read& from) {
    writer_->publish(1, 0, "", image, {});
    ASSERT_TRUE(reader_->consistent([&](const host::SnapshotView& view) { exception = from(view); }));
  }
  // As the runtime does it.
  Exception apply(Exception outcome, const Parts& parts) {
    parts_of_last_write = parts.size();
    for (const host::ImageBits& part : outcome == Exception::None ? parts : Parts{}) {
      for (std::size_t i = 0; i < 8; ++i) {
        const auto mask = static_cast<std::byte>(part.mask >> 8 * i & 0xFF);
        if (mask == std::byte{0}) continue;
        std::byte& byte = image.at(part.byte_offset + i);
        byte = (byte & ~mask) | (static_cast<std::byte>(part.value >> 8 * i & 0xFF) & mask);
      }
    }
    return outcome;
  }

  std::unique_ptr<host::SnapshotWriter> writer_;
  std::unique_ptr<host::SnapshotReader> reader_;
};

}  // namespace stepwright::modbus::map
