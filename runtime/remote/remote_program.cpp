#include "runtime/remote/remote_program.h"

#include <algorithm>
#include <charconv>
#include <utility>

#include "runtime/bytecode/reader/program_info.h"

namespace stepwright::remote {

RemoteProgram::RemoteProgram(reader::LoadedProgram loaded, host::BoolBytes bools, std::string digest)
    : loaded_(std::move(loaded)), bools_(std::move(bools)), digest_(std::move(digest)) {
  for (const reader::TaskInfo& task : reader::task_infos(program().container())) {
    const std::int64_t interval_ns = std::int64_t{task.interval_us} * 1'000;
    if (interval_ns > 0 && (interval_ns_ == 0 || interval_ns < interval_ns_)) interval_ns_ = interval_ns;
  }
}

result::Result<std::shared_ptr<const RemoteProgram>> RemoteProgram::create(std::vector<std::byte> container,
                                                                           std::string digest) {
  auto loaded = reader::LoadedProgram::load(std::move(container), "download");
  if (!loaded) return result::forward(loaded);
  const bytecode::SizesRecord& sizes = loaded->program().sizes();
  if (sizes.input_bytes > control::inputs::kMaxBytes || sizes.output_bytes > control::outputs::kMaxBytes) {
    return result::fail("R0145", {"download", 0, 0},
                        "the program has " + std::to_string(sizes.input_bytes) + " bytes of inputs and " +
                            std::to_string(sizes.output_bytes) +
                            " of outputs; one turn over Modbus carries " +
                            std::to_string(control::inputs::kMaxBytes) + " and " +
                            std::to_string(control::outputs::kMaxBytes),
                        "addresses that begin at %IB0 and %QB0 without gaps take the least room");
  }
  auto bools = host::BoolBytes::of(loaded->program(), "download");
  if (!bools) return result::forward(bools);
  return std::shared_ptr<const RemoteProgram>(
      new RemoteProgram(std::move(*loaded), std::move(*bools), std::move(digest)));
}

result::Result<void> RemoteProgram::check_fit(std::size_t input_bytes, std::size_t output_bytes) const {
  if (sizes().input_bytes <= input_bytes && sizes().output_bytes <= output_bytes) return {};
  return result::fail(
      "R0145", {"download", 0, 0},
      "the program has more inputs or outputs than the cell: " + std::to_string(sizes().input_bytes) +
          " and " + std::to_string(sizes().output_bytes) + " bytes",
      "[image] input_bytes and output_bytes say how many the cell has");
}

ProgramDigest RemoteProgram::digest_bytes() const {
  ProgramDigest digest{};
  for (std::size_t i = 0; i < digest.size() && 2 * i + 2 <= digest_.size(); ++i) {
    unsigned value = 0;
    std::from_chars(digest_.data() + 2 * i, digest_.data() + 2 * i + 2, value, 16);
    digest[i] = static_cast<std::byte>(value);
  }
  return digest;
}

}  // namespace stepwright::remote
