#include "tests/fuzz/modbus/seeds.h"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string_view>

namespace stepwright::fuzz::modbus {

namespace {

constexpr std::size_t kTcpHeader = 7;
constexpr std::uint8_t kUnit = 1;

void append_hex(std::string_view digits, Bytes& out) {
  if (digits.empty() || digits.size() % 2 != 0) throw std::invalid_argument("an odd number of digits");
  for (std::size_t i = 0; i < digits.size(); i += 2) {
    out.push_back(static_cast<std::uint8_t>(std::stoul(std::string(digits.substr(i, 2)), nullptr, 16)));
  }
}

Bytes bytes_of(std::istringstream& words) {
  Bytes out;
  for (std::string word; words >> word;) {
    const std::size_t star = word.find('*');
    if (star == std::string::npos) {
      append_hex(word, out);
      continue;
    }
    Bytes one;
    append_hex(std::string_view(word).substr(0, star), one);
    for (std::size_t left = std::stoul(word.substr(star + 1)); left > 0; --left)
      out.insert(out.end(), one.begin(), one.end());
  }
  return out;
}

void append_line(const std::string& line, Seeds& out) {
  std::istringstream words(line);
  std::string kind, name;
  words >> kind >> name;
  if (name.empty() || name.back() != ':') throw std::invalid_argument("no name");
  name.pop_back();
  Bytes bytes = bytes_of(words);
  if (kind == "pdu") {
    out.tcp.push_back({name, tcp_frame(bytes, 1)});
    out.rtu.push_back({name, rtu_frame(bytes, kAddress)});
  } else if (kind == "tcp") {
    out.tcp.push_back({name, std::move(bytes)});
  } else if (kind == "rtu") {
    out.rtu.push_back({name, std::move(bytes)});
  } else {
    throw std::invalid_argument("no kind");
  }
}

// Not pdu::crc16: a slave must not be tested with its own mistake (Modbus over Serial Line V1.02, 6.2.2).
std::uint16_t crc_of(const Bytes& bytes) {
  unsigned crc = 0xFFFF;
  for (const std::uint8_t byte : bytes) {
    crc ^= byte;
    for (int bit = 0; bit < 8; ++bit) crc = (crc & 1) != 0 ? (crc >> 1) ^ 0xA001u : crc >> 1;
  }
  return static_cast<std::uint16_t>(crc);
}

}  // namespace

Seeds read_seeds(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) throw std::runtime_error("cannot read " + file.string());
  Seeds out;
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line.front() == '#') continue;
    try {
      append_line(line, out);
    } catch (const std::logic_error& wrong) {
      throw std::runtime_error(file.string() + ": '" + line + "': " + wrong.what());
    }
  }
  return out;
}

Bytes tcp_frame(const Bytes& pdu, std::uint16_t transaction) {
  const std::size_t length = pdu.size() + 1;
  Bytes out(kTcpHeader + pdu.size());
  out[0] = static_cast<std::uint8_t>(transaction >> 8);
  out[1] = static_cast<std::uint8_t>(transaction);
  out[4] = static_cast<std::uint8_t>(length >> 8);
  out[5] = static_cast<std::uint8_t>(length);
  out[6] = kUnit;
  std::ranges::copy(pdu, out.begin() + kTcpHeader);
  return out;
}

Bytes rtu_frame(const Bytes& pdu, std::uint8_t address) {
  Bytes out(1 + pdu.size());
  out[0] = address;
  std::ranges::copy(pdu, out.begin() + 1);
  const std::uint16_t crc = crc_of(out);
  out.push_back(static_cast<std::uint8_t>(crc));
  out.push_back(static_cast<std::uint8_t>(crc >> 8));
  return out;
}

}  // namespace stepwright::fuzz::modbus
