#include "plant_models/fmu/array_variable.h"

#include <cmath>
#include <cstdlib>
#include <string>

namespace stepwright::fmu {
namespace {

constexpr std::string_view kSpace = " \t\r\n";

double number_of(const std::string& word) {
  if (word == "true") return 1.0;
  const double number = std::strtod(word.c_str(), nullptr);
  return std::isfinite(number) ? number : 0.0;
}

// "[1,3]" of the element at that place of the list.
std::string index_of(std::size_t place, const std::vector<std::uint64_t>& dimensions) {
  std::string text;
  for (std::size_t i = dimensions.size(); i-- > 0; place /= dimensions[i])
    text = std::to_string(place % dimensions[i] + 1) + (text.empty() ? "" : ",") + text;
  return "[" + text + "]";
}

}  // namespace

std::optional<std::size_t> count_elements(const std::vector<std::uint64_t>& dimensions, std::size_t most) {
  std::size_t count = 1;
  for (const std::uint64_t each : dimensions) {
    if (each == 0) return 0;
    if (each > most / count) return std::nullopt;
    count *= each;
  }
  return count;
}

std::vector<double> numbers_of(std::string_view text) {
  std::vector<double> numbers;
  for (std::size_t from = text.find_first_not_of(kSpace); from != std::string_view::npos;) {
    const std::size_t end = std::min(text.find_first_of(kSpace, from), text.size());
    numbers.push_back(number_of(std::string(text.substr(from, end - from))));
    from = text.find_first_not_of(kSpace, end);
  }
  return numbers;
}

void append_elements(const ModelVariable& array, const std::vector<std::uint64_t>& dimensions,
                     const std::vector<double>& starts, std::vector<ModelVariable>& variables) {
  const std::size_t count = count_elements(dimensions, SIZE_MAX).value_or(0);
  for (std::size_t i = 0; i < count; ++i) {
    ModelVariable& element = variables.emplace_back(array);
    element.name += index_of(i, dimensions);
    element.element = static_cast<std::uint32_t>(i);
    element.elements = static_cast<std::uint32_t>(count);
    if (!starts.empty()) element.start = starts.size() == 1 ? starts.front() : starts[i];
  }
}

}  // namespace stepwright::fmu
