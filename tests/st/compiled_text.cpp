#include "tests/st/compiled_text.h"

#include <stdexcept>

#include "ladder/driver/compile.h"

namespace stepwright::st_test {

reader::LoadedProgram compiled(const std::string& text, const source::Dialect& dialect) {
  driver::CompileInput input;
  input.texts.push_back({"program.st", text});
  input.dialect = &dialect;
  auto output = driver::compile(input);
  if (!output) throw std::runtime_error(result::to_string(output.error()));
  auto loaded = reader::LoadedProgram::load(std::move(output->container), "program.st");
  if (!loaded) throw std::runtime_error(result::to_string(loaded.error()));
  return std::move(*loaded);
}

}  // namespace stepwright::st_test
