#include "programs/new/new_command.h"

#include <stdlib.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <optional>
#include <span>
#include <utility>

#include "cell/config/cell_config.h"
#include "cell/import/plcopen_project.h"
#include "cell/import/project_cell.h"
#include "programs/new/template_texts.h"
#include "runtime/ground/files/files.h"

namespace stepwright::new_cell {
namespace {

constexpr std::string_view kCell = "cell.toml";
constexpr std::string_view kReadme = "README.md";
constexpr std::size_t kLongestName = 48;  // leaves room for "-device"

std::span<const TemplateText> texts_of(const NewOptions& options) {
  const std::string& plant = options.plant;
  if (options.plan) return plan_texts();
  if (plant == "tanks") return tanks_texts();
  if (plant == "conveyor") return conveyor_texts();
  return plant == "modbus" ? modbus_texts() : none_texts();
}

// Every {{placeholder}} of the text; what is filled in is not looked through again.
std::string filled_in(std::string_view text, const cell_import::Fillings& fillings) {
  std::string made;
  std::size_t done = 0;
  for (std::size_t at = text.find("{{"); at != std::string_view::npos; at = text.find("{{", done)) {
    const std::size_t end = text.find("}}", at);
    if (end == std::string_view::npos) break;
    made.append(text, done, at - done);
    const std::string_view name = text.substr(at + 2, end - at - 2);
    const auto found = std::ranges::find(fillings, name, &cell_import::Fillings::value_type::first);
    if (found != fillings.end()) made += found->second;
    done = end + 2;
  }
  return made.append(text, done, std::string_view::npos);
}

bool is_name(const std::string& name) {
  const auto fits = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '-' || c == '.'; };
  return !name.empty() && name.size() <= kLongestName && name.front() != '.' && name.front() != '-' &&
         std::ranges::all_of(name, fits);
}

// Without the '/' at its end.
std::filesystem::path folder_of(const NewOptions& options) {
  const std::filesystem::path folder = std::filesystem::path(options.folder).lexically_normal();
  return folder.has_filename() ? folder : folder.parent_path();
}

result::Result<void> check_free(const std::filesystem::path& folder) {
  std::error_code error;
  if (!std::filesystem::exists(std::filesystem::symlink_status(folder, error))) return {};
  const bool empty = std::filesystem::is_directory(folder, error) && std::filesystem::is_empty(folder, error);
  if (empty && !error) return {};
  return result::fail("M0019", {folder.string(), 0, 0}, "this is there already, and is no empty folder",
                      "nothing was written; choose another name");
}

result::Result<void> write(const std::filesystem::path& file, const std::string& text) {
  auto unwritten = files::write_file(file.string(), text);
  if (!unwritten.empty()) return tl::unexpected(std::move(unwritten));
  return {};
}

// What is wrong with the cell's file, as it stands there with all that it names.
result::Diagnostics problems_of(const std::filesystem::path& folder) {
  result::Diagnostics problems = config::read_cell_config(folder / kCell).problems;
  std::erase_if(problems, [](const auto& each) { return each.severity != result::Severity::Error; });
  for (result::Diagnostic& each : problems) each.where.file = kCell;
  return problems;
}

result::Result<void> write_project(const std::filesystem::path& folder, const std::string& name,
                                   cell_import::TakenProject& project) {
  cell_import::Fillings fillings = cell_import::fillings_of(project);
  fillings.emplace_back("name", name);
  if (auto done = write(folder / "main.xml", project.xml); !done) return done;
  for (const TemplateText& each : plcopen_texts()) {
    if (each.name == kReadme) continue;
    if (auto done = write(folder / each.name, filled_in(each.text, fillings)); !done) return done;
  }
  const result::Diagnostics problems = problems_of(folder);
  project.problems.insert(project.problems.end(), problems.begin(), problems.end());
  fillings.emplace_back("left", cell_import::left_of(project));
  for (const TemplateText& each : plcopen_texts()) {
    if (each.name != kReadme) continue;
    if (auto done = write(folder / each.name, filled_in(each.text, fillings)); !done) return done;
  }
  return {};
}

result::Result<void> write_all(const std::filesystem::path& folder, const NewOptions& options,
                               const std::string& name, std::optional<cell_import::TakenProject>& project) {
  if (project) return write_project(folder, name, *project);
  for (const TemplateText& each : texts_of(options))
    if (auto done = write(folder / each.name, filled_in(each.text, {{"name", name}})); !done) return done;
  return {};
}

result::Result<std::optional<cell_import::TakenProject>> project_of(const NewOptions& options) {
  if (options.from.empty()) return std::optional<cell_import::TakenProject>();
  auto taken = cell_import::read_project(options.from, {options.dialect, options.configuration});
  if (!taken) return result::forward(taken);
  return std::optional<cell_import::TakenProject>(std::move(*taken));
}

}  // namespace

result::Result<NewCell> make_cell(const NewOptions& options) {
  const std::filesystem::path folder = folder_of(options);
  const std::string name = folder.filename().string();
  if (!is_name(name))
    return result::fail("M0018", {}, "'" + name + "' cannot name a cell",
                        "up to 48 letters, digits, '_', '-' and '.', the first a letter or digit");
  if (auto free = check_free(folder); !free) return result::forward(free);
  auto project = project_of(options);
  if (!project) return result::forward(project);
  // Written beside its place and moved there as a whole.
  std::string made = (folder.parent_path() / ("." + name + "-XXXXXX")).string();
  if (mkdtemp(made.data()) == nullptr)
    return result::fail("E0002", {folder.string(), 0, 0},
                        std::string("cannot be made: ") + std::strerror(errno));
  std::error_code error;
  auto done = write_all(made, options, name, *project);
  if (done) {
    constexpr auto kUsual = std::filesystem::perms(0755);
    std::filesystem::permissions(made, kUsual, error);
    std::filesystem::rename(made, folder, error);
  }
  if (done && !error) return *project ? NewCell{(*project)->left, (*project)->problems} : NewCell{};
  std::error_code ignored;
  std::filesystem::remove_all(made, ignored);
  if (!done) return result::forward(done);
  return result::fail("E0002", {folder.string(), 0, 0}, "cannot be made: " + error.message());
}

}  // namespace stepwright::new_cell
