#include "ladder/graphic/project.h"

namespace stepwright::graphic {

const char* keyword_of(VariableSection section) {
  switch (section) {
    case VariableSection::Local:
      return "VAR";
    case VariableSection::Temp:
      return "VAR_TEMP";
    case VariableSection::Input:
      return "VAR_INPUT";
    case VariableSection::Output:
      return "VAR_OUTPUT";
    case VariableSection::InOut:
      return "VAR_IN_OUT";
    case VariableSection::External:
      return "VAR_EXTERNAL";
    case VariableSection::Global:
      break;
  }
  return "VAR_GLOBAL";
}

}  // namespace stepwright::graphic
