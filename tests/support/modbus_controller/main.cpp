// A controller for the tests of whole cells: `modbus_controller --pty LINK` or `--tcp PORT`. Prints where it
// listens. SIGUSR1 is a loss of power: it starts again with its program and nothing else.

#include <signal.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <atomic>
#include <cstdio>
#include <filesystem>

#include "tests/support/modbus_controller/slave.h"

namespace {

std::atomic<bool> stop{false};
std::atomic<bool> power_lost{false};

}  // namespace

int main(int argc, char** argv) {
  using namespace stepwright::support;
  CLI::App app{"A controller with the registers of runtime/doc/modbus_controller.md"};
  std::string link;
  std::uint16_t port = 0;
  int unit = 1;
  auto* const pty = app.add_option("--pty", link, "RTU on a pseudo terminal; its device is linked there");
  app.add_option("--tcp", port, "TCP on this port of the loopback, 0: any")->excludes(pty);
  app.add_option("--unit", unit, "address of the slave");
  CLI11_PARSE(app, argc, argv);
  signal(SIGTERM, [](int) { stop = true; });
  signal(SIGUSR1, [](int) { power_lost = true; });
  ControllerModel model;
  ControlRegisters registers(model);
  const auto slave = link.empty() ? Slave::on_loopback(registers, model, port)
                                  : Slave::on_pty(registers, model, static_cast<std::uint8_t>(unit));
  if (!link.empty()) {
    std::error_code ignored;
    std::filesystem::remove(link, ignored);
    std::filesystem::create_symlink(slave->where(), link);
  }
  std::printf("listens on %s\n", slave->where().c_str());
  std::fflush(stdout);
  while (!stop) {
    if (power_lost.exchange(false)) model.reset();
    slave->turn(std::chrono::milliseconds(50));
  }
  return 0;
}
