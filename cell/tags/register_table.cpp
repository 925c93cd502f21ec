#include "cell/tags/register_table.h"

#include <cstdio>
#include <nlohmann/json.hpp>
#include <utility>

#include "hmi_web/protocol/tag_note_json.h"

namespace stepwright::tags {
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

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.10g", value);
  return text;
}

bool is_time(const std::string& type) {
  return type == "TIME" || type == "LTIME";
}

// An end of the range that is normal: of a TIME in seconds, whereas its registers count nanoseconds.
std::string end_of(double value, const std::string& type) {
  return number(value) + (is_time(type) ? " s" : "");
}

// With its group and the range that is normal: "level of the buffer (tanks; 0 to 200)".
std::string description_of(const protocol::TagNote& note, const std::string& type) {
  std::string more = note.group;
  if (note.normal)
    more += (more.empty() ? "" : "; ") + end_of(note.normal->first, type) + " to " +
            end_of(note.normal->second, type);
  if (more.empty()) return note.description;
  return note.description + (note.description.empty() ? "(" : " (") + more + ")";
}

std::string addresses_of(const RegisterRow& row) {
  if (row.addresses == 1) return std::to_string(row.first);
  return std::to_string(row.first) + "-" + std::to_string(row.first + row.addresses - 1);
}

constexpr const char* kTitles[] = {"Coils", "Discrete inputs", "Holding registers", "Input registers"};

}  // namespace

std::vector<TaggedRow> tagged(std::vector<RegisterRow> rows, const KnownTags& tags) {
  std::vector<TaggedRow> all;
  for (RegisterRow& row : rows) {
    protocol::TagNote note = tags.of(row.name);
    all.push_back({std::move(row), std::move(note)});
  }
  return all;
}

std::string to_markdown(const std::vector<TaggedRow>& rows, const std::string& title, bool openplc) {
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
    for (const auto& [row, note] : rows) {
      if (row.table != static_cast<Table>(table)) continue;
      if (!any)
        out += std::string("\n## ") + kTitles[table] +
               "\n\n| address | functions | name | type | IEC | access | word order | unit | description | "
               "comment |\n"
               "|---|---|---|---|---|---|---|---|---|---|\n";
      any = true;
      out += "| " + addresses_of(row) + " | " + modbus::map::function_codes(row.table, row.writable) + " | " +
             cell(row.name) + " | " + row.type + " | " + row.address + " | " + access_of(row) + " | " +
             word_order_of(row) + (row.byte_order == Order::LowFirst ? ", bytes low first" : "") + " | " +
             cell(note.unit) + " | " + cell(description_of(note, row.type)) + " | " + cell(row.comment) +
             " |\n";
    }
  }
  return out;
}

std::string to_csv(const std::vector<TaggedRow>& rows) {
  std::string out =
      "table,address,registers,functions,name,type,iec_address,access,byte_order,word_order,comment,unit,"
      "description,group,least,greatest\r\n";
  for (const auto& [row, note] : rows) {
    out += std::string(name_of(row.table)) + "," + std::to_string(row.first) + "," +
           std::to_string(row.addresses) + "," +
           quoted(modbus::map::function_codes(row.table, row.writable)) + "," + quoted(row.name) + "," +
           row.type + "," + row.address + "," + access_of(row) + "," + byte_order_of(row) + "," +
           word_order_of(row) + "," + quoted(row.comment) + "," + quoted(note.unit) + "," +
           quoted(note.description) + "," + quoted(note.group) + "," +
           (note.normal ? end_of(note.normal->first, row.type) : "") + "," +
           (note.normal ? end_of(note.normal->second, row.type) : "") + "\r\n";
  }
  return out;
}

std::string to_json(const std::vector<TaggedRow>& rows) {
  nlohmann::json list = nlohmann::json::array();
  for (const auto& [row, note] : rows) {
    nlohmann::json entry = {{"table", name_of(row.table)},
                            {"address", row.first},
                            {"registers", row.addresses},
                            {"functions", modbus::map::function_codes(row.table, row.writable)},
                            {"name", row.name},
                            {"type", row.type},
                            {"iec_address", row.address},
                            {"access", access_of(row)},
                            {"byte_order", byte_order_of(row)},
                            {"word_order", word_order_of(row)},
                            {"comment", row.comment}};
    const nlohmann::json said = protocol::to_json(note);
    for (const char* key : {"unit", "description", "group", "normal"})
      if (said.contains(key)) entry[key] = said[key];
    if (note.normal && is_time(row.type)) entry["normal_unit"] = "s";
    list.push_back(std::move(entry));
  }
  return list.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace stepwright::tags
