#include "tests/bench/scan/start.h"

#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "runtime/bytecode/writer/container_writer.h"
#include "runtime/service/connection.h"
#include "tests/bench/scan/workloads.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/test_process.h"

namespace stepwright::bench {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kStarts = 15;
constexpr std::uint32_t kRungs = 1'000;
constexpr std::uint32_t kWords = 1'000;

[[noreturn]] void give_up(const std::string& why) {
  std::fprintf(stderr, "bench_scan: %s\n", why.c_str());
  std::exit(1);
}

double ms_since(Clock::time_point begin) {
  return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

void add_symbol(writer::ContainerModel& model, const std::string& name, std::uint32_t type,
                std::uint32_t address) {
  writer::Symbol symbol;
  symbol.name = name;
  symbol.type = type;
  symbol.address = address;
  symbol.flags = bytecode::kSymbolRetain;
  model.symbols.push_back(std::move(symbol));
}

// The ladder of the other benchmarks, its coils and 1000 numbers retained. A step becomes active in the first
// scan, so that its event tells a client of it.
std::vector<std::byte> container() {
  writer::ContainerModel model = Ladder(kRungs, 42).bytecode();
  const std::uint32_t coils = Ladder::kInputs / 8;
  const std::uint32_t words = coils + kRungs;
  const std::uint32_t step = words + 4 * kWords;
  model.sizes.data_bytes =
      step + 1 - model.sizes.input_bytes - model.sizes.output_bytes - model.sizes.marker_bytes;
  const auto boolean = model.add_type(writer::elementary(bytecode::ElementaryType::Bool));
  const auto number = model.add_type(writer::elementary(bytecode::ElementaryType::Dint));
  for (std::uint32_t i = 0; i < kRungs; ++i)
    add_symbol(model, "MAIN.coil" + std::to_string(i), boolean, coils + i);
  for (std::uint32_t i = 0; i < kWords; ++i)
    add_symbol(model, "MAIN.word" + std::to_string(i), number, words + 4 * i);
  model.retain.push_back({coils, kRungs + 4 * kWords});
  writer::FunctionBuilder flag("FLAG", bytecode::FunctionKind::Program, 1);
  flag.const_bool(true);
  flag.store(bytecode::MemType::Bool, bytecode::AddressMode::This, 0);
  flag.emit(bytecode::Opcode::Return);
  model.functions.push_back(std::move(flag).take());
  model.tasks[0].calls.push_back({"FLAG", static_cast<std::uint32_t>(model.functions.size() - 1), step});
  writer::SfcChart chart;
  chart.name = "CHART";
  writer::SfcStep runs;
  runs.name = "RUNS";
  runs.address = step;
  chart.steps.push_back(std::move(runs));
  model.charts.push_back(std::move(chart));
  auto bytes = writer::write_container(model);
  if (!bytes) give_up(result::to_string(bytes.error()));
  return std::move(*bytes);
}

// A cell in a folder that goes with it.
class Cell {
 public:
  Cell() {
    const std::vector<std::byte> bytes = container();
    std::ofstream(folder_ / "rungs.swb", std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    std::ofstream(folder_ / "cell.toml") << "[cell]\nname = \"start\"\nstate_dir = \"state\"\n"
                                            "[plant]\nkind = \"none\"\n[clock]\nmode = \"real\"\n"
                                            "[runtime]\nprogram = \"rungs.swb\"\nautostart = true\n";
  }

  support::TestProcess start() const {
    return {{STEPWRIGHT_BIN_DIR "/stepwright-runtime", "--config", (folder_ / "cell.toml").string()},
            folder_ / "log"};
  }
  // Waits for the event of the first scan.
  void await_first_scan() const {
    std::unique_ptr<service::Connection> client;
    const auto give_up_at = Clock::now() + support::kPatience;
    while (!client && Clock::now() < give_up_at) {
      auto opened = service::Connection::open(folder_ / "state" / "runtime.sock",
                                              {service::Role::Observer, "bench", 1});
      if (opened) client = std::move(*opened);
      if (!client) usleep(100);
    }
    if (!client) give_up("the runtime does not come up: " + text(folder_ / "log"));
    while (auto message = client->receive(support::kPatience)) {
      const auto* event = std::get_if<host::StepEvent>(&*message);
      if (event != nullptr && event->kind == host::EventKind::StepChange) return;
    }
    give_up("no scan came: " + text(folder_ / "log"));
  }

 private:
  static std::string text(const std::filesystem::path& file) {
    std::ifstream in(file);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  support::TemporaryFolder folder_;
};

double resident_mb(pid_t process) {
  std::ifstream status("/proc/" + std::to_string(process) + "/status");
  std::string word;
  double kb = 0.0;
  while (status >> word) {
    if (word == "VmRSS:") status >> kb;
  }
  return kb / 1'024.0;
}

double bare_process_ms() {
  const auto begin = Clock::now();
  const pid_t child = fork();
  if (child == 0) {
    execl("/bin/true", "true", nullptr);
    _exit(1);
  }
  waitpid(child, nullptr, 0);
  return ms_since(begin);
}

}  // namespace

StartFigures measure_start() {
  const Cell cell;
  std::vector<double> first_scans;
  std::vector<double> bare;
  StartFigures figures;
  // The first start makes the store that the others find.
  for (int i = 0; i <= kStarts; ++i) {
    bare.push_back(bare_process_ms());
    const auto begin = Clock::now();
    support::TestProcess runtime = cell.start();
    cell.await_first_scan();
    if (i > 0) first_scans.push_back(ms_since(begin));
    if (i == kStarts) {
      std::this_thread::sleep_for(std::chrono::seconds(1));
      figures.resident_mb = resident_mb(runtime.pid());
    }
    if (i > 0) {
      runtime.kill();
    } else {
      runtime.send(SIGTERM);
      runtime.wait();
    }
  }
  figures.first_scan_ms = median(first_scans);
  figures.first_scan_max_ms = *std::max_element(first_scans.begin(), first_scans.end());
  figures.bare_process_ms = median(bare);
  std::printf("%-20s %.1f ms to the first scan (at most %.1f), a bare process %.1f ms, resident %.1f MB\n",
              "start", figures.first_scan_ms, figures.first_scan_max_ms, figures.bare_process_ms,
              figures.resident_mb);
  return figures;
}

}  // namespace stepwright::bench
