#include "programs/hmi/program_desk.h"

#include "hmi_web/protocol/program_document.h"

namespace stepwright::hmi {

api::Answer ProgramDesk::sources() const {
  const auto program = running_.get();
  if (program == nullptr) {
    return api::refused(404, "H0066", "no program is known to this server",
                        "download one; the page shows it as soon as the runtime has it");
  }
  const std::string etag = '"' + program->digest + '"';
  const std::lock_guard lock(mutex_);
  if (kept_.etag == etag) return kept_;
  protocol::ProgramSources sources{program->digest, {}, program->document};
  for (const reader::InstanceInfo& each : program->info.instances())
    sources.instances.push_back({each.path, each.pou});
  kept_ = {};
  kept_.etag = etag;
  kept_.text = protocol::program_sources(sources);
  return kept_;
}

}  // namespace stepwright::hmi
