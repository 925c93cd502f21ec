#include "plant_models/fmu/fmu_file.h"

#include <gtest/gtest.h>

#include "tests/unit/plant_models/fmu/made_archive.h"

namespace stepwright::fmu {
namespace {

const std::string kXml =
    bytes_of(std::string(STEPWRIGHT_SOURCE_DIR) + "/tests/cells/shared_plant/fmu/tank2.xml");
#if defined(__x86_64__)
const std::string kLibrary = "binaries/linux64/tank2.so";
#else
const std::string kLibrary = "binaries/aarch64-linux/tank2.so";
#endif

TEST(FmuFile, WhenItIsWhole_ThenItIsUnpackedIntoAnEmptyFolder) {
  const TemporaryFolder folder;
  make_archive(folder / "tank.fmu", {{"modelDescription.xml", kXml}, {kLibrary, "ELF"}});
  auto file = FmuFile::open(folder / "tank.fmu").value();
  EXPECT_EQ(file.description().name, "Tank");
  std::filesystem::create_directory(folder / "out");
  std::ofstream(folder / "out/left") << "of another one";
  EXPECT_EQ(bytes_of(file.unpack(folder / "out").value()), "ELF");
  EXPECT_FALSE(std::filesystem::exists(folder / "out/left"));
}

TEST(FmuFile, WhenItWasBuiltForAnotherPlatform_ThenItsPlatformsAreNamed) {
  const TemporaryFolder folder;
  make_archive(folder / "tank.fmu", {{"modelDescription.xml", kXml},
                                     {"binaries/win64/tank2.dll", "MZ"},
                                     {"binaries/darwin64/tank2.dylib", "x"}});
  const auto file = FmuFile::open(folder / "tank.fmu");
  ASSERT_FALSE(file);
  EXPECT_EQ(file.error().front().code, "C0333");
  EXPECT_EQ(file.error().front().hint, "it was built for darwin64, win64");
}

TEST(FmuFile, WhenFilesAreMissing_ThenTheyAreNamed) {
  const TemporaryFolder folder;
  make_archive(folder / "a.fmu", {{"readme", ""}});
  EXPECT_NE(FmuFile::open(folder / "a.fmu").error().front().message.find("modelDescription.xml"),
            std::string::npos);
  make_archive(folder / "b.fmu", {{"modelDescription.xml", kXml}});
  EXPECT_EQ(FmuFile::open(folder / "b.fmu").error().front().hint,
            "it has no binaries at all: export it with them");
}

}  // namespace
}  // namespace stepwright::fmu
