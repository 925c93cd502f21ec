#include "programs/registers/register_table.h"

#include <nlohmann/json.hpp>

namespace stepwright::registers {
namespace {

using modbus::map::holds_bits;
using modbus::map::name_of;
using modbus::map::Order;
using modbus::map::RegisterRow;
using modbus::map::Table;

const char* access_of(const RegisterRow& row) {
  return row.writable ? "read/write" : "read";
}

// Of what has only one register or bit it says nothing.
std::string word_order_of(const RegisterRow& row) {
  if (row.addresses < 2 || holds_bits(row.table)) return {};
  return row.word_order == Order::HighFirst ? "high first" : "low first";
}

std::string byte_order_of(const RegisterRow& row) {
  if (holds_bits(row.table)) return {};
  return row.byte_order == Order::HighFirst ? "high first" : "low first";
}

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

std::string cell(std::string text) {
  for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2) text.insert(at, "\\");
  return text;
}

std::string addresses_of(const RegisterRow& row) {
  if (row.addresses == 1) return std::to_string(row.first);
  return std::to_string(row.first) + "-" + std::to_string(row.first + row.addresses - 1);
}

constexpr const char* kTitles[] = {"Coils", "Discrete inputs", "Holding registers", "Input registers"};

}  // namespace

std::string to_markdown(const std::vector<RegisterRow>& rows, const std::string& title, bool openplc) {
  std::string out = "# " + title + "\n\nAddresses count from 0, as they travel. ";
  if (openplc) {
    out +=
        "Beside the variables below: coils 0-8191 are %QX0.0-%QX1023.7, discrete inputs 0-8191 %IX, input "
        "registers 0-1023 %IW, "
        "holding registers 0-1023 %QW, 1024-2047 %MW, 2048-4095 %MD, 4096-8191 %ML; what the program does "
        "not have reads 0.";
  }
  out += "\n";
  for (std::size_t table = 0; table < modbus::map::kTables; ++table) {
    bool any = false;
    for (const RegisterRow& row : rows) {
      if (row.table != static_cast<Table>(table)) continue;
      if (!any)
        out += std::string("\n## ") + kTitles[table] +
               "\n\n| address | functions | name | type | IEC | access | word order | comment |\n"
               "|---|---|---|---|---|---|---|---|\n";
      any = true;
      out += "| " + addresses_of(row) + " | " + modbus::map::function_codes(row.table, row.writable) + " | " +
             cell(row.name) + " | " + row.type + " | " + row.address + " | " + access_of(row) + " | " +
             word_order_of(row) + (row.byte_order == Order::LowFirst ? ", bytes low first" : "") + " | " +
             cell(row.comment) + " |\n";
    }
  }
  return out;
}

std::string to_csv(const std::vector<RegisterRow>& rows) {
  std::string out =
      "table,address,registers,functions,name,type,iec_address,access,byte_order,word_order,comment\r\n";
  for (const RegisterRow& row : rows) {
    out += std::string(name_of(row.table)) + "," + std::to_string(row.first) + "," +
           std::to_string(row.addresses) + "," +
           quoted(modbus::map::function_codes(row.table, row.writable)) + "," + quoted(row.name) + "," +
           row.type + "," + row.address + "," + access_of(row) + "," + byte_order_of(row) + "," +
           word_order_of(row) + "," + quoted(row.comment) + "\r\n";
  }
  return out;
}

std::string to_json(const std::vector<RegisterRow>& rows) {
  nlohmann::json list = nlohmann::json::array();
  for (const RegisterRow& row : rows) {
    list.push_back({{"table", name_of(row.table)},
                    {"address", row.first},
                    {"registers", row.addresses},
                    {"functions", modbus::map::function_codes(row.table, row.writable)},
                    {"name", row.name},
                    {"type", row.type},
                    {"iec_address", row.address},
                    {"access", access_of(row)},
                    {"byte_order", byte_order_of(row)},
                    {"word_order", word_order_of(row)},
                    {"comment", row.comment}});
  }
  return list.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace stepwright::registers
