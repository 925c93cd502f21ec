#include "runtime/metrics/exposition.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>

namespace stepwright::metrics {
namespace {

constexpr double kNsPerSecond = 1e9;

std::string number(double value) {
  if (std::isnan(value)) return "NaN";
  if (std::isinf(value)) return value > 0 ? "+Inf" : "-Inf";
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value);
  return {text.data(), end.ptr};
}

// Inside the quotes of a label.
std::string escaped(std::string_view text) {
  std::string safe;
  for (const char c : text) {
    if (c == '\\' || c == '"') safe += '\\';
    if (c == '\n') {
      safe += "\\n";
    } else {
      safe += c;
    }
  }
  return safe;
}

}  // namespace

std::string label(std::string_view name, std::string_view value) {
  return std::string(name) + "=\"" + escaped(value) + "\"";
}

void Exposition::family(std::string_view name, std::string_view type, std::string_view help) {
  family_ = name;
  text_ +=
      "# HELP " + family_ + " " + std::string(help) + "\n# TYPE " + family_ + " " + std::string(type) + "\n";
}

void Exposition::sample(std::string_view labels, double value) {
  text_ += family_;
  if (!labels.empty()) text_ += "{" + std::string(labels) + "}";
  text_ += " " + number(value) + "\n";
}

void Exposition::figure(std::string_view name, std::string_view type, std::string_view help,
                        std::string_view labels, double value) {
  family(name, type, help);
  sample(labels, value);
}

void Exposition::quantiles(std::string_view labels, const scan::Histogram& durations) {
  struct Quantile {
    const char* name;
    std::uint32_t per_100000;
  };
  constexpr std::array kQuantiles = {Quantile{"0.5", 50'000}, Quantile{"0.99", 99'000},
                                     Quantile{"0.999", 99'900}};
  const std::string before = labels.empty() ? std::string() : std::string(labels) + ",";
  for (const Quantile& each : kQuantiles) {
    sample(before + label("quantile", each.name),
           static_cast<double>(durations.percentile_ns(each.per_100000)) / kNsPerSecond);
  }
}

}  // namespace stepwright::metrics
