#pragma once

// Reads a program's variables and step bits out of an image, by the symbols of its container.
//
//   auto reader = ImageReader::create(container, "planned", {"S1_filtered"});
//   std::vector<bool> active = reader->active_steps(event.image);   // in the order of the chart's steps
//   double counts = reader->values(event.image).at("S1_filtered");
//
// Immutable; images may be shorter than the program's (a foreign or cut sample): what lies outside reads as
// 0.

#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "runtime/bytecode/reader/program_info.h"
#include "runtime/ground/result/result.h"

namespace stepwright::run {

class ImageReader {
 public:
  // Fails (X0002) if the container is not valid, has no chart of that name or lacks one of `variables`.
  [[nodiscard]] static result::Result<ImageReader> create(std::span<const std::byte> container,
                                                          const std::string& chart,
                                                          const std::vector<std::string>& variables);

  std::vector<bool> active_steps(std::span<const std::byte> image) const;
  // Every variable given to `create`: BOOLs as 0 or 1.
  std::map<std::string, double> values(std::span<const std::byte> image) const;

 private:
  std::vector<reader::StepInfo> steps_;
  std::map<std::string, reader::Variable> variables_;
};

}  // namespace stepwright::run
