#include "supervisor/map/map_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <png.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include "supervisor/map/internal/gray_image.h"
#include "supervisor/map/internal/map_description.h"
#include "tests/support/temporary_folder.h"

namespace stepwright::fleet {
namespace {

using ::testing::HasSubstr;

constexpr const char* kYaml =
    "image: floor.pgm\n"
    "resolution: 0.2\n"
    "origin: [-1.0, 2.0, 0.0]\n"
    "negate: 0\n"
    "occupied_thresh: 0.65\n"
    "free_thresh: 0.196\n";

class MapFile : public ::testing::Test {
 protected:
  std::filesystem::path write(const std::string& name, const std::string& text) {
    std::ofstream(folder_.path() / name, std::ios::binary) << text;
    return folder_.path() / name;
  }
  result::Result<OccupancyGrid> read(const std::string& yaml, const std::string& image) {
    write("floor.pgm", image);
    return read_map(write("map.yaml", yaml));
  }
  // The first diagnostic without the folder.
  std::string refusal(const std::string& yaml, const std::string& image = "P2 1 1 255 254\n") {
    const auto map = read(yaml, image);
    if (map) return "read";
    const std::string text = result::to_string(map.error().front());
    return text.substr(text.rfind('/', text.find(": ")) + 1);
  }
  static std::string with(const std::string& from, const std::string& to) {
    std::string text = kYaml;
    return text.replace(text.find(from), from.size(), to);
  }

