#pragma once

// A program that retains some values, and a retain manager for them, without a scan: the test plays the scan
// thread.
//
//   RetainedMachine machine("VAR RETAIN n : DINT; END_VAR", {.store = folder.path() / "retain.store"});
//   machine.start();
//   machine.set("MAIN.n", 7);
//   machine.stop();

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>

#include "runtime/record/retain_manager.h"
#include "tests/support/compiled_program.h"
#include "tests/support/patience.h"
#include "tests/support/temporary_folder.h"

namespace stepwright::record {

// A folder that goes with the test. In memory, where there is such a place and it is asked for, a thousand
// writes take no longer on a busy disk.
class TestFolder {
 public:
  explicit TestFolder(bool in_memory = false) : folder_(around(in_memory)) {}

  const std::filesystem::path& path() const { return folder_.path(); }
  std::filesystem::path store() const { return folder_ / "retain.store"; }

 private:
  static std::filesystem::path around(bool in_memory) {
    const std::filesystem::path memory = "/dev/shm";
    const bool possible = in_memory && access(memory.c_str(), W_OK) == 0;
    return possible ? memory : std::filesystem::path(testing::TempDir());
  }

  support::TemporaryFolder folder_;
};

class RetainedMachine {
 public:
  RetainedMachine(const std::string& declarations, const RetainConfig& config)
      : retain_(RetainManager::open(config)), program_(compile(declarations)) {
    channel_ = retain_->prepare(program_->loaded().program()).value();
  }

  // Another program takes the place of this one.
  void load(const std::string& declarations) {
    program_ = compile(declarations);
    channel_ = retain_->prepare(program_->loaded().program()).value();
  }
  result::Diagnostics start(bool cold = false) {
    if (auto problems = retain_->refusal(*channel_, cold); !problems.empty()) return problems;
    program_->start_at(0);
    retain_->begin(*channel_, image(), cold);
    return {};
  }
  // As start, with nothing around it; false if it is refused.
  bool begin() {
    program_->start_at(0);
    if (!retain_->refusal(*channel_, false).empty()) return false;
    retain_->begin(*channel_, image(), false);
    return true;
  }
  void stop() { retain_->finish(image()); }
  void offer() { retain_->offer(image(), ++now_ns_ * 1'000'000'000); }

  // True once the disk has everything that was published; false after a generous time.
  bool settled() {
    const auto deadline = std::chrono::steady_clock::now() + support::kPatience;
    while (retain_->committed() < retain_->published()) {
      if (std::chrono::steady_clock::now() > deadline) return false;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return true;
  }

  void set(const std::string& path, std::int64_t value) { program_->set(path, value); }
  std::int64_t get(const std::string& path) { return program_->get(path); }
  std::string text(const std::string& path) { return program_->text(path); }
  RetainManager& retain() { return *retain_; }
  std::span<std::byte> image() { return program_->image().bytes(); }

 private:
  static std::unique_ptr<support::CompiledProgram> compile(const std::string& declarations) {
    const std::string text = "PROGRAM MAIN\n" + declarations + "\nEND_PROGRAM\n";
    return std::make_unique<support::CompiledProgram>(driver::CompileInput{{{"test.st", text}}});
  }

  std::unique_ptr<RetainManager> retain_;
  std::unique_ptr<support::CompiledProgram> program_;
  std::shared_ptr<RetainChannel> channel_;
  std::int64_t now_ns_ = 0;
};

}  // namespace stepwright::record
