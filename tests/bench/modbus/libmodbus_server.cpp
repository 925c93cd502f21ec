#include "tests/bench/modbus/libmodbus_server.h"

#include <modbus/modbus.h>
#include <sys/select.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>

#include "tests/bench/modbus/server_process.h"

namespace stepwright::bench {

void serve_with_libmodbus(int listener) {
  modbus_t* const context = modbus_new_tcp("127.0.0.1", 0);
  modbus_mapping_t* const map = modbus_mapping_new(8'192, 8'192, 8'192, 1'024);
  fd_set all;
  FD_ZERO(&all);
  FD_SET(listener, &all);
  int highest = listener;
  std::array<std::uint8_t, MODBUS_TCP_MAX_ADU_LENGTH> query{};
  while (true) {
    fd_set ready = all;
    if (select(highest + 1, &ready, nullptr, nullptr, nullptr) < 0) std::exit(5);
    for (int fd = 0; fd <= highest; ++fd) {
      if (!FD_ISSET(fd, &ready)) continue;
      if (fd == listener) {
        const int client = accept_client(listener);
        if (client < 0) continue;
        FD_SET(client, &all);
        highest = std::max(highest, client);
        continue;
      }
      modbus_set_socket(context, fd);
      const int count = modbus_receive(context, query.data());
      if (count > 0) {
        modbus_reply(context, query.data(), count, map);
      } else if (count < 0) {
        close(fd);
        FD_CLR(fd, &all);
      }
    }
  }
}

}  // namespace stepwright::bench
