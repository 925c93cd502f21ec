// Prints the program of a seed: `st_fuzz_show 42` as ST, `st_fuzz_show 42 c` as C.

#include <cstdlib>
#include <iostream>

#include "tests/fuzz/st/c_writer.h"
#include "tests/fuzz/st/generator.h"

int main(int argc, char** argv) {
  using namespace stepwright::st_fuzz;
  const auto program = generate(argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 1);
  const Program* list[] = {program.get()};
  std::cout << (argc > 2 ? write_c(list, {}) : write_st(*program, {}));
}
