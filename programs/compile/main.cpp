// stepwright compile SOURCE... -o IMAGE.swb [--json FILE]

#include <string_view>

#include "programs/compile/compile_command.h"

int main(int argc, char** argv) {
  // `stepwright` passes its subcommand on as the first argument; another command of this program joins here.
  return stepwright::compile_program::run_compile(argc, argv);
}
