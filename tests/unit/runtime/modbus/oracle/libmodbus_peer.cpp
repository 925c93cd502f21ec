#include "tests/unit/runtime/modbus/oracle/libmodbus_peer.h"

#include <modbus/modbus.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <stdexcept>

namespace stepwright::modbus::oracle {

namespace {

constexpr std::size_t kHeader = 7;  // of Modbus/TCP, the unit included
constexpr std::size_t kMostPdu = 253;

// How much of a PDU modbus_receive reads (compute_meta_length_after_function,
// compute_data_length_after_meta); 0: it needs more to know.
std::size_t received_length(const Bytes& pdu) {
  const std::uint8_t function = pdu[0];
  if (function <= MODBUS_FC_WRITE_SINGLE_REGISTER) return 5;
  if (function == MODBUS_FC_WRITE_MULTIPLE_COILS || function == MODBUS_FC_WRITE_MULTIPLE_REGISTERS) {
    return pdu.size() < 6 ? 0 : 6 + pdu[5];
  }
  if (function == MODBUS_FC_MASK_WRITE_REGISTER) return 7;
  if (function == MODBUS_FC_WRITE_AND_READ_REGISTERS) return pdu.size() < 10 ? 0 : 10 + pdu[9];
  // It reads the function code only and takes what follows for the next request; the answer is the same.
  return pdu.size();
}

}  // namespace

struct LibmodbusPeer::State {
  explicit State(Sizes sizes) : initial(sizes) {
    const int bits = static_cast<int>(sizes.bits), registers = static_cast<int>(sizes.registers);
    context = modbus_new_tcp(nullptr, 0);
    mapping = modbus_mapping_new(bits, bits, registers, registers);
    if (context == nullptr || mapping == nullptr || ::socketpair(AF_UNIX, SOCK_STREAM, 0, ends.data()) != 0)
      throw std::runtime_error("no libmodbus");
    modbus_set_socket(context, ends[0]);
    // It sleeps for this time before it says that a function or a count is illegal.
    modbus_set_response_timeout(context, 0, 1);
    ::prctl(PR_SET_TIMERSLACK, 1);
    reset();
  }
  ~State() {
    modbus_mapping_free(mapping);
    modbus_free(context);
    for (const int end : ends) ::close(end);
  }

  void reset() {
    std::ranges::copy(initial.coils, mapping->tab_bits);
    std::ranges::copy(initial.discrete_inputs, mapping->tab_input_bits);
    std::ranges::copy(initial.holding_registers, mapping->tab_registers);
    std::ranges::copy(initial.input_registers, mapping->tab_input_registers);
  }
  TablesView view() const {
    return {{mapping->tab_bits, initial.coils.size()},
            {mapping->tab_input_bits, initial.coils.size()},
            {mapping->tab_registers, initial.holding_registers.size()},
            {mapping->tab_input_registers, initial.holding_registers.size()}};
  }

  Tables initial;
  modbus_t* context = nullptr;
  modbus_mapping_t* mapping = nullptr;
  std::array<int, 2> ends{-1, -1};
};

LibmodbusPeer::LibmodbusPeer(Sizes sizes) : state_(std::make_unique<State>(sizes)) {}
LibmodbusPeer::~LibmodbusPeer() = default;

std::optional<Answer> LibmodbusPeer::ask(const Bytes& pdu) {
  if (pdu.empty() || pdu.size() > kMostPdu || pdu.size() != received_length(pdu)) return std::nullopt;
  std::array<std::uint8_t, 1024> request{};
  request[1] = 1;
  request[5] = static_cast<std::uint8_t>(pdu.size() + 1);
  request[6] = 1;
  std::ranges::copy(pdu, request.begin() + kHeader);
  modbus_reply(state_->context, request.data(), static_cast<int>(kHeader + pdu.size()), state_->mapping);

  Answer answer;
  std::array<std::uint8_t, 300> reply{};
  const auto got = ::recv(state_->ends[1], reply.data(), reply.size(), MSG_DONTWAIT);
  if (got > static_cast<ssize_t>(kHeader)) {
    answer.reaction = Reaction::Answered;
    answer.pdu.assign(reply.begin() + kHeader, reply.begin() + got);
  }
  answer.changes = changes(state_->initial.view(), state_->view());
  if (!answer.changes.empty()) state_->reset();
  return answer;
}

}  // namespace stepwright::modbus::oracle
