#include "cell/config/modbus_client_config.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "cell/config/modbus_tag_config.h"

namespace stepwright::config {
namespace {

using modbus::client::ClientSettings;
using modbus::client::Device;
using modbus::client::Group;
using modbus::client::ImageField;
using modbus::client::ImageType;
using modbus::client::LossValue;
using modbus::client::Tag;
using modbus::master::SerialEndpoint;
using settings::TomlTable;
using std::chrono::milliseconds;

constexpr std::int64_t kDay = 86'400'000;

class ClientReader {
 public:
  ClientReader(const TomlTable& root, const ModbusImage& image, result::Diagnostics& problems)
      : root_(root), modbus_(root.table("modbus")), image_(image), problems_(problems) {}

  ClientSettings read() {
    const TomlTable client = modbus_.table("client");
    const auto ms = [&](const char* key, milliseconds fallback, double low, double high) {
      return milliseconds(client.integer(key, fallback.count(), {low, high}));
    };
    settings_.cycle = ms("cycle_ms", settings_.cycle, 1, 1'000);
    settings_.silence = ms("silence_ms", settings_.silence, 20, 60'000);
    settings_.connect_timeout = ms("connect_timeout_ms", settings_.connect_timeout, 10, 60'000);
    settings_.reconnect_at_most = ms("reconnect_ms", settings_.reconnect_at_most, 20, 60'000);
    settings_.holder_timeout = ms("holder_timeout_ms", settings_.holder_timeout, 100, 60'000);
    settings_.startup = ms("startup_ms", settings_.startup, 0, 600'000);
    read_lines();
    for (const TomlTable& table : modbus_.tables("device")) read_device(table);
    check_whole();
    return std::move(settings_);
  }

 private:
  bool fail(const char* code, result::Location where, std::string message, std::string hint) {
    problems_.push_back(
        {code, result::Severity::Error, std::move(where), std::move(message), std::move(hint)});
    return false;
  }

  void read_lines() {
    const TomlTable lines = modbus_.table("lines");
    for (const std::string& device : lines.keys()) {
      const TomlTable table = lines.table(device);
      Line line;
      line.where = table.where();
      line.endpoint.device = device;
      line.endpoint.baud = static_cast<std::uint32_t>(table.integer("baud", 19'200, {1'200, 1'000'000}));
      const auto& speeds = modbus::master::kSpeeds;
      if (std::ranges::find(speeds, line.endpoint.baud) == speeds.end())
        fail("C0521", table.where("baud"), "no line has " + std::to_string(line.endpoint.baud) + " baud",
             "9600, 19200, 38400, 57600, 115200, ...");
      const std::string parity = table.choice("parity", "even", {"none", "even", "odd"});
      line.endpoint.parity = parity == "none"   ? modbus::master::Parity::None
                             : parity == "even" ? modbus::master::Parity::Even
                                                : modbus::master::Parity::Odd;
      line.endpoint.data_bits = static_cast<std::uint8_t>(table.integer("data_bits", 8, {7, 8}));
      line.endpoint.stop_bits = static_cast<std::uint8_t>(table.integer("stop_bits", 1, {1, 2}));
      line.endpoint.rs485 = table.boolean("rs485", false);
      line.endpoint.echo = table.boolean("echo", false);
      if (table.has("gap_us"))
        line.gap = std::chrono::microseconds(table.integer("gap_us", 0, {0, 1'000'000}));
      lines_.push_back(std::move(line));
    }
  }

  void read_device(const TomlTable& table) {
    Device device;
    device.where = table.where("name");
    device.name = table.required_text("name");
    read_endpoint(table, device);
    const auto ms = [&](const char* key, milliseconds fallback, double low, double high) {
      return milliseconds(table.integer(key, fallback.count(), {low, high}));
    };
    device.timeout = ms("timeout_ms", device.timeout, 1, 60'000);
    device.retries = static_cast<int>(table.integer("retries", device.retries, {0, 10}));
    device.retry_after = ms("retry_ms", device.retry_after, 10, kDay);
    device.retry_at_most =
        std::max(device.retry_after,
                 ms("retry_most_ms", std::max(device.retry_at_most, device.retry_after), 10, kDay));
    device.loss_after = ms("loss_after_ms", device.loss_after, 10, kDay);
    device.refresh = ms("refresh_ms", device.refresh, 0, kDay);
    device.max_gap = static_cast<std::uint16_t>(table.integer("max_gap", device.max_gap, {0, 124}));
    device.max_registers =
        static_cast<std::uint16_t>(table.integer("max_registers", device.max_registers, {4, 125}));
    device.max_bits = static_cast<std::uint16_t>(table.integer("max_bits", device.max_bits, {1, 2'000}));
    device.single_writes = table.boolean("single_writes", device.single_writes);
    device.mask_writes = table.boolean("mask_writes", device.mask_writes);
    const std::string on_loss = table.choice("on_loss", "safe", {"safe", "hold", "zero", "value"});
    device.on_loss = on_loss == "safe" ? modbus::client::OnLoss::Safe : modbus::client::OnLoss::Carry;
    ModbusTagFrame frame;
    frame.on_loss = on_loss == "zero"    ? LossValue::Zero
                    : on_loss == "value" ? LossValue::Value
                                         : LossValue::Hold;
    frame.order = read_modbus_order(table, frame.order);
    frame.input_bytes = image_.input_bytes;
    frame.output_bytes = image_.output_bytes;
    if (const auto online = read_input_field(table, "online", 1, image_.input_bytes, problems_)) {
      device.online_bit = online->byte * 8 + online->bit;
      claim(*online, table.where("online"), table.text("online", {}));
    }
    for (const TomlTable& group : table.tables("group")) read_group(group, frame, device);
    if (device.groups.empty())
      fail("C0526", table.where(), "nothing is read from or written to this device",
           "[[modbus.device.group]] with tags");
    check_names(device);
    check_writes(device);
    settings_.devices.push_back(std::move(device));
  }

  bool read_endpoint(const TomlTable& table, Device& device) {
    const std::string host = table.text("host", {});
    const std::string line = table.text("line", {});
    const auto port = static_cast<std::uint16_t>(table.integer("port", 502, {1, 65'535}));
    device.unit = static_cast<std::uint8_t>(table.integer("unit", 1, {0, 255}));
    const bool rtu = table.choice("framing", "tcp", {"tcp", "rtu"}) == "rtu";
    device.requests_per_connection =
        static_cast<std::uint32_t>(table.integer("requests_per_connection", 0, {0, 1'000'000}));
    device.pause = milliseconds(table.integer("pause_ms", 0, {0, 60'000}));
    if (host.empty() == line.empty()) {
      return fail("C0521", device.where,
                  host.empty() ? "it is not said where the device is" : "the device has two places",
                  "host = \"192.168.1.10\", or line = \"/dev/ttyUSB0\"");
    }
    if (!line.empty() && table.has("port"))
      return fail("C0521", table.where("port"), "a serial line has no port", "");
    const bool known =
        device.unit <= 247 ? !line.empty() ? device.unit > 0 : true : line.empty() && device.unit == 255;
    if (!known) {
      return fail("C0521", table.where("unit"), "there is no unit " + std::to_string(device.unit) + " there",
                  "1 to 247; over TCP also 0 and 255");
    }
    if (!host.empty()) {
      device.endpoint = modbus::master::TcpEndpoint{
          host, port, rtu ? modbus::master::Framing::Rtu : modbus::master::Framing::Tcp};
      return true;
    }
    for (const char* key : {"framing", "requests_per_connection", "pause_ms"}) {
      if (table.has(key))
        return fail("C0521", table.where(key), std::string("a serial line has no ") + key, "it is of TCP");
    }
    const auto found =
        std::ranges::find_if(lines_, [&](const Line& each) { return each.endpoint.device == line; });
    SerialEndpoint endpoint;
    endpoint.device = line;
    if (found != lines_.end()) {
      device.gap = found->gap;
      found->used = true;
    }
    device.endpoint = found != lines_.end() ? found->endpoint : endpoint;
    return true;
  }

  void read_group(const TomlTable& table, const ModbusTagFrame& frame, Device& device) {
    Group group;
    group.where = table.where();
    group.name = table.text("name", "group" + std::to_string(device.groups.size() + 1));
    group.period = milliseconds(table.integer("period_ms", group.period.count(), {1, kDay}));
    const bool cyclic = table.choice("write", "change", {"change", "cyclic"}) == "cyclic";
    group.write = cyclic ? modbus::client::WriteMode::Cyclic : modbus::client::WriteMode::Change;
    const std::vector<TomlTable> tags = table.tables("tags");
    if (tags.empty())
      fail("C0526", group.where, "this group has no tags", "tags = [{ address = \"%IW0\", holding = 0 }]");
    for (const TomlTable& entry : tags) {
      auto read = read_modbus_tag(entry, frame, problems_);
      if (!read) continue;
      const Tag& tag = read->tag;
      if (!read->output) claim(tag.field, tag.where, tag.address);
      if (tag.quality_byte)
        claim({*tag.quality_byte, 0, ImageType::Usint}, entry.where("quality"), "the quality");
      if (tag.age) claim(*tag.age, entry.where("age"), "the age");
      (read->output ? group.outputs : group.inputs).push_back(std::move(read->tag));
    }
    device.groups.push_back(std::move(group));
  }

  // Each bit of the inputs has one writer.
  void claim(const ImageField& field, const result::Location& where, const std::string& what) {
    const bool bit = field.type == ImageType::Bool;
    const std::uint32_t first = field.byte * 8 + (bit ? field.bit : 0u);
    const std::uint32_t end = first + (bit ? 1u : 8u * bytes_of(field.type));
    for (const Claim& other : claims_) {
      if (first >= other.end || other.first >= end) continue;
      fail("C0524", where,
           what + " lies where " + other.what + " of line " + std::to_string(other.line) + " does",
           "every bit of the inputs has one source");
      return;
    }
    claims_.push_back({first, end, where.line, what});
  }

  // Two outputs that write the same register would fight for it.
  void check_writes(const Device& device) {
    std::vector<const Tag*> seen;
    for (const Group& group : device.groups) {
      for (const Tag& tag : group.outputs) {
        const auto fights = [&](const Tag* other) {
          const bool apart =
              tag.bit != Tag::kWholeRegister && other->bit != Tag::kWholeRegister && tag.bit != other->bit;
          return other->table == tag.table && other->first < tag.end() && tag.first < other->end() && !apart;
        };
        const auto other = std::ranges::find_if(seen, fights);
        if (other != seen.end())
          fail("C0524", tag.where, tag.address + " writes what " + (*other)->address + " writes", "");
        seen.push_back(&tag);
      }
    }
  }

  void check_names(const Device& device) {
    for (const Device& other : settings_.devices) {
      if (other.name == device.name)
        fail("C0527", device.where, "there are two devices '" + device.name + "'",
             "names tell them apart in status and log");
      const bool same = name_of(other.endpoint) == name_of(device.endpoint) && other.unit == device.unit;
      if (same)
        fail("C0527", device.where, "'" + other.name + "' has the same place and unit",
             "one device may have several groups");
    }
  }

  // A device that does not answer holds its connection for a timeout. The others must be able to bear that.
  void check_patience() {
    for (const Device& slow : settings_.devices) {
      for (const Device& other : settings_.devices) {
        if (&slow == &other || name_of(slow.endpoint) != name_of(other.endpoint)) continue;
        const auto bears = bearable(other);
        if (slow.timeout < bears) continue;
        fail("C0526", slow.where,
             "without an answer '" + slow.name + "' holds the connection for " +
                 std::to_string(slow.timeout.count()) + " ms, and '" + other.name +
                 "' counts as lost after " + std::to_string(bears.count()) + " ms",
             "a shorter timeout_ms of the one, a longer loss_after_ms of the other, or a line of its own");
        break;
      }
    }
  }

  // How long a device may be without news before a tag of it is lost.
  static milliseconds bearable(const Device& device) {
    auto least = milliseconds::max();
    for (const Group& group : device.groups) least = std::min(least, 2 * group.period);
    return std::max(device.loss_after, least == milliseconds::max() ? milliseconds(0) : least);
  }

  void check_lines() {
    for (const Line& line : lines_) {
      if (line.used) continue;
      fail("C0526", line.where, "no device is on the line " + line.endpoint.device,
           "a device says line = \"" + line.endpoint.device + "\", letter by letter");
    }
  }

  void check_whole() {
    check_lines();
    check_patience();
    const bool devices = modbus_.has("device");
    if (image_.used && !devices) {
      fail("C0526", root_.table("io").where("kind"), "there is no device",
           "[[modbus.device]] says what to read and write");
    }
    if (!image_.used && devices) {
      fail("C0526", modbus_.where("device"), "nobody asks for these devices", "[io] kind = \"modbus\"");
    }
    if (image_.used && !image_.real_clock) {
      fail("C0526", root_.table("io").where("kind"), "physical devices know real time only",
           "[clock] mode = \"real\"");
    }
    if (image_.used && settings_.silence <= settings_.cycle) {
      const TomlTable client = modbus_.table("client");
      fail("C0526", client.where(client.has("silence_ms") ? "silence_ms" : "cycle_ms"),
           "the client says that it lives once in a cycle, every " + std::to_string(settings_.cycle.count()) +
               " ms, and is taken for lost after " + std::to_string(settings_.silence.count()) + " ms",
           "silence_ms several times cycle_ms");
    }
  }

  struct Line {
    SerialEndpoint endpoint;
    std::chrono::microseconds gap{-1};
    result::Location where;
    bool used = false;
  };
  struct Claim {
    std::uint32_t first;
    std::uint32_t end;
    std::uint32_t line;
    std::string what;
  };

  const TomlTable& root_;
  TomlTable modbus_;
  const ModbusImage& image_;
  result::Diagnostics& problems_;
  std::vector<Line> lines_;
  std::vector<Claim> claims_;
  ClientSettings settings_;
};

}  // namespace

ClientSettings read_modbus_client(const TomlTable& root, const ModbusImage& image,
                                  result::Diagnostics& problems) {
  return ClientReader(root, image, problems).read();
}

}  // namespace stepwright::config
