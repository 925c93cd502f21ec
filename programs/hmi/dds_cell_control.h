#pragma once

// The cell behind Fast DDS, for whoever acts on it from the page: requests to the supervisor, writes and
// forces in the runtime by the names of the program that runs.
//
// Threads: every function from any; each blocks for dds::kRequestTimeout at most. The source outlives it.
// Fails as api::CellControl says; R0057 and R0058 are of names and values.

#include <utility>
#include <vector>

#include "hmi_web/api/cell_control.h"
#include "hmi_web/api/written_values.h"
#include "programs/hmi/dds_cell_source.h"

namespace stepwright::hmi {

class DdsCellControl : public api::CellControl {
 public:
  // `said`: what the cell says of tags.
  DdsCellControl(DdsCellSource& source, std::vector<protocol::TagNote> said)
      : source_(source), said_(std::move(said)) {}

  result::Result<void> ask_supervisor(const std::string& request) override;
  std::string goal_form() override;
  std::string outlook() override;
  result::Result<void> stop_runtime(const std::string& reason) override;
  result::Result<void> reach() override;
  result::Result<std::string> read(const std::string& name) override;
  std::shared_ptr<const reader::ProgramInfo> program() override;
  std::shared_ptr<const tags::KnownTags> known_tags() override;
  result::Result<std::string> spell(const std::string& name, const std::string& value) override;
  result::Result<std::string> write(const std::string& name, const std::string& value) override;
  result::Result<std::string> force(const std::string& name, const std::string& value,
                                    std::chrono::milliseconds duration) override;
  result::Result<void> unforce(const std::string& name) override;
  result::Result<void> write_together(const std::map<std::string, std::string, std::less<>>& values) override;
  result::Result<std::vector<host::PlantFault>> faults() override;
  result::Result<void> set_fault(const std::string& name, std::optional<double> value) override;
  result::Result<std::vector<api::ForcedPlace>> forced() override;
  result::Result<api::ForcedPlace> as_forced(const std::string& name, const std::string& value) override;

 private:
  std::uint64_t images() const { return source_.client().snapshot_traffic().received; }

  DdsCellSource& source_;
  api::WrittenValues recent_;
  const std::vector<protocol::TagNote> said_;
};

}  // namespace stepwright::hmi
