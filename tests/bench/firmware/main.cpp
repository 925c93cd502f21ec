// The firmware on its boards under QEMU: instructions per rung (-icount: every instruction takes 2^5 ns of
// the board's time, so that the clock of the board counts them), flash and RAM of the images, what 1000 rungs
// need, and the round trip of a request over RTU beside the same application as a process of this machine
// at a pty. QEMU knows no pipeline: cycles are instructions times what the core takes for one (1.2 to 1.5 on
// a Cortex-M3 without wait states).
//
//   bench_firmware [--json FILE]

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "ladder/driver/compile.h"
#include "runtime/bytecode/reader/loaded_program.h"
#include "tests/cells/firmware/rig.h"
#include "tests/support/long_sources.h"
#include "tests/support/test_process.h"

namespace stepwright::bench {
namespace {

using firmware_test::Rig;
using Bytes = std::vector<std::byte>;
using Clock = std::chrono::steady_clock;
namespace status = modbus::control::status;

constexpr int kShift = 5;  // 32 ns an instruction
constexpr int kRungs = 1000;
constexpr int kScans = 20;
constexpr int kRequests = 500;

Bytes rungs(int count) {
  driver::CompileInput input;
  input.texts.push_back({"rungs.st", support::many_rungs(count)});
  auto output = driver::compile(input);
  if (!output) throw std::runtime_error(result::to_string(output.error()));
  return std::move(output->container);
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Microseconds of the board's clock; half of kScans scans have other inputs than the ones before.
double scan_us(Rig& rig, int count) {
  rig.controller().download(rungs(count));
  rig.controller().start_lock_step();
  std::vector<double> times;
  const std::size_t inputs = rig.controller().status().input_bytes;
  for (int i = 0; i < kScans; ++i) {
    rig.controller().turn(Bytes(inputs, static_cast<std::byte>(i * 37)));
    std::array<std::uint16_t, 2> words{};
    if (!rig.controller().line().read(status::kFirst + status::kScanUs, words).ok())
      throw std::runtime_error("the board does not answer");
    times.push_back(modbus::control::get32(words, 0));
  }
  return median(times);
}

void measure_instructions(const std::string& board, nlohmann::json& out) {
  Rig rig(board, kShift);
  const double per_us = 1000.0 / (1 << kShift);
  const double once = scan_us(rig, kRungs) * per_us;
  const double twice = scan_us(rig, 2 * kRungs) * per_us;
  out[board + "_instructions_per_rung"] = (twice - once) / kRungs;
  out[board + "_instructions_per_scan_1000_rungs"] = once;
  std::printf("%-16s %6.1f instructions a rung, %.0f a scan of %d rungs\n", board.c_str(),
              (twice - once) / kRungs, once, kRungs);
}

std::map<std::string, long> sections(const std::string& image) {
  std::map<std::string, long> sizes;
  FILE* const pipe = ::popen(("arm-none-eabi-size -A " + Rig::image(image).string()).c_str(), "r");
  std::array<char, 256> line;
  while (pipe != nullptr && std::fgets(line.data(), line.size(), pipe) != nullptr) {
    std::istringstream fields(line.data());
    std::string name;
    long size = 0;
    if (fields >> name >> size) sizes[name] = size;
  }
  if (pipe != nullptr) ::pclose(pipe);
  return sizes;
}

void measure_size(const std::string& image, nlohmann::json& out) {
  auto size = sections(image);
  const long flash = size[".text"] + size[".exidx"] + size[".data"];
  const long ram = size[".data"] + size[".bss"] + size[".noinit"] + size[".stack"];
  out[image + "_flash_bytes"] = flash;
  out[image + "_ram_bytes"] = ram;
  std::printf("%-16s %6ld bytes of flash, %ld of RAM (%ld of them stack)\n", image.c_str(), flash, ram,
              size[".stack"]);
}

void measure_program(nlohmann::json& out) {
  Bytes container = rungs(kRungs);
  out["rungs_1000_container_bytes"] = container.size();
  const auto loaded = reader::LoadedProgram::load(std::move(container), "rungs");
  if (!loaded) throw std::runtime_error(result::to_string(loaded.error()));
  const bytecode::Program& program = loaded->program();
  out["rungs_1000_code_bytes"] = program.container().section(bytecode::Section::Code).size();
  out["rungs_1000_image_bytes"] = program.image_size();
  out["rungs_1000_vm_stack_bytes"] = program.sizes().stack_slots * 8;
  out["rungs_1000_scratch_bytes"] = bytecode::verify_scratch_words(loaded->bytes()) * 4;
  std::printf("%d rungs: container %zu bytes, code %zu, image %u, VM stack %u, scratch of the verifier %zu\n",
              kRungs, out["rungs_1000_container_bytes"].get<std::size_t>(),
              out["rungs_1000_code_bytes"].get<std::size_t>(), program.image_size(),
              program.sizes().stack_slots * 8, out["rungs_1000_scratch_bytes"].get<std::size_t>());
}

void measure_requests(const std::string& name, support::RemoteController& controller, nlohmann::json& out) {
  std::vector<double> times;
  for (int i = 0; i < kRequests; ++i) {
    std::array<std::uint16_t, 10> words{};
    const auto begin = Clock::now();
    if (!controller.line().read(status::kFirst, words).ok()) throw std::runtime_error("no answer");
    times.push_back(std::chrono::duration<double, std::micro>(Clock::now() - begin).count());
  }
  std::sort(times.begin(), times.end());
  const double p50 = times[times.size() / 2];
  const double p99 = times[times.size() * 99 / 100];
  out[name + "_request_p50_us"] = p50;
  out[name + "_request_p99_us"] = p99;
  std::printf("%-16s request p50 %.0f us, p99 %.0f us\n", name.c_str(), p50, p99);
}

// The same application without an emulator.
void measure_host(nlohmann::json& out) {
  const auto folder = std::filesystem::temp_directory_path();
  const std::string stem = "firmware-host-" + std::to_string(::getpid());
  const auto flash = folder / (stem + ".bin");
  const auto log = folder / (stem + ".log");
  support::TestProcess process({STEPWRIGHT_BIN_DIR "/firmware_host", flash.string()}, log);
  if (!process.wait_for("\n")) throw std::runtime_error("firmware_host names no line");
  std::string device = process.output();
  device.resize(device.find('\n'));
  firmware_test::PtyLine line(modbus::master::SerialEndpoint{
      .device = device, .baud = 115'200, .parity = modbus::master::Parity::None});
  support::RemoteController controller(line);
  measure_requests("host", controller, out);
  process.kill();
  std::filesystem::remove(flash);
  std::filesystem::remove(log);
}

nlohmann::json run() {
  nlohmann::json out;
  for (const char* image : {"mps2-an385-basic", "mps2-an385", "mps2-an386"}) measure_size(image, out);
  measure_program(out);
  for (const char* board : {"mps2-an385", "mps2-an386"}) {
    measure_instructions(board, out);
    Rig rig(board);
    measure_requests(board, rig.controller(), out);
  }
  measure_host(out);
  return out;
}

}  // namespace
}  // namespace stepwright::bench

int main(int argc, char** argv) {
  const bool json = argc == 3 && std::strcmp(argv[1], "--json") == 0;
  if (argc != 1 && !json) {
    std::fprintf(stderr, "usage: bench_firmware [--json FILE]\n");
    return 2;
  }
  try {
    const nlohmann::json out = stepwright::bench::run();
    if (!json) return 0;
    std::ofstream file(argv[2]);
    file << out.dump(2) << "\n";
    return file.flush() ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
