#pragma once

// One program in both engines, each in both of its forms (the interpreter with and without its quick one,
// native code plain and checked) and in engines that share the code of another, each with an image of its
// own: every run is compared byte for byte, and no check of the checked code may fail.
//
//   EnginePair pair(model);
//   pair.write<std::int32_t>(0, 7);
//   EXPECT_EQ(pair.run(), "");

#include <gtest/gtest.h>

#include <cstring>
#include <memory>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "runtime/native/native_engine.h"
#include "runtime/vm/interpreter.h"
#include "tests/support/test_program.h"

namespace stepwright::native {

#if defined(__x86_64__)
inline constexpr bool kHasCheckedForm = true;
#else
inline constexpr bool kHasCheckedForm = false;
#endif

class EnginePair {
 public:
  explicit EnginePair(const writer::ContainerModel& model)
      : loaded_(support::TestProgram::load(model)),
        stack_(loaded_.program().sizes().stack_slots),
        quick_code_(loaded_.program().container().section(bytecode::Section::Code).size()),
        interpreter_(loaded_.program(), stack_),
        quick_(loaded_.program(), stack_, quick_code_),
        other_stack_(stack_.size()),
        other_quick_(quick_.another(other_stack_)) {
    for (auto& image : images_) image.resize(loaded_.program().memory_size());
    native_ = compiled(NativeEngine::Form::Plain);
    if (kHasCheckedForm) checked_ = compiled(NativeEngine::Form::Checked);
    // Nobody asks; but budgets are handed out in slices, which must make no difference.
    native_->set_interrupt(&interrupt_);
    other_native_ = native_->another();
    other_native_->set_interrupt(&interrupt_);
    other_quick_.set_interrupt(&interrupt_);
    if (checked_) checked_->set_interrupt(&interrupt_);
    quick_.set_interrupt(&interrupt_);
    const auto initial = loaded_.program().container().section(bytecode::Section::InitialData);
    for (auto& image : images_) std::copy(initial.begin(), initial.end(), image.begin());
  }

  // Runs the first program call of a task in both; what differs, or nothing.
  std::string run(std::int64_t now_ns = 0, std::uint64_t budget = 10'000'000, std::uint32_t task = 0) {
    const auto& view = loaded_.program().container();
    return run_call(view.record<bytecode::Section::Tasks>(task).first_call, now_ns, budget, task);
  }

  // The same of any program call of the task.
  std::string run_call(std::uint32_t number, std::int64_t now_ns = 0, std::uint64_t budget = 10'000'000,
                       std::uint32_t task = 0) {
    const auto call = loaded_.program().container().record<bytecode::Section::ProgramCalls>(number);
    const bytecode::Invocation invocation{call.function, call.instance, now_ns,
                                          loaded_.program().frames_of(task)};
    std::uint64_t left = budget;
    trap_ = interpreter_.run(invocation, images_[0], left);
    return compare("native", *native_, images_[1], invocation, budget, left) +
           compare("quick", quick_, images_[2], invocation, budget, left) +
           compare("other native", *other_native_, images_[3], invocation, budget, left) +
           compare("other quick", other_quick_, images_[4], invocation, budget, left) +
           run_checked(invocation, budget, left);
  }

  // Requires as many bytes as the memory has.
  void reset(const std::vector<std::byte>& memory) {
    for (auto& image : images_) image = memory;
  }

  // The interpreter's trap of the last run.
  const bytecode::Trap& trap() const { return trap_; }

  template <typename T>
  void write(std::size_t address, T value) {
    for (auto& image : images_) std::memcpy(image.data() + address, &value, sizeof(T));
  }
  template <typename T>
  T read(std::size_t address) const {
    T value;
    std::memcpy(&value, images_[1].data() + address, sizeof(T));
    return value;
  }

  NativeEngine& native() { return *native_; }
  vm::Interpreter& quick() { return quick_; }
  // Of the native engine and of the interpreter with its quick form.
  bytecode::Interrupt& interrupt() { return interrupt_; }
  std::span<std::byte> native_image() { return images_[1]; }
  const reader::LoadedProgram& loaded() const { return loaded_; }

 private:
  std::unique_ptr<NativeEngine> compiled(NativeEngine::Form form) const {
    auto engine = NativeEngine::compile(loaded_.program(), form);
    if (!engine) throw std::runtime_error(result::to_string(engine.error()));
    return std::move(*engine);
  }

  std::string run_checked(const bytecode::Invocation& invocation, std::uint64_t budget, std::uint64_t left) {
    if (!checked_) return {};
    std::string out = compare("checked", *checked_, images_[5], invocation, budget, left);
    if (const auto broken = checked_->broken_check()) {
      out += "check broken in " + std::to_string(broken->function) + " at " + std::to_string(broken->pc);
    }
    return out;
  }

  // Compares another engine's run, beside the interpreter's trap, image and budget that is left.
  std::string compare(const char* name, bytecode::Engine& engine, std::vector<std::byte>& image,
                      const bytecode::Invocation& invocation, std::uint64_t budget, std::uint64_t left) {
    const bytecode::Trap trap = engine.run(invocation, image, budget);
    std::ostringstream out;
    if (trap != trap_) {
      out << "trap " << describe(trap_) << ", " << name << " " << describe(trap) << "; ";
    }
    if (left != budget) out << "budget left " << left << ", " << name << " " << budget << "; ";
    for (std::size_t i = 0; i < image.size(); ++i) {
      if (images_[0][i] == image[i]) continue;
      out << "byte " << i << " is " << static_cast<int>(images_[0][i]) << ", " << name << " "
          << static_cast<int>(image[i]) << "; ";
      break;
    }
    return out.str();
  }

  static std::string describe(const bytecode::Trap& trap) {
    return std::string(name_of(trap.code)) + " in " + std::to_string(trap.function) + " at " +
           std::to_string(trap.pc) + ", called in " + std::to_string(trap.caller) + " before " +
           std::to_string(trap.return_pc);
  }

  reader::LoadedProgram loaded_;
  std::vector<std::uint64_t> stack_;
  std::vector<std::byte> quick_code_;
  vm::Interpreter interpreter_;
  vm::Interpreter quick_;
  std::vector<std::uint64_t> other_stack_;
  vm::Interpreter other_quick_;
  std::unique_ptr<NativeEngine> native_;
  std::unique_ptr<NativeEngine> other_native_;
  std::unique_ptr<NativeEngine> checked_;  // null where there is no such form
  bytecode::Interrupt interrupt_;
  std::vector<std::byte> images_[6];
  bytecode::Trap trap_;
};

}  // namespace stepwright::native