  support::TemporaryFolder folder_;
};

TEST_F(MapFile, Read_WhenTheImageIsPlain_ThenTheTopRowIsTheHighestAndUnknownIsBlocked) {
  const auto map = read(kYaml, "P2\n# drawn by hand\n3 2 # columns, rows\n255\n254 0 205\n254 254 0\n");
  ASSERT_TRUE(map.has_value()) << result::to_string(map.error());
  EXPECT_EQ(map->frame(), (GridFrame{.resolution_m = 0.2, .origin = {-1.0, 2.0}, .columns = 3, .rows = 2}));
  EXPECT_FALSE(map->blocked({0, 1}));
  EXPECT_TRUE(map->blocked({1, 1}));
  EXPECT_TRUE(map->blocked({2, 1}));  // neither free nor occupied
  EXPECT_FALSE(map->blocked({1, 0}));
  EXPECT_TRUE(map->blocked({2, 0}));
}

TEST_F(MapFile, Read_WhenTheImageIsRaw_ThenOneOrTwoBytesMakeASample) {
  const auto narrow = read(kYaml, std::string("P5 2 1 255\n\xfe\x00", 13));
  ASSERT_TRUE(narrow.has_value()) << result::to_string(narrow.error());
  EXPECT_FALSE(narrow->blocked({0, 0}));
  EXPECT_TRUE(narrow->blocked({1, 0}));
  const auto wide = read(kYaml, std::string("P5 2 1 65535\n\x00\x00\xff\xff", 17));
  ASSERT_TRUE(wide.has_value()) << result::to_string(wide.error());
  EXPECT_TRUE(wide->blocked({0, 0}));
  EXPECT_FALSE(wide->blocked({1, 0}));
}

TEST_F(MapFile, Read_WhenNegated_ThenWhiteIsBlocked) {
  const auto map = read(with("negate: 0", "negate: 1"), "P2 2 1 255 255 0\n");
  ASSERT_TRUE(map.has_value()) << result::to_string(map.error());
  EXPECT_TRUE(map->blocked({0, 0}));
  EXPECT_FALSE(map->blocked({1, 0}));
}

TEST_F(MapFile, Read_WhenTheImageIsPng_ThenColoursAreAveragedAndTransparentIsBlocked) {
  const std::array<std::uint8_t, 16> pixels = {255, 255, 255, 255, 0,   0,   0,   255,
                                               255, 255, 255, 0,   255, 255, 150, 255};
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = 4;
  image.height = 1;
  image.format = PNG_FORMAT_RGBA;
  const std::string file = (folder_.path() / "floor.png").string();
  ASSERT_NE(png_image_write_to_file(&image, file.c_str(), 0, pixels.data(), 0, nullptr), 0);
  const auto yaml = write("map.yaml", with("floor.pgm", "floor.png"));
  const auto map = read_map(yaml);
  ASSERT_TRUE(map.has_value()) << result::to_string(map.error());
  EXPECT_FALSE(map->blocked({0, 0}));
  EXPECT_TRUE(map->blocked({1, 0}));
  EXPECT_TRUE(map->blocked({2, 0}));
  EXPECT_FALSE(map->blocked({3, 0}));

  std::filesystem::resize_file(file, std::filesystem::file_size(file) / 2);
  const auto cut = read_map(yaml);
  ASSERT_FALSE(cut.has_value());
  EXPECT_EQ(cut.error().front().code, "F0104");
}

TEST_F(MapFile, Read_WhenKeysAreWrong_ThenTheDiagnosticSaysWhere) {
  EXPECT_EQ(refusal(with("negate: 0", "negates: 0")),
            "map.yaml:4:1: F0103: unknown key 'negates'\n  hint: did you mean 'negate'?");
  EXPECT_THAT(refusal(with("resolution: 0.2\n", "")), HasSubstr("F0103: the key 'resolution' is missing"));
  EXPECT_THAT(refusal(with("0.2", "nan")), HasSubstr("map.yaml:2:13: F0103: 'resolution' is a number"));
  EXPECT_THAT(refusal(with("0.2", "-0.2")), HasSubstr("map.yaml:2:13: F0103: 'resolution' is -0.2, outside"));
  EXPECT_THAT(refusal(with("2.0, 0.0]", "2.0, 0.5]")),
              HasSubstr("map.yaml:3:21: F0103: the map is turned by 0.5 rad"));
  EXPECT_THAT(refusal(with("[-1.0, 2.0, 0.0]", "[-1.0, 2.0]")),
              HasSubstr("map.yaml:3:9: F0103: 'origin' is a list"));
  EXPECT_THAT(refusal(with("negate: 0", "negate: 2")), HasSubstr("map.yaml:4:9: F0103: 'negate' is 0 or 1"));
  EXPECT_THAT(refusal(with("0.196", "0.9")), HasSubstr("map.yaml:6:14: F0103: free_thresh 0.9 is above"));
  EXPECT_THAT(refusal(std::string(kYaml) + "mode: scale\n"), HasSubstr("map.yaml:7:7: F0103: mode 'scale'"));
  EXPECT_THAT(refusal(std::string(kYaml) + "negate: 1\n"),
              HasSubstr("map.yaml:7:1: F0103: the key 'negate' is there twice"));
  EXPECT_EQ(refusal(std::string(kYaml) + "mode: trinary\n"), "read");
}

TEST_F(MapFile, Read_WhenItIsNoYaml_ThenTheDiagnosticSaysWhere) {
  EXPECT_THAT(refusal("image: [floor\n"), HasSubstr("F0102: this is not YAML"));
  EXPECT_THAT(refusal("- image\n"), HasSubstr("map.yaml:1:1: F0103: a map file is a table"));
  EXPECT_THAT(refusal(""), HasSubstr("F0103: a map file is a table"));
  EXPECT_THAT(refusal(std::string(60'000, '[')), HasSubstr("F0102"));
  EXPECT_THAT(refusal(std::string(100'000, ' ')), HasSubstr("F0101: the file has 100000 bytes"));
  EXPECT_THAT(refusal(with("floor.pgm", "nothing.pgm")),
              HasSubstr("nothing.pgm: F0101: there is no such file"));
}

TEST_F(MapFile, Read_WhenTheImageIsWrong_ThenTheDiagnosticSaysWhere) {
  EXPECT_THAT(refusal(kYaml, "GIF89a"), HasSubstr("floor.pgm:1:1: F0104: this is neither a PGM"));
  EXPECT_THAT(refusal(kYaml, "P5\n"),
              HasSubstr("floor.pgm:2:1: F0104: the file ends where the width is due"));
  EXPECT_THAT(refusal(kYaml, "P2\n4 x\n"), HasSubstr("floor.pgm:2:3: F0104: the height is no number"));
  EXPECT_THAT(refusal(kYaml, "P2\n99999999999 1\n"),
              HasSubstr("floor.pgm:2:8: F0104: the width is no number"));
  EXPECT_THAT(refusal(kYaml, "P5\n20000 20000\n255\n"),
              HasSubstr("F0104: the image has 20000 x 20000 pixels"));
  EXPECT_THAT(refusal(kYaml, "P5 0 4 255\n"), HasSubstr("F0104: the image is empty"));
  EXPECT_THAT(refusal(kYaml, "P5 4 4 255\nabc"),
              HasSubstr("F0104: 3 bytes follow the header; 16 pixels need 16"));
  EXPECT_THAT(refusal(kYaml, "P2 4 4 255\n1 2 3 "), HasSubstr("F0104: "));
  EXPECT_THAT(refusal(kYaml, "P2 2 1 100\n1\n101\n"),
              HasSubstr("floor.pgm:3:4: F0104: the sample 101 is above 100"));
}

TEST(MapBytes, Read_WhenBytesAreChangedAtRandom_ThenItReadsOrSaysWhy) {
  std::mt19937 random(17);
  const std::string plain = "P2\n# c\n4 3\n255\n0 254 0 254 1 2 3 4 5 6 7 8\n";
  const std::string raw = std::string("P5 3 2 255\n\x00\xfe\x01\x02\xff\x03", 17);
  const auto changed = [&](std::string text) {
    for (std::size_t k = random() % 3; k > 0; --k)
      text[random() % text.size()] = static_cast<char>(random() % 256);
    if (random() % 5 == 0) text.resize(random() % text.size());
    return text;
  };
  int read = 0;
  constexpr int kRounds = 4000;
  for (int round = 0; round < kRounds; ++round) {
    const auto map = internal::read_description(changed(kYaml), "map.yaml");
    EXPECT_TRUE(map.has_value() || !map.error().front().message.empty());
    const std::string picture = changed(round % 2 == 0 ? plain : raw);
    const std::vector<std::uint8_t> bytes(picture.begin(), picture.end());
    const auto image = internal::read_pgm(bytes, "map.pgm");
    EXPECT_TRUE(image.has_value() || !image.error().front().message.empty());
    read += (map ? 1 : 0) + (image ? 1 : 0);
  }
  EXPECT_GT(read, kRounds / 20);
  EXPECT_LT(read, 2 * kRounds);
}

TEST_F(MapFile, Write_WhenReadAgain_ThenTheGridIsTheSame) {
  std::mt19937 random(21);
  OccupancyGrid grid({.resolution_m = 0.05, .origin = {-12.35, 1e-3}, .columns = 77, .rows = 31});
  for (int k = 0; k < 500; ++k)
    grid.set({static_cast<int>(random() % 77), static_cast<int>(random() % 31)}, true);
  const auto yaml = folder_.path() / "it's #1.yaml";
  ASSERT_TRUE(write_map(grid, yaml).has_value());
  const auto again = read_map(yaml);
  ASSERT_TRUE(again.has_value()) << result::to_string(again.error());
  EXPECT_EQ(*again, grid);
  EXPECT_EQ(write_map(grid, folder_.path() / "no" / "map.yaml").error().front().code, "F0105");
}

}  // namespace
}  // namespace stepwright::fleet
