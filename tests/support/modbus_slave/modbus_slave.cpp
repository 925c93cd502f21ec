#include "tests/support/modbus_slave/modbus_slave.h"

#include <arpa/inet.h>
#include <modbus/modbus.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <stdexcept>

namespace stepwright::support {

struct ModbusSlave::Peer {
  modbus_t* context = nullptr;
  modbus_mapping_t* mapping = nullptr;
  int listener = -1;
  std::vector<int> clients;
};

ModbusSlave::ModbusSlave(const ModbusSlaveOptions& options)
    : peer_(std::make_unique<Peer>()), serial_(!options.device.empty()) {
  peer_->mapping =
      modbus_mapping_new(options.registers, options.registers, options.registers, options.registers);
  if (serial_) {
    peer_->context = modbus_new_rtu(options.device.c_str(), 19'200, 'E', 8, 1);
    modbus_set_slave(peer_->context, options.unit);
    if (modbus_connect(peer_->context) != 0) throw std::runtime_error("no line " + options.device);
    modbus_set_indication_timeout(peer_->context, 0, 50'000);
  } else {
    peer_->context = modbus_new_tcp("127.0.0.1", options.port);
    peer_->listener = modbus_tcp_listen(peer_->context, 64);
    if (peer_->listener < 0) throw std::runtime_error("no port to listen on");
    sockaddr_in address{};
    socklen_t length = sizeof address;
    getsockname(peer_->listener, reinterpret_cast<sockaddr*>(&address), &length);
    port_ = ntohs(address.sin_port);
  }
  thread_ = std::thread([this] { serial_ ? serve_line() : serve_tcp(); });
}

ModbusSlave::~ModbusSlave() {
  stop_ = true;
  thread_.join();
  for (const int client : peer_->clients) {
    const linger reset{1, 0};
    setsockopt(client, SOL_SOCKET, SO_LINGER, &reset, sizeof reset);
    close(client);
  }
  if (peer_->listener >= 0) close(peer_->listener);
  if (serial_) modbus_close(peer_->context);
  modbus_mapping_free(peer_->mapping);
  modbus_free(peer_->context);
}

void ModbusSlave::serve_line() {
  std::array<std::uint8_t, MODBUS_MAX_ADU_LENGTH> query{};
  while (!stop_) {
    const int length = modbus_receive(peer_->context, query.data());
    if (length > 0) answer(query.data(), length);
  }
}

void ModbusSlave::serve_tcp() {
  std::array<std::uint8_t, MODBUS_MAX_ADU_LENGTH> query{};
  while (!stop_) {
    std::vector<pollfd> entries{{peer_->listener, POLLIN, 0}};
    for (const int client : peer_->clients) entries.push_back({client, POLLIN, 0});
    if (poll(entries.data(), entries.size(), 5) <= 0) continue;
    if (entries[0].revents != 0) {
      const int client = accept4(peer_->listener, nullptr, nullptr, SOCK_CLOEXEC);
      if (client >= 0) peer_->clients.push_back(client);
      ++accepted_;
    }
    for (std::size_t i = 1; i < entries.size(); ++i) {
      if (entries[i].revents == 0) continue;
      modbus_set_socket(peer_->context, entries[i].fd);
      const int length = modbus_receive(peer_->context, query.data());
      if (length > 0) {
        answer(query.data(), length);
      } else if (length < 0) {
        close(entries[i].fd);
        std::erase(peer_->clients, entries[i].fd);
      }
    }
  }
}

void ModbusSlave::answer(const std::uint8_t* query, int length) {
  const int header = modbus_get_header_length(peer_->context);
  const std::uint8_t unit = query[header - 1];
  ++by_unit_[unit];
  const bool silent = silent_[unit];  // as it is when the request is counted
  {
    const std::scoped_lock lock(mutex_);
    history_.emplace_back(query + header, query + length - (serial_ ? 2 : 0));
  }
  ++requests_;
  if (silent) return;
  if (delay_ms_ > 0) std::this_thread::sleep_for(std::chrono::milliseconds(delay_ms_));
  const std::scoped_lock lock(mutex_);
  if (exception_ > 0) {
    modbus_reply_exception(peer_->context, query, static_cast<unsigned>(exception_.load()));
  } else {
    modbus_reply(peer_->context, query, length, peer_->mapping);
  }
}

std::vector<std::vector<std::uint8_t>> ModbusSlave::history() const {
  const std::scoped_lock lock(mutex_);
  return history_;
}

std::uint16_t ModbusSlave::holding(int address) const {
  const std::scoped_lock lock(mutex_);
  return peer_->mapping->tab_registers[address];
}
bool ModbusSlave::coil(int address) const {
  const std::scoped_lock lock(mutex_);
  return peer_->mapping->tab_bits[address] != 0;
}
void ModbusSlave::set_holding(int address, std::uint16_t value) {
  const std::scoped_lock lock(mutex_);
  peer_->mapping->tab_registers[address] = value;
}
void ModbusSlave::set_input(int address, std::uint16_t value) {
  const std::scoped_lock lock(mutex_);
  peer_->mapping->tab_input_registers[address] = value;
}
void ModbusSlave::set_coil(int address, bool value) {
  const std::scoped_lock lock(mutex_);
  peer_->mapping->tab_bits[address] = value ? 1 : 0;
}
void ModbusSlave::set_discrete(int address, bool value) {
  const std::scoped_lock lock(mutex_);
  peer_->mapping->tab_input_bits[address] = value ? 1 : 0;
}

}  // namespace stepwright::support
