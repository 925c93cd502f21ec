#pragma once

// The servers of a cell, as its file has them: the page, Modbus, and the figures for monitoring. Threads:
// any.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "cell/config/cell_config.h"
#include "runtime/ground/result/diagnostic.h"

namespace stepwright::check {

struct ListeningServer {
  std::string table;     // dotted
  const char* host_key;  // the one that has `host`
  std::string host;
  std::uint16_t port = 0;
};

std::vector<ListeningServer> listening_servers(const config::CellConfig& config);

// Of a key of a dotted table; reads the cell's file.
result::Location where_of(const config::CellConfig& config, std::string_view table, std::string_view key);

}  // namespace stepwright::check
