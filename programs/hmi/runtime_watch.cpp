#include "programs/hmi/runtime_watch.h"

#include <algorithm>
#include <utility>

#include "cell/config/dds_options.h"
#include "cell/hmi/scan_report.h"
#include "runtime/ground/log/refused_samples.h"

namespace stepwright::hmi {

result::Result<std::unique_ptr<RuntimeWatch>> RuntimeWatch::connect(const config::CellConfig& config,
                                                                    const dds::RuntimeClient& own,
                                                                    log::Logger& log) {
  auto self = std::make_unique<RuntimeWatch>();
  self->watched_.push_back({config.dds.runtime_id, &own});
  for (const std::string& id : config.hmi.metrics_of) {
    const bool known = std::any_of(self->watched_.begin(), self->watched_.end(),
                                   [&](const Watched& each) { return each.runtime == id; });
    if (known) continue;
    dds::ParticipantConfig participant = config::participant_of(config.dds, "metrics", id);
    participant.on_trouble = log::refused_samples(log);
    auto client = dds::RuntimeClient::connect(participant, dds::ClientRole::Viewer);
    if (!client) return result::forward(client);
    self->others_.push_back(std::move(*client));
    self->watched_.push_back({id, self->others_.back().get()});
  }
  return self;
}

api::Answer RuntimeWatch::scan() const {
  std::vector<FollowedRuntime> followed;
  for (const Watched& each : watched_) {
    followed.push_back({each.runtime, &each == &watched_.front(), each.client->runtime_alive(),
                        each.client->status(), each.client->health(), each.client->traffic()});
  }
  api::Answer answer;
  answer.text = scan_report(followed);
  return answer;
}

std::string RuntimeWatch::metrics() const {
  std::vector<metrics::RuntimeMetrics> figures;
  for (const Watched& each : watched_) {
    figures.push_back({each.runtime, each.client->runtime_alive(), each.client->status()});
  }
  return metrics::metrics_text(figures);
}

}  // namespace stepwright::hmi
