#include "programs/hmi/source_cache.h"

#include "hmi_web/protocol/program_document.h"

namespace stepwright::hmi {

api::Answer sources_of(const std::string& digest, const reader::ProgramInfo& info,
                       std::string_view document) {
  protocol::ProgramSources sources{digest, {}, document};
  for (const reader::InstanceInfo& each : info.instances())
    sources.instances.push_back({each.path, each.pou});
  api::Answer answer;
  answer.etag = '"' + digest + '"';
  answer.text = protocol::program_sources(sources);
  return answer;
}

api::Answer SourceCache::sources() const {
  const auto program = running_.get();
  if (program == nullptr) {
    return api::refused(404, "H0066", "no program is known to this server",
                        "download one; the page shows it as soon as the runtime has it");
  }
  const std::lock_guard lock(mutex_);
  if (kept_.etag != '"' + program->digest + '"')
    kept_ = sources_of(program->digest, program->info, program->document);
  return kept_;
}

}  // namespace stepwright::hmi
