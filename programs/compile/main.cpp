// stepwright compile SOURCE... -o IMAGE.swb [--json FILE]

#include "programs/compile/compile_command.h"

int main(int argc, char** argv) {
  return stepwright::compile_program::run_compile(argc, argv);
}
