#pragma once

// A Functional Mock-up Unit as a file: its description, and whether it has a library for this machine.
//
//   auto file = FmuFile::open("tank.fmu");
//   auto library = file->unpack("/run/cell/plant");
//
// Threads: one. Fails with C0330 (the archive), C0332 (the description), C0333 (no library for this machine).

#include <filesystem>
#include <string>

#include "plant_models/fmu/model_description.h"
#include "plant_models/fmu/zip_archive.h"

namespace stepwright::fmu {

class FmuFile {
 public:
  [[nodiscard]] static result::Result<FmuFile> open(const std::filesystem::path& file);

  const ModelDescription& description() const { return description_; }
  // Everything of it goes into the folder, which is emptied before; the path of the library there.
  [[nodiscard]] result::Result<std::filesystem::path> unpack(const std::filesystem::path& folder);

 private:
  FmuFile(std::filesystem::path file, ZipArchive archive, ModelDescription description)
      : file_(std::move(file)), archive_(std::move(archive)), description_(std::move(description)) {}
  [[nodiscard]] result::Result<void> check_platform() const;
  std::string library() const;

  std::filesystem::path file_;
  ZipArchive archive_;
  ModelDescription description_;
};

}  // namespace stepwright::fmu
