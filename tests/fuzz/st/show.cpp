// Prints the program of a seed: `st_fuzz_show 42` as ST with all of the language, `st_fuzz_show 42 common` as
// ST with what C can say, `st_fuzz_show 42 c` as C.

#include <cstdlib>
#include <iostream>
#include <string>

#include "tests/fuzz/st/c_writer.h"
#include "tests/fuzz/st/generator.h"

int main(int argc, char** argv) {
  using namespace stepwright::st_fuzz;
  const std::string form = argc > 2 ? argv[2] : "";
  const auto program = generate(argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 1,
                                form.empty() ? Language::Whole : Language::Common);
  const Program* list[] = {program.get()};
  std::cout << (form == "c" ? write_c(list, {}) : write_st(*program, {}));
}
