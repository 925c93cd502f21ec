// hmi_scripted_cell [PORT [SPEED [START_S]]]: the real HMI server over a scripted bench, for the browser
// test. Prints its address; "runtime off" and "runtime on" on its input end and restart the runtime that it
// plays.

#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <string>
#include <thread>

#include "hmi_web/client/client_assets.h"
#include "hmi_web/server/cell_poller.h"
#include "hmi_web/server/http_server.h"
#include "tests/browser/scripted_cell.h"

using namespace stepwright;

int main(int argc, char** argv) {
  const auto port = static_cast<std::uint16_t>(argc > 1 ? std::atoi(argv[1]) : 0);
  browser::ScriptedCell cell(argc > 2 ? std::atof(argv[2]) : 1, argc > 3 ? std::atof(argv[3]) : 0);
  server::Feed feed({"bench", "test"}, browser::bench_synoptic());
  auto http = server::HttpServer::listen({"127.0.0.1", port}, client::client_assets(), feed);
  if (!http) {
    std::fputs(result::to_string(http.error()).c_str(), stderr);
    return 1;
  }
  std::thread network([&] { (*http)->run(); });
  {
    const server::CellPoller poller(cell, server::CellViewer(browser::ScriptedCell::point_sources()), feed,
                                    [&] { (*http)->notify(); });
    std::printf("http://127.0.0.1:%d/\n", (*http)->port());
    std::fflush(stdout);
    // Until the input ends: with the test that started it.
    for (std::string line; std::getline(std::cin, line);) {
      if (line == "runtime off") cell.set_runtime_alive(false);
      if (line == "runtime on") cell.set_runtime_alive(true);
    }
  }
  (*http)->stop();
  network.join();
  return 0;
}
