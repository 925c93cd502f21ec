#pragma once

// Figures in the text form that Prometheus reads (text exposition format 0.0.4), family by family. Every
// /metrics of Stepwright is written with it.
//
//   Exposition text;
//   text.family("stepwright_modbus_server_requests_total", "counter", "Requests since the server began.");
//   text.sample(label("cell", "bench"), 1234);
//   return text.take();
//
// Threads: one object, one thread. Invariant: what is written ends with a line end; samples stand in the
// family that was begun last.

#include <string>
#include <string_view>
#include <utility>

#include "runtime/scan/histogram.h"

namespace stepwright::metrics {

// name="value", with what quotes need.
std::string label(std::string_view name, std::string_view value);

class Exposition {
 public:
  // Begins a family; each name once. `type`: counter (the name ends in _total), gauge or summary.
  void family(std::string_view name, std::string_view type, std::string_view help);
  // Of the family under way. `labels`: label()s with commas between; empty: none.
  void sample(std::string_view labels, double value);
  // A family with one sample.
  void figure(std::string_view name, std::string_view type, std::string_view help, std::string_view labels,
              double value);
  // The quantiles 0.5, 0.99 and 0.999 of the family under way, a summary in seconds.
  void quantiles(std::string_view labels, const scan::Histogram& durations);

  std::string take() { return std::move(text_); }

 private:
  std::string text_;
  std::string family_;
};

}  // namespace stepwright::metrics
