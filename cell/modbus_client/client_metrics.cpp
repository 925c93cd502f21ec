#include "cell/modbus_client/client_metrics.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "runtime/metrics/exposition.h"
#include "runtime/modbus/client/tag.h"

namespace stepwright::modbus_client {
namespace {

using metrics::Exposition;
using metrics::label;
using modbus::client::Quality;
using nlohmann::json;

struct Figure {
  const char* key;
  const char* name;
  const char* type;
  const char* help;
};
constexpr std::array kOfDevice = {
    Figure{"online", "stepwright_modbus_device_online", "gauge", "1 if the newest request was answered."},
    Figure{"lost", "stepwright_modbus_device_lost", "gauge",
           "1 if it is lost for longer than loss_after_ms."},
    Figure{"requests", "stepwright_modbus_requests_total", "counter", "Requests to the device."},
    Figure{"writes", "stepwright_modbus_writes_total", "counter", "Requests that write."},
    Figure{"timeouts", "stepwright_modbus_timeouts_total", "counter", "Requests without an answer in time."},
    Figure{"exceptions", "stepwright_modbus_exceptions_total", "counter",
           "Requests that the device refused."},
    Figure{"bad_answers", "stepwright_modbus_bad_answers_total", "counter",
           "Answers that were none to the request."},
    Figure{"connection_losses", "stepwright_modbus_connection_losses_total", "counter",
           "Connections that were lost, and made anew."},
};
constexpr std::array kOfGroup = {
    Figure{"turns", "stepwright_modbus_polls_total", "counter", "Periods in which the group was polled."},
    Figure{"overruns", "stepwright_modbus_poll_overruns_total", "counter",
           "Periods that were left out because the connection was busy."},
};
constexpr std::array kQualities = {Quality::Good,         Quality::LastUsable,    Quality::RangeExceeded,
                                   Quality::NotConnected, Quality::DeviceFailure, Quality::CommFailure};
constexpr double kMsPerS = 1e3;

double number(const json& value) {
  if (value.is_boolean()) return value.get<bool>() ? 1.0 : 0.0;
  return value.get<double>();
}

// The figures of all devices, family by family.
class Writer {
 public:
  explicit Writer(const json& status)
      : cell_(label("cell", status.at("cell").get<std::string>())), devices_(status.at("devices")) {}

  std::string write() {
    for (const Figure& figure : kOfDevice) {
      text_.family(figure.name, figure.type, figure.help);
      for (const json& device : devices_) text_.sample(of(device), number(device.at(figure.key)));
    }
    text_.family("stepwright_modbus_answer_seconds", "summary", "From a request to its answer.");
    for (const json& device : devices_) quantiles(of(device), device, "answer");
    text_.family("stepwright_modbus_answer_max_seconds", "gauge", "The longest of them.");
    for (const json& device : devices_)
      text_.sample(of(device), number(device.at("answer_max_ms")) / kMsPerS);
    groups();
    qualities();
    return text_.take();
  }

 private:
  std::string of(const json& device) const {
    return cell_ + "," + label("device", device.at("name").get<std::string>());
  }

  void quantiles(const std::string& labels, const json& from, const std::string& key) {
    text_.sample(labels + "," + label("quantile", "0.5"), number(from.at(key + "_p50_ms")) / kMsPerS);
    text_.sample(labels + "," + label("quantile", "0.99"), number(from.at(key + "_p99_ms")) / kMsPerS);
  }

  template <typename Add>
  void each_group(const Add& add) {
    for (const json& device : devices_)
      for (const json& group : device.at("groups"))
        add(of(device) + "," + label("group", group.at("name").get<std::string>()), group);
  }

  void groups() {
    for (const Figure& figure : kOfGroup) {
      text_.family(figure.name, figure.type, figure.help);
      each_group(
          [&](const auto& labels, const json& group) { text_.sample(labels, number(group.at(figure.key))); });
    }
    const auto in_seconds = [&](const char* key, const char* name, const char* help) {
      text_.family(name, "gauge", help);
      each_group([&](const auto& labels, const json& group) {
        text_.sample(labels, number(group.at(key)) / kMsPerS);
      });
    };
    in_seconds("period_ms", "stepwright_modbus_poll_period_seconds", "The period that is configured.");
    text_.family("stepwright_modbus_poll_cycle_seconds", "summary",
                 "From one poll of the group to the next.");
    each_group([&](const auto& labels, const json& group) { quantiles(labels, group, "period"); });
    in_seconds("period_max_ms", "stepwright_modbus_poll_cycle_max_seconds", "The longest of them.");
  }

  // How many values are how good, and how good each is.
  void qualities() {
    text_.family("stepwright_modbus_tags", "gauge", "Values of the device by their OPC quality.");
    for (const json& device : devices_) {
      for (const Quality quality : kQualities) {
        const json& tags = device.at("tags");
        const auto count = std::count_if(tags.begin(), tags.end(), [&](const json& tag) {
          return tag.at("quality").get<int>() == static_cast<int>(quality);
        });
        text_.sample(of(device) + "," + label("quality", name_of(quality)), static_cast<double>(count));
      }
    }
    text_.family("stepwright_modbus_tag_quality", "gauge",
                 "OPC quality of a tag: 192 good, from 64 uncertain, else bad.");
    for (const json& device : devices_) {
      for (const json& tag : device.at("tags"))
        text_.sample(of(device) + "," + label("tag", tag.at("name").get<std::string>()) + "," +
                         label("address", tag.at("address").get<std::string>()),
                     number(tag.at("quality")));
    }
  }

  std::string cell_;
  const json& devices_;
  Exposition text_;
};

}  // namespace

std::string to_metrics(const json& status) {
  return Writer(status).write();
}

}  // namespace stepwright::modbus_client
