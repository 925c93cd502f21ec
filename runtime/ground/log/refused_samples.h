#pragma once

// Samples that Fast DDS brought and that were refused, as lines of a log. Any thread; the log outlives what
// it is given to.

#include <functional>

#include "runtime/ground/log/logger.h"
#include "runtime/ground/result/diagnostic.h"

namespace stepwright::log {

// As dds::ParticipantConfig::on_trouble takes it.
inline std::function<void(const result::Diagnostic&)> refused_samples(Logger& log) {
  return [&log](const result::Diagnostic& refused) {
    log.warning("refused_sample", result::to_string(refused),
                {{"code", refused.code}, {"topic", refused.where.file}});
  };
}

}  // namespace stepwright::log
