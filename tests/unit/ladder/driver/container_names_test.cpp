#include "ladder/driver/container_names.h"

#include <gtest/gtest.h>

#include "ladder/driver/compile.h"
#include "runtime/bytecode/reader/loaded_program.h"

namespace {

using namespace stepwright;
using Names = std::vector<std::string>;

TEST(ContainerNames, Names_WhenRelative_ThenStayInNormalForm) {
  EXPECT_EQ(driver::container_names(Names{"main.st", "./a.st", "parts//b.st", "x/../c.st", "../d.st", ""},
                                    "/plant"),
            (Names{"main.st", "a.st", "parts/b.st", "c.st", "../d.st", ""}));
}

TEST(ContainerNames, Names_WhenAbsoluteBelowTheFolder_ThenAreRelativeToIt) {
  EXPECT_EQ(driver::container_names(Names{"/plant/main.st", "/plant/parts/b.st"}, "/plant"),
            (Names{"main.st", "parts/b.st"}));
  EXPECT_EQ(driver::container_names(Names{"/plant/main.st"}, "/plant/"), Names{"main.st"});
  EXPECT_EQ(driver::container_names(Names{"/main.st"}, "/"), Names{"main.st"});
}

TEST(ContainerNames, Names_WhenAbsoluteElsewhere_ThenAreRelativeToWhatTheyShare) {
  EXPECT_EQ(driver::container_names(Names{"/home/a/main.st", "/home/a/parts/b.st"}, "/plant"),
            (Names{"main.st", "parts/b.st"}));
  EXPECT_EQ(driver::container_names(Names{"/plantation/main.st"}, "/plant"), Names{"main.st"});
  EXPECT_EQ(driver::container_names(Names{"/home/a/main.st"}, ""), Names{"main.st"});
}

TEST(ContainerNames, Names_WhenTwoFilesWouldBeOne_ThenTheyKeepTheirPaths) {
  EXPECT_EQ(driver::container_names(Names{"main.st", "/home/main.st", "b.st"}, "/plant"),
            (Names{"main.st", "/home/main.st", "b.st"}));
}

// The same sources in three folders, and where the trap of each is found.
TEST(ContainerNames, Container_WhenCompiledInAnotherFolder_ThenBytesAreEqual) {
  const std::string text = "PROGRAM main\nVAR x, zero : INT; END_VAR\n  x := 1 / zero;\nEND_PROGRAM\n";
  const auto compiled = [&](const std::string& name, const std::string& folder) {
    driver::CompileInput input;
    input.texts.push_back({name, text});
    input.folder = folder;
    auto output = driver::compile(input);
    EXPECT_TRUE(output);
    return std::move(output->container);
  };
  const auto reference = compiled("parts/main.st", "/plant");
  EXPECT_EQ(compiled("/plant/parts/main.st", "/plant"), reference);
  EXPECT_EQ(compiled("/home/me/parts/main.st", "/home/me"), reference);
  EXPECT_EQ(compiled("./parts/main.st", "/"), reference);
  EXPECT_NE(compiled("other/main.st", "/plant"), reference);
  const auto loaded = reader::LoadedProgram::load(reference, "main.swb");
  ASSERT_TRUE(loaded);
  EXPECT_EQ(reader::source_location(loaded->program(), 0, 0).file, "parts/main.st");
}

}  // namespace
