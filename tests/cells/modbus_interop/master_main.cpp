// Our master (runtime/modbus/master) against a slave that others wrote:
//   modbus_interop_master tcp PORT | rtu DEVICE [S]
// The slave's tables are those of peer_server.py. Says for each function code "FC3 ok", "FC22 exception 1" or
// what else it came to; exit code 1 if a value was wrong. The slave has 60 s for each answer; S seconds for
// functions that some slaves say nothing to.

#include <array>
#include <chrono>
#include <cstdint>
#include <iostream>
#include <string>
#include <vector>

#include "runtime/ground/result/result.h"
#include "runtime/modbus/master/master.h"

namespace {

using namespace stepwright::modbus::master;
using std::chrono::seconds;

constexpr std::uint16_t kBeyond = 60'000;
constexpr seconds kPatience{60};

bool all_right = true;

void tell(const char* function, const Outcome& outcome, bool values = true) {
  std::cout << function << ' ';
  if (outcome.fault == Fault::Exception) {
    std::cout << "exception " << static_cast<int>(outcome.exception);
  } else if (!outcome.good()) {
    std::cout << outcome.text();
  } else {
    std::cout << (values ? "ok" : "WRONG VALUES");
  }
  std::cout << std::endl;
  all_right = all_right && values;
}

Endpoint endpoint_of(const std::string& kind, const std::string& where) {
  if (kind == "tcp") return TcpEndpoint{"127.0.0.1", static_cast<std::uint16_t>(std::stoi(where))};
  SerialEndpoint line;
  line.device = where;
  line.parity = Parity::None;
  return line;
}

void poll(Master& master, seconds rare_functions) {
  std::vector<std::uint8_t> bits(19);
  std::array<std::uint16_t, 10> words{};
  const std::array<std::uint16_t, 4> some{0x1234, 0xFFFF, 0, 0x8001};
  const std::vector<std::uint8_t> pattern{1, 0, 1, 1, 0, 0, 0, 1, 1, 1};

  Outcome done = master.write_coils(3, pattern);
  tell("FC15", done);
  done = master.write_coil(14, true);
  tell("FC5", done);
  done = master.read_bits(BitTable::Coils, 0, bits);
  bool same = bits[14] == 1 && bits[0] == 0;
  for (std::size_t i = 0; i < pattern.size(); ++i) same = same && bits[3 + i] == pattern[i];
  tell("FC1", done, !done.good() || same);

  done = master.read_bits(BitTable::DiscreteInputs, 1, bits);
  same = true;
  for (std::size_t i = 0; i < bits.size(); ++i) same = same && bits[i] == ((i + 1) % 3 == 0 ? 1 : 0);
  tell("FC2", done, !done.good() || same);

  tell("FC16", master.write_registers(10, some));
  tell("FC6", master.write_register(14, 0xABCD));
  done = master.read_registers(RegisterTable::Holding, 10, words);
  same =
      words[0] == 0x1234 && words[1] == 0xFFFF && words[2] == 0 && words[3] == 0x8001 && words[4] == 0xABCD;
  tell("FC3", done, !done.good() || same);
  if (done.good() && !same)
    for (const std::uint16_t word : words) std::cerr << "FC3 has read " << word << '\n';
  done = master.read_registers(RegisterTable::Input, 20, words);
  tell("FC4", done, !done.good() || (words[0] == 67 && words[9] == 94));

  tell("beyond", master.read_registers(RegisterTable::Holding, kBeyond, words));
  // An answer that is none ends a connection.
  if (!master.connected() && !master.connect().good()) return;
  std::array<std::uint16_t, 125> most{};
  tell("most", master.read_registers(RegisterTable::Input, 0, most), true);
  // Last, as some slaves say nothing any more after a function that they do not know.
  master.set_timeout(rare_functions);
  done = master.mask_register(10, 0xFF00, 0x0055);
  tell("FC22", done);
  if (done.good()) {
    std::array<std::uint16_t, 1> one{};
    done = master.read_registers(RegisterTable::Holding, 10, one);
    tell("FC22-value", done, one[0] == 0x1255);
  }
  std::array<std::uint16_t, 3> read{};
  done = master.read_write_registers(30, some, 29, read);
  tell("FC23", done, !done.good() || (read[1] == 0x1234 && read[2] == 0xFFFF));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3 && argc != 4) return 2;
  auto master =
      Master::create(endpoint_of(argv[1], argv[2]), {.timeout = kPatience, .connect_timeout = kPatience});
  if (!master) {
    std::cerr << stepwright::result::to_string(master.error()) << '\n';
    return 2;
  }
  const Outcome reached = master->connect();
  if (!reached.good()) {
    std::cerr << reached.text() << '\n';
    return 2;
  }
  if (!master->select_unit(1).good()) return 2;
  poll(*master, argc == 4 ? seconds(std::stoi(argv[3])) : kPatience);
  return all_right ? 0 : 1;
}
