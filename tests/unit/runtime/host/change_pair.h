#pragma once

// A program that runs and another one that takes over from it, in one thread and scan by scan: what the scan
// loop does at an online change, without its threads.
//
//   ChangePair pair("PROGRAM main ...", "PROGRAM main ...");
//   pair.scan(50);
//   pair.change();
//   pair.scan(1);
//   EXPECT_EQ(pair.text("main.n"), "51");

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "runtime/bytecode/reader/program_info.h"
#include "runtime/bytecode/reader/read_value.h"
#include "runtime/host/change_plan.h"
#include "runtime/image/no_io.h"
#include "runtime/scan/no_clock.h"
#include "tests/unit/runtime/host/st_program.h"

namespace stepwright::host {

// A program main with these declarations and this body, its outputs in the usual way.
inline std::string program_text(const std::string& declarations, const std::string& body = "") {
  return "PROGRAM main\n" + declarations + "\n" + body + "\nEND_PROGRAM\n";
}

class ChangePair {
 public:
  ChangePair(const std::string& before, const std::string& after, DownloadMode mode = DownloadMode::Change)
      : before_(prepare(before)), after_(prepare(after)) {
    auto plan = ChangePlan::make(*before_, *after_, mode);
    if (plan) {
      plan_ = std::move(*plan);
    } else {
      refusal = plan.error();
    }
    running_ = before_.get();
    before_->cycle().start({});
  }

  void scan(int count) {
    for (int i = 0; i < count; ++i) last = running_->cycle().run_scan();
  }

  // False, with the problem in `refusal`, if an active step would be lost.
  bool change() {
    if (const auto step = plan_->lost_step(before_->image().bytes())) {
      refusal = {plan_->lost_step_problem(*step)};
      return false;
    }
    if (const auto chart = plan_->impossible_chart(before_->image().bytes())) {
      refusal = {plan_->impossible_chart_problem(*chart)};
      return false;
    }
    plan_->carry(before_->image(), after_->image());
    dropped_forces = plan_->move_forces(before_->cycle().forces(), after_->cycle().forces());
    after_->cycle().take_over(before_->cycle(), plan_->tasks());
    running_ = after_.get();
    return true;
  }

  // Of the program that runs.
  std::string text(const std::string& path) { return text_in(*running_, path); }
  std::string text_before(const std::string& path) { return text_in(*before_, path); }
  void set(const std::string& path, std::int64_t value) {
    const reader::Variable variable = find(*running_, path);
    const auto size =
        variable.bit == bytecode::kNoBit ? bytecode::size_of(bytecode::mem_type(variable.type)) : 1;
    std::memcpy(running_->image().bytes().data() + variable.address, &value, size);
  }
  // Of a whole variable, or of the bit of a located BOOL.
  void force(const std::string& path, std::uint64_t value) {
    const reader::Variable variable = find(*running_, path);
    image::Force force{variable.address, image::kWholeBytes, 1, value};
    if (variable.bit != bytecode::kNoBit)
      force.bit = variable.bit;
    else
      force.size = static_cast<std::uint8_t>(bytecode::size_of(bytecode::mem_type(variable.type)));
    EXPECT_TRUE(running_->cycle().forces().set(force, running_->image().bytes().size()));
  }

  PreparedProgram& running() { return *running_; }
  PreparedProgram& before() { return *before_; }
  PreparedProgram& after() { return *after_; }
  const ChangePlan& plan() const { return *plan_; }

  result::Diagnostics refusal;
  std::uint32_t dropped_forces = 0;
  scan::ScanReport last;

 private:
  std::unique_ptr<PreparedProgram> prepare(const std::string& text) {
    auto program = PreparedProgram::create(compiled(text), "digest", {io_, clock_, config_});
    if (!program) throw std::runtime_error(result::to_string(program.error()));
    return std::move(*program);
  }
  static reader::Variable find(PreparedProgram& program, const std::string& path) {
    const auto info = reader::ProgramInfo::read(program.loaded().bytes());
    const reader::Variable* variable = info->find(path);
    if (variable == nullptr) throw std::runtime_error("no variable " + path);
    return *variable;
  }
  static std::string text_in(PreparedProgram& program, const std::string& path) {
    return reader::read_text(find(program, path), program.image().bytes());
  }

  static HostConfig interpreted() {
    HostConfig config;
    config.engine = EngineKind::Vm;
    return config;
  }

  const HostConfig config_ = interpreted();
  image::NoIo no_io_;
  AreaDriver io_{no_io_, 64, 64};
  scan::NoClock clock_;
  std::unique_ptr<PreparedProgram> before_;
  std::unique_ptr<PreparedProgram> after_;
  std::unique_ptr<ChangePlan> plan_;
  PreparedProgram* running_ = nullptr;
};

}  // namespace stepwright::host
