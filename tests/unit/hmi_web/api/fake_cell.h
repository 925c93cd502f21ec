#pragma once

// A cell that remembers what it was asked, and answers as it is told to.
//
// Threads: any.

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "hmi_web/api/cell_control.h"

namespace stepwright::api {

class FakeCell : public CellControl {
 public:
  result::Result<void> ask_supervisor(const std::string& request) override { return note(request); }
  std::string goal_form() override { return text_of(goal_form_); }
  std::string outlook() override { return text_of(outlook_); }
  result::Result<void> stop_runtime(const std::string& reason) override { return note("stop " + reason); }
  result::Result<void> reach() override {
    const std::lock_guard lock(mutex_);
    for (auto& [name, value] : std::exchange(started_with_, {})) values_[name] = std::move(value);
    return {};
  }
  result::Result<std::string> read(const std::string& name) override {
    const std::lock_guard lock(mutex_);
    const auto found = values_.find(name);
    if (found == values_.end()) return result::fail("R0057", {}, "there is no variable `" + name + "`");
    return found->second;
  }
  std::shared_ptr<const reader::ProgramInfo> program() override {
    const std::lock_guard lock(mutex_);
    return program_;
  }
  // A variable that is there takes anything but what `refuse` names.
  result::Result<std::string> spell(const std::string& name, const std::string& value) override {
    if (auto there = read(name); !there) return there;
    const std::lock_guard lock(mutex_);
    if (failure_ == "D0001") return result::fail(failure_, {}, "as the test wants it");
    if (value == refused_) return result::fail("R0058", {}, "`" + value + "` is no value");
    return value;
  }
  result::Result<std::string> write(const std::string& name, const std::string& value) override {
    if (auto noted = note("write " + name + " " + value); !noted) return result::forward(noted);
    const std::lock_guard lock(mutex_);
    return values_[name] = value;
  }
  result::Result<std::string> force(const std::string& name, const std::string& value,
                                    std::chrono::milliseconds duration) override {
    if (auto noted = note("force " + name + " " + value); !noted) return result::forward(noted);
    const std::lock_guard lock(mutex_);
    forced_[name] = {name, value, true};
    duration_ = duration;
    return value;
  }
  result::Result<void> unforce(const std::string& name) override {
    if (auto noted = note("unforce " + name); !noted) return noted;
    unforce_unseen(name);
    return {};
  }
  result::Result<void> write_together(
      const std::map<std::string, std::string, std::less<>>& values) override {
    std::string all = "write";
    for (const auto& [name, value] : values) all += " " + name + " " + value;
    if (const std::lock_guard lock(mutex_); !write_failure_.empty())
      return result::fail(write_failure_, {}, "as the test wants it");
    if (auto noted = note(all); !noted) return noted;
    const std::lock_guard lock(mutex_);
    for (const auto& [name, value] : values) values_[name] = value;
    return {};
  }
  result::Result<std::vector<host::PlantFault>> faults() override {
    const std::lock_guard lock(mutex_);
    if (!failure_.empty()) return result::fail(failure_, {}, "as the test wants it");
    return faults_;
  }
  // Takes what is in the range.
  result::Result<void> set_fault(const std::string& name, std::optional<double> value) override {
    if (auto noted = note("fault " + name); !noted) return noted;
    const std::lock_guard lock(mutex_);
    for (host::PlantFault& fault : faults_) {
      if (fault.name != name) continue;
      if (value && (*value < fault.low || *value > fault.high))
        return result::fail("C0312", {}, "fault '" + name + "' cannot have that value");
      fault.holds = value.has_value();
      fault.value = value.value_or(0.0);
      return {};
    }
    return result::fail("C0311", {}, "the plant has no fault named '" + name + "'");
  }
  result::Result<std::vector<ForcedPlace>> forced() override {
    const std::lock_guard lock(mutex_);
    const std::string& code = failure_.empty() ? telling_fails_ : failure_;
    if (!code.empty()) return result::fail(code, {}, "as the test wants it");
    std::vector<ForcedPlace> places;
    for (const auto& [name, place] : forced_) places.push_back(place);
    return places;
  }
  result::Result<ForcedPlace> as_forced(const std::string& name, const std::string& value) override {
    const std::lock_guard lock(mutex_);
    if (!failure_.empty()) return result::fail(failure_, {}, "as the test wants it");
    return ForcedPlace{name, value, true};
  }

  // The runtime is being started again, and will have these values.
  void start_with(std::map<std::string, std::string> values) {
    const std::lock_guard lock(mutex_);
    started_with_ = std::move(values);
  }
  // At the runtime's own socket, or by another program; without an end.
  void force_unseen(const std::string& name, const std::string& value) {
    const std::lock_guard lock(mutex_);
    forced_[name] = {name, value, false};
  }
  // Of the newest force.
  std::chrono::milliseconds duration() const {
    const std::lock_guard lock(mutex_);
    return duration_;
  }
  void unforce_unseen(const std::string& name) {
    const std::lock_guard lock(mutex_);
    forced_.erase(name);
  }
  // The code with which it refuses to tell what is forced; empty: it tells.
  void forces_fail_with(std::string code) {
    const std::lock_guard lock(mutex_);
    telling_fails_ = std::move(code);
  }
  // The code with which writes of several values fail; empty: they do not.
  void writes_fail_with(std::string code) {
    const std::lock_guard lock(mutex_);
    write_failure_ = std::move(code);
  }

  // Runs from now on; its variables are still those that were set.
  void run(std::shared_ptr<const reader::ProgramInfo> program) {
    const std::lock_guard lock(mutex_);
    program_ = std::move(program);
  }

  // Sets the supervisor's answers from now on.
  void say(const std::string& goal_form, const std::string& outlook) {
    const std::lock_guard lock(mutex_);
    goal_form_ = goal_form;
    outlook_ = outlook;
  }
  // The code with which everything fails from now on; empty: nothing does.
  void fail_with(std::string code) {
    const std::lock_guard lock(mutex_);
    failure_ = std::move(code);
  }
  void set(const std::string& name, const std::string& value) {
    const std::lock_guard lock(mutex_);
    values_[name] = value;
  }
  std::string value(const std::string& name) const {
    const std::lock_guard lock(mutex_);
    return values_.at(name);
  }
  // No variable takes this value.
  void refuse(std::string value) {
    const std::lock_guard lock(mutex_);
    refused_ = std::move(value);
  }
  std::vector<std::string> asked() const {
    const std::lock_guard lock(mutex_);
    return asked_;
  }

 private:
  std::string text_of(const std::string& document) const {
    const std::lock_guard lock(mutex_);
    return document;
  }
  result::Result<void> note(const std::string& what) {
    const std::lock_guard lock(mutex_);
    if (!failure_.empty()) return result::fail(failure_, {}, "as the test wants it");
    asked_.push_back(what);
    return {};
  }

  mutable std::mutex mutex_;
  std::vector<std::string> asked_;
  std::map<std::string, std::string> values_ = {{"MAIN.valve", "FALSE"}};
  std::map<std::string, std::string> started_with_;
  std::vector<host::PlantFault> faults_ = {{"t1.leak", "percent/s", "it leaks", 0.0, 5.0},
                                           {"v1.stuck", "", "1: it stays", 0.0, 1.0, true}};
  std::shared_ptr<const reader::ProgramInfo> program_;
  std::string goal_form_;
  std::string outlook_;
  std::string failure_;
  std::string refused_ = "none";
  std::string write_failure_;
  std::string telling_fails_;
  std::map<std::string, ForcedPlace> forced_;
  std::chrono::milliseconds duration_{0};
};

}  // namespace stepwright::api
