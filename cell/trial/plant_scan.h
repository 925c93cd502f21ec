#pragma once

// Programs in the real scan against a cell's simulated plant, in this thread and without the processes around
// them: one program after the other, the plant going on from where the last one left it.
//
//   auto scan = PlantScan::create(config);
//   (*scan)->load(container);
//   while ((*scan)->scan()) look((*scan)->image());
//
// Thread rule: one thread at a time.

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "cell/config/cell_config.h"
#include "runtime/ground/result/result.h"

namespace stepwright::trial {

class PlantScan {
 public:
  // A plant of its own, with the seed of the configuration. Fails as CellIo::create() does of a plant.
  [[nodiscard]] static result::Result<std::unique_ptr<PlantScan>> create(const config::CellConfig& config);
  virtual ~PlantScan() = default;

  // Puts a program in place of the one that runs, and starts it. Fails as a download does.
  [[nodiscard]] virtual result::Result<void> load(std::span<const std::byte> container) = 0;
  // Runs one scan; false once the program has trapped or the plant has failed.
  virtual bool scan() = 0;
  virtual std::span<const std::byte> image() const = 0;
  // Simulated time since the plant was made.
  virtual double now_s() const = 0;
};

}  // namespace stepwright::trial
