#include "tests/unit/runtime/modbus/oracle/pymodbus_peer.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "tests/support/temporary_folder.h"
#include "tests/support/test_process.h"

namespace stepwright::modbus::oracle {

namespace {

namespace fs = std::filesystem;

// A line is the reaction (a, s or r), the PDU in hex or "-", and the changes.
Answer parsed(const std::string& line) {
  std::istringstream in(line);
  std::string reaction, pdu;
  Answer answer;
  in >> reaction >> pdu >> std::ws;
  answer.reaction = reaction == "a"   ? Reaction::Answered
                    : reaction == "s" ? Reaction::Silent
                                      : Reaction::Raised;
  if (pdu != "-") answer.pdu = from_hex(pdu);
  std::getline(in, answer.changes);
  return answer;
}

}  // namespace

std::vector<Answer> ask_pymodbus(Sizes sizes, const std::vector<Bytes>& requests) {
  const support::TemporaryFolder folder;
  const fs::path asked = folder / "requests", answered = folder / "answers";
  {
    std::ofstream out(asked);
    for (const Bytes& each : requests) out << hex(each) << '\n';
  }
  support::TestProcess python({"/usr/bin/python3", STEPWRIGHT_ORACLE_DIR "/pymodbus_peer.py",
                               std::to_string(sizes.bits), std::to_string(sizes.registers), asked, answered},
                              folder / "log");
  if (python.wait() != 0) throw std::runtime_error("pymodbus_peer.py failed:\n" + python.output());
  std::vector<Answer> out;
  std::ifstream in(answered);
  for (std::string line; std::getline(in, line);) out.push_back(parsed(line));
  if (out.size() != requests.size()) throw std::runtime_error("pymodbus_peer.py answered too little");
  return out;
}

}  // namespace stepwright::modbus::oracle
