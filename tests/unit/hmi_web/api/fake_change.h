#pragma once

// A runtime that takes every program that the test does not refuse, and says of a trial what the test wants.
//
// Threads: one.

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "hmi_web/access/secrets.h"
#include "hmi_web/api/cell_change.h"

namespace stepwright::api {

class FakeChange : public CellChange {
 public:
  using Bytes = std::vector<std::byte>;

  static std::string digest_of(std::span<const std::byte> bytes) {
    return access::sha256_hex({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  }

  result::Result<LoadedNow> loaded() override {
    if (!container_) return result::fail("D0001", {}, "no runtime answers with a program");
    return LoadedNow{digest_of(*container_), container_, running, {}};
  }
  std::string engaged() override { return supervisor; }
  Bytes fitted(Bytes container) override { return container; }
  result::Result<Takeover> change(std::span<const std::byte> container, bool restart_charts) override {
    if (!refusal.empty()) return result::fail(refusal, {}, "as the test wants it");
    old_ = container_;
    load({container.begin(), container.end()});
    restarted = restart_charts;
    ++changes;
    trial_.state = Trial::State::Running;
    return Takeover{7, 1, 2, 3, 4, 5.5, {"7 variables keep their values"}};
  }
  Trial trial() override { return trial_; }
  result::Result<Compiled> compile(const SourceTexts& sources) override {
    compiled = sources;
    if (!compiled_to)
      return result::fail("E0201", {sources.begin()->first, 3, 7}, "'speeed' is not declared",
                          "did you mean 'speed'?");
    return Compiled{*compiled_to, {{"W0003", result::Severity::Warning, {"a.st", 2, 1}, "never used", ""}}};
  }
  Answer sources(const std::string& digest, std::span<const std::byte>) override {
    return Answer{.text = "{\"digest\": \"" + digest + "\"}"};
  }

  void load(Bytes container) { container_ = std::make_shared<const Bytes>(std::move(container)); }
  // Ends the trial; the runtime goes back by itself.
  void end(Trial::State state, std::string why = {}) {
    trial_ = {state, 10, 10, std::move(why)};
    if (state == Trial::State::RolledBack) container_ = old_;
  }

  bool running = true;
  std::string supervisor;  // what it does; empty: nothing
  std::string refusal;     // code with which every change is refused
  std::unique_ptr<Bytes> compiled_to;
  SourceTexts compiled;
  bool restarted = false;
  int changes = 0;

 private:
  std::shared_ptr<const Bytes> container_;
  std::shared_ptr<const Bytes> old_;
  Trial trial_;
};

}  // namespace stepwright::api
