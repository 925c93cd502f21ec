#include "plant_models/components/step_answer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <iterator>

#include "plant_models/components/component_reader.h"
#include "plant_models/core/names.h"
#include "runtime/ground/markup/xml_text.h"

namespace stepwright::components {
namespace {

using Reader = std::function<double()>;

std::vector<std::string> all_names(const core::Plant& plant) {
  std::vector<std::string> names = core::names_of(plant.truths());
  std::ranges::copy(core::names_of(plant.sensors()), std::back_inserter(names));
  return names;
}

std::string text(const char* format, double value) {
  std::array<char, 40> out{};
  std::snprintf(out.data(), out.size(), format, value);
  return out.data();
}

result::Result<std::vector<Reader>> readers(core::Plant& plant, const std::vector<std::string>& names,
                                            StepAnswer& answer) {
  std::vector<Reader> found;
  result::Diagnostics problems;
  for (const std::string& name : names) {
    if (const auto truth = core::find_truth(plant, name)) {
      found.push_back([&plant, id = *truth] { return plant.truth(id); });
      answer.columns.push_back({name, plant.truths()[truth->value].unit, {}});
    } else if (const auto sensor = core::find_sensor(plant, name)) {
      found.push_back([&plant, id = *sensor] { return static_cast<double>(plant.sensor(id)); });
      answer.columns.push_back(
          {name, plant.sensors()[sensor->value].kind == core::PortKind::Bool ? "" : "counts", {}});
    } else {
      problems.push_back({"C0301",
                          result::Severity::Error,
                          {},
                          "the plant has no value '" + name + "'",
                          meant_or(name, all_names(plant))});
    }
  }
  if (!problems.empty()) return tl::unexpected(std::move(problems));
  return found;
}

result::Result<void> act(core::Plant& plant, const AnswerAction& action) {
  if (action.fault) return plant.inject_fault(action.name, action.value);
  plant.set_actuator(core::find_actuator(plant, action.name).value(),
                     static_cast<std::int16_t>(action.value));
  return {};
}

// Whether the terminal is there and can have the value. Faults say that themselves.
result::Result<void> check_terminal(const core::Plant& plant, const AnswerAction& action) {
  const auto actuator = core::find_actuator(plant, action.name);
  if (!actuator)
    return result::fail("C0301", {}, "the plant has no terminal '" + action.name + "' that is driven",
                        meant_or(action.name, core::names_of(plant.actuators())));
  const bool is_bit = plant.actuators()[actuator->value].kind == core::PortKind::Bool;
  const double low = is_bit ? 0.0 : -32768.0;
  const double high = is_bit ? 1.0 : 32767.0;
  const bool fits = action.value == std::round(action.value) && action.value >= low && action.value <= high;
  if (fits) return {};
  return result::fail("C0350", {}, "terminal '" + action.name + "' cannot be " + text("%.9g", action.value),
                      is_bit ? "a switch is 0 or 1" : "a word has whole numbers from -32768 to 32767");
}

result::Result<void> check_actions(const core::Plant& plant, const AnswerRequest& request) {
  result::Diagnostics problems;
  for (const AnswerAction& action : request.actions) {
    if (auto fits = action.fault ? result::Result<void>() : check_terminal(plant, action); !fits)
      problems.insert(problems.end(), fits.error().begin(), fits.error().end());
    else if (action.at_s > request.seconds)
      problems.push_back({"C0350",
                          result::Severity::Error,
                          {},
                          "'" + action.name + "' is set at " + text("%.9g", action.at_s) +
                              " s, and the run ends at " + text("%.9g", request.seconds) + " s",
                          "--seconds says how long it runs"});
  }
  if (!problems.empty()) return tl::unexpected(std::move(problems));
  return {};
}

// Whole nanoseconds, as the plant counts; after all that it can count where it is later.
std::chrono::nanoseconds time_of(const AnswerAction& action) {
  constexpr double kLatest_s = 9e9;
  return std::chrono::nanoseconds(
      static_cast<std::int64_t>(std::llround(std::min(action.at_s, kLatest_s) * 1e9)));
}

// What does not change says nothing.
void drop_constants(StepAnswer& answer) {
  std::erase_if(answer.columns, [](const AnswerColumn& column) {
    return std::all_of(column.values.begin(), column.values.end(),
                       [&](double value) { return value == column.values.front(); });
  });
}

}  // namespace

result::Result<StepAnswer> record_answer(core::Plant& plant, const AnswerRequest& request) {
  StepAnswer answer;
  auto read = readers(plant, request.values.empty() ? all_names(plant) : request.values, answer);
  if (!read) return result::forward(read);
  if (auto fits = check_actions(plant, request); !fits) return result::forward(fits);
  std::vector<AnswerAction> actions = request.actions;
  std::stable_sort(actions.begin(), actions.end(),
                   [](const AnswerAction& a, const AnswerAction& b) { return a.at_s < b.at_s; });
  std::size_t next = 0;
  const auto note = [&] {
    answer.times_s.push_back(static_cast<double>(plant.now().count()) * 1e-9);
    // + 0.0: without -0.
    for (std::size_t i = 0; i < read->size(); ++i) answer.columns[i].values.push_back((*read)[i]() + 0.0);
  };
  // False: the plant has failed.
  const auto run_to = [&](std::chrono::nanoseconds time) {
    return time <= plant.now() || plant.advance(time - plant.now()) == core::PlantStatus::Good;
  };
  // What is to be done before `time`, each at its own.
  const auto act_before = [&](std::chrono::nanoseconds time) -> result::Result<void> {
    for (; next < actions.size() && time_of(actions[next]) < time && !answer.failed; ++next) {
      answer.failed = !run_to(time_of(actions[next]));
      if (auto done = act(plant, actions[next]); !done) return result::forward(done);
    }
    return {};
  };
  note();
  const std::chrono::nanoseconds end(static_cast<std::int64_t>(std::llround(request.seconds * 1e9)));
  while (plant.now() < end && !answer.failed) {
    const std::chrono::nanoseconds row = std::min(plant.now() + request.interval, end);
    if (auto done = act_before(row); !done) return result::forward(done);
    answer.failed = answer.failed || !run_to(row);
    if (!answer.failed) note();
  }
  // What comes at the end is no longer seen, but is checked.
  for (; next < actions.size(); ++next)
    if (auto done = act(plant, actions[next]); !done) return result::forward(done);
  if (request.values.empty()) drop_constants(answer);
  return answer;
}

std::string to_csv(const StepAnswer& answer) {
  std::string csv = "time_s";
  for (const AnswerColumn& column : answer.columns)
    csv += "," + column.name + (column.unit.empty() ? "" : " [" + column.unit + "]");
  csv += "\n";
  for (std::size_t row = 0; row < answer.times_s.size(); ++row) {
    csv += text("%.9g", answer.times_s[row]);
    for (const AnswerColumn& column : answer.columns) csv += text(",%.9g", column.values[row]);
    csv += "\n";
  }
  return csv;
}

std::string to_svg(const StepAnswer& answer, const std::string& title) {
  constexpr double kWidth = 900.0, kPanel = 220.0, kLeft = 80.0, kRight = 180.0, kTop = 40.0, kGap = 40.0;
  constexpr std::array<const char*, 8> kColours = {"#0b62a4", "#c0392b", "#1e8449", "#7d3c98",
                                                   "#b9770e", "#117a65", "#5d6d7e", "#943126"};
  constexpr std::size_t kMostPoints = 2000;
  std::vector<std::string> units;
  for (const AnswerColumn& column : answer.columns)
    if (std::find(units.begin(), units.end(), column.unit) == units.end()) units.push_back(column.unit);
  const double height = kTop + static_cast<double>(units.size()) * (kPanel + kGap);
  std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + text("%.0f ", kWidth) +
                    text("%.0f", height) +
                    "\" font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"100%\" height=\"100%\" "
                    "fill=\"white\"/>\n<text x=\"20\" y=\"24\" font-size=\"16\">" +
                    markup::xml_escaped(title) + "</text>\n";
  const double last_s = std::max(answer.times_s.back(), 1e-9);
  const std::size_t stride = answer.times_s.size() / kMostPoints + 1;
  for (std::size_t u = 0; u < units.size(); ++u) {
    double low = 1e300, high = -1e300;
    for (const AnswerColumn& column : answer.columns) {
      if (column.unit != units[u]) continue;
      const auto [least, most] = std::minmax_element(column.values.begin(), column.values.end());
      low = std::min(low, *least);
      high = std::max(high, *most);
    }
    if (high - low < 1e-12 * std::max(1.0, std::abs(high))) high = low + 1.0;
    const double top = kTop + static_cast<double>(u) * (kPanel + kGap);
    const double wide = kWidth - kLeft - kRight;
    svg += "<rect x=\"" + text("%.1f", kLeft) + "\" y=\"" + text("%.1f", top) + "\" width=\"" +
           text("%.1f", wide) + "\" height=\"" + text("%.1f", kPanel) +
           "\" fill=\"none\" stroke=\"#999\"/>\n";
    for (int i = 0; i <= 4; ++i) {
      const double y = top + kPanel * (1.0 - 0.25 * i);
      svg += "<text x=\"" + text("%.1f", kLeft - 6.0) + "\" y=\"" + text("%.1f", y + 4.0) +
             "\" text-anchor=\"end\">" + text("%.4g", low + (high - low) * 0.25 * i) + "</text>\n";
      svg += "<text x=\"" + text("%.1f", kLeft + wide * 0.25 * i) + "\" y=\"" +
             text("%.1f", top + kPanel + 16.0) + "\" text-anchor=\"middle\">" +
             text("%.4g s", last_s * 0.25 * i) + "</text>\n";
    }
    svg += "<text x=\"" + text("%.1f", kLeft) + "\" y=\"" + text("%.1f", top - 6.0) + "\">" +
           markup::xml_escaped(units[u]) + "</text>\n";
    std::size_t curve = 0;
    for (const AnswerColumn& column : answer.columns) {
      if (column.unit != units[u]) continue;
      const std::string colour = kColours[curve % kColours.size()];
      svg += "<polyline fill=\"none\" stroke=\"" + colour + "\" stroke-width=\"1.5\" points=\"";
      for (std::size_t i = 0; i < column.values.size(); i += stride)
        svg += text("%.1f,", kLeft + wide * answer.times_s[i] / last_s) +
               text("%.1f ", top + kPanel * (1.0 - (column.values[i] - low) / (high - low)));
      svg += "\"/>\n<text x=\"" + text("%.1f", kWidth - kRight + 10.0) + "\" y=\"" +
             text("%.1f", top + 14.0 + 16.0 * static_cast<double>(curve)) + "\" fill=\"" + colour + "\">" +
             markup::xml_escaped(column.name) + "</text>\n";
      ++curve;
    }
  }
  return svg + "</svg>\n";
}

}  // namespace stepwright::components
