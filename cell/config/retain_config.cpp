#include "cell/config/retain_config.h"

#include <string>
#include <vector>

#include "ladder/source/dialect.h"
#include "runtime/ground/settings/toml_document.h"

namespace stepwright::config {

void read_retain(const settings::TomlTable& root, const std::filesystem::path& folder,
                 const std::filesystem::path& state_dir, RetainSection& retain, BootSection& boot) {
  const settings::TomlTable table = root.table("retain");
  const std::string file = table.text("file", "retain.store");
  if (!file.empty()) retain.file = state_dir / file;
  retain.where = table.where("file");
  retain.period =
      std::chrono::milliseconds(table.integer("period_ms", retain.period.count(), {1, 3'600'000}));
  const std::string policy = table.choice("policy", "carry", {"carry", "initialise", "refuse"});
  retain.policy = policy == "initialise" ? RetainPolicy::Initialise
                  : policy == "refuse"   ? RetainPolicy::Refuse
                                         : RetainPolicy::Carry;
  const settings::TomlTable runtime = root.table("runtime");
  const std::string program = runtime.text("program", {});
  if (!program.empty()) {
    boot.program = folder / program;
    boot.program_where = runtime.where("program");
  }
  for (const std::string& source : runtime.texts("sources")) {
    std::error_code ignored;  // a file that is not there is none
    if (!std::filesystem::is_regular_file(folder / source, ignored))
      runtime.report("sources", "there is no file " + (folder / source).string(),
                     "a source in ST or PLCopen XML");
    boot.sources.push_back(folder / source);
  }
  std::vector<std::string> dialects;
  for (const source::Dialect& each : source::dialects()) dialects.emplace_back(each.name);
  boot.dialect = runtime.choice("dialect", dialects.front(), dialects);
  if (boot.program.empty() && !boot.sources.empty()) boot.program = state_dir / "program.swb";
  boot.autostart = runtime.boolean("autostart", boot.autostart);
  if (runtime.boolean("boot", false)) boot.keep = state_dir / "boot.swb";
  if (boot.autostart && boot.program.empty() && boot.keep.empty()) {
    runtime.report("autostart", "there is nothing to start", "name a program, or set boot = true");
  }
}

}  // namespace stepwright::config
