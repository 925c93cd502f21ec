#pragma once

// Addresses of a plant's terminals as [plant.ports] has them, for who asks for each by its name.
//
// One thread at a time. Requires that the cell has [plant.ports].
//
//   PortReader ports(cell);
//   terminals.x = ports.address("x");
//   if (auto wrong = ports.take(); !wrong.empty()) return tl::unexpected(std::move(wrong));

#include <algorithm>
#include <string>
#include <utility>

#include "cell/config/cell_config.h"

namespace stepwright::config {

class PortReader {
 public:
  explicit PortReader(const CellConfig& cell) : cell_(cell) {}

  // Empty where there is none, which take() tells: C0541.
  std::string address(const std::string& port) {
    const auto found = std::ranges::find(cell_.plant.ports, port, &PortAddress::port);
    if (found != cell_.plant.ports.end()) return found->address;
    problems_.push_back({"C0541", result::Severity::Error, cell_.plant.ports.front().where,
                         "the terminal " + port + " has no address",
                         port + " = \"%...\" in [plant.ports], or no [plant.ports] for terminals in a row"});
    return {};
  }
  result::Diagnostics take() { return std::move(problems_); }

 private:
  const CellConfig& cell_;
  result::Diagnostics problems_;
};

}  // namespace stepwright::config
