#include "runtime/host/program_fit.h"

#include "runtime/host/limits.h"

namespace stepwright::host {

result::Result<void> check_fit(const bytecode::Program& program, const CellAreas& areas,
                               const std::string& name) {
  const auto too_large = [&](const char* what, std::size_t needed, std::size_t possible, const char* hint) {
    return result::fail("R0080", {name, 0, 0},
                        std::string("the program needs ") + std::to_string(needed) + " bytes of " + what +
                            ", the runtime has " + std::to_string(possible),
                        hint);
  };
  const bytecode::SizesRecord& sizes = program.sizes();
  const char* const areas_hint = "see [image] of the cell's configuration";
  if (sizes.input_bytes > areas.input_bytes)
    return too_large("inputs", sizes.input_bytes, areas.input_bytes, areas_hint);
  if (sizes.output_bytes > areas.output_bytes)
    return too_large("outputs", sizes.output_bytes, areas.output_bytes, areas_hint);
  if (program.image_size() > kMaxImageBytes)
    return too_large("image", program.image_size(), kMaxImageBytes, "");
  return {};
}

}  // namespace stepwright::host
