#include "plant_models/fmu/fmu_file.h"

#include <set>
#include <utility>

namespace stepwright::fmu {
namespace {

constexpr const char* kDescription = "modelDescription.xml";
constexpr std::uint64_t kMostDescriptionBytes = 64u << 20;

// Names of platforms: FMI 2.0, 2.2.8.1; FMI 3.0, 2.5.1.4.1.
const char* platform_of(FmiVersion version) {
#if defined(__x86_64__)
  return version == FmiVersion::V2 ? "linux64" : "x86_64-linux";
#elif defined(__aarch64__)
  return version == FmiVersion::V2 ? "aarch64-linux" : "aarch64-linux";
#else
  return version == FmiVersion::V2 ? "linux32" : "x86-linux";
#endif
}

}  // namespace

result::Result<FmuFile> FmuFile::open(const std::filesystem::path& file) {
  auto archive = ZipArchive::open(file);
  if (!archive) return result::forward(archive);
  if (!archive->has(kDescription)) {
    return result::fail("C0330", {file.string(), 0, 0}, std::string("it has no '") + kDescription + "'",
                        "it stands at the top of the archive of an FMU");
  }
  auto xml = archive->read(kDescription, kMostDescriptionBytes);
  if (!xml) return result::forward(xml);
  auto description = parse_description(*xml, (file / kDescription).string());
  if (!description) return result::forward(description);
  FmuFile found(file, std::move(*archive), std::move(*description));
  if (auto built = found.check_platform(); !built) return result::forward(built);
  return found;
}

std::string FmuFile::library() const {
  return std::string("binaries/") + platform_of(description_.version) + "/" + description_.identifier + ".so";
}

result::Result<void> FmuFile::check_platform() const {
  if (archive_.has(library())) return {};
  std::set<std::string> platforms;
  constexpr std::string_view kFolder = "binaries/";
  for (const std::string& name : archive_.names()) {
    if (!name.starts_with(kFolder)) continue;
    const std::size_t end = name.find('/', kFolder.size());
    if (end != std::string::npos && end + 1 < name.size())
      platforms.insert(name.substr(kFolder.size(), end - kFolder.size()));
  }
  std::string list;
  for (const std::string& each : platforms) list += (list.empty() ? "" : ", ") + each;
  return result::fail(
      "C0333", {file_.string(), 0, 0}, "this FMU has no library for this machine: no '" + library() + "'",
      list.empty() ? "it has no binaries at all: export it with them" : "it was built for " + list);
}

result::Result<std::filesystem::path> FmuFile::unpack(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::remove_all(folder, error);
  std::filesystem::create_directories(folder, error);
  if (error) {
    return result::fail("C0330", {folder.string(), 0, 0}, "the folder cannot be made: " + error.message());
  }
  if (auto done = archive_.unpack(folder); !done) return result::forward(done);
  return folder / library();
}

}  // namespace stepwright::fmu
