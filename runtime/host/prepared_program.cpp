#include "runtime/host/prepared_program.h"

#include <utility>

#include "runtime/host/limits.h"

namespace stepwright::host {
namespace {

tl::unexpected<result::Diagnostics> too_large(const char* what, std::size_t needed, std::size_t possible,
                                              const char* hint) {
  return result::fail("R0004", {"download", 0, 0},
                      std::string("the program needs ") + std::to_string(needed) + " bytes of " + what +
                          ", the runtime has " + std::to_string(possible),
                      hint);
}

}  // namespace

result::Result<std::unique_ptr<PreparedProgram>> PreparedProgram::create(
    std::vector<std::byte> container, std::string digest, AreaDriver& io, scan::Clock& clock,
    const scan::ScanConfig& config, std::size_t plant_values, EngineKind engine) {
  auto loaded = reader::LoadedProgram::load(std::move(container), "download");
  if (!loaded) return result::forward(loaded);
  const bytecode::Program& program = loaded->program();
  const char* const areas_hint = "see [image] of the cell's configuration";
  if (program.sizes().input_bytes > io.input_bytes()) {
    return too_large("inputs", program.sizes().input_bytes, io.input_bytes(), areas_hint);
  }
  if (program.sizes().output_bytes > io.output_bytes()) {
    return too_large("outputs", program.sizes().output_bytes, io.output_bytes(), areas_hint);
  }
  if (program.image_size() > kMaxImageBytes)
    return too_large("image", program.image_size(), kMaxImageBytes, "");
  auto info = reader::ProgramInfo::read(loaded->bytes());
  if (!info) return result::forward(info);
  auto made = make_engine(engine, program);
  if (!made) return result::forward(made);
  Machine machine{std::move(*made), BoolBytes(*info, program.image_size())};
  return std::unique_ptr<PreparedProgram>(new PreparedProgram(
      std::move(*loaded), std::move(machine), std::move(digest), io, clock, config, plant_values));
}

PreparedProgram::PreparedProgram(reader::LoadedProgram loaded, Machine machine, std::string digest,
                                 AreaDriver& io, scan::Clock& clock, const scan::ScanConfig& config,
                                 std::size_t plant_values)
    : digest_(std::move(digest)),
      loaded_(std::move(loaded)),
      memory_(loaded_.program().memory_size()),
      machine_(std::move(machine)),
      image_(memory_, scan::layout_of(loaded_.program())),
      cycle_(loaded_.program(), *machine_.engine, image_, io, clock, config),
      steps_(loaded_.program()),
      events_(loaded_.program().image_size(), plant_values) {
  image_.reset(loaded_.program().container().section(bytecode::Section::InitialData));
}

void PreparedProgram::warm() {
  image_.reset(loaded_.program().container().section(bytecode::Section::InitialData));
  events_.warm();
}

}  // namespace stepwright::host
