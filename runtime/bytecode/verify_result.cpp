#include "runtime/bytecode/verify_result.h"

namespace stepwright::bytecode {

const char* explain(VerifyStatus status) {
  switch (status) {
    case VerifyStatus::Ok:
      return "the container is valid";
    case VerifyStatus::NotAContainer:
      return "this is not a Stepwright container (it does not start with SWB1)";
    case VerifyStatus::WrongVersion:
      return "the container has another format version than this runtime";
    case VerifyStatus::Truncated:
      return "the container is truncated";
    case VerifyStatus::TrailingBytes:
      return "there are bytes behind the end of the container";
    case VerifyStatus::TooLarge:
      return "the container asks for more memory than any runtime gives";
    case VerifyStatus::BadChecksum:
      return "the container is damaged (its checksum differs)";
    case VerifyStatus::BadSectionTable:
      return "the section table is inconsistent";
    case VerifyStatus::BadRecord:
      return "a record is inconsistent";
    case VerifyStatus::BadString:
      return "a name or text lies outside the string section, is too long or is not UTF-8";
    case VerifyStatus::BadType:
      return "a type is inconsistent";
    case VerifyStatus::BadAddress:
      return "an address lies outside the image or the instance";
    case VerifyStatus::BadOpcode:
      return "there is no such opcode";
    case VerifyStatus::BadOperand:
      return "an operand is cut off or out of range";
    case VerifyStatus::BadJump:
      return "a jump leads outside the function or into the middle of an instruction";
    case VerifyStatus::StackUnderflow:
      return "an instruction takes more from the stack than there is";
    case VerifyStatus::StackType:
      return "an instruction finds a value of another type on the stack";
    case VerifyStatus::StackJoin:
      return "two ways lead here with different stacks";
    case VerifyStatus::MissingReturn:
      return "the function's code runs over its end";
    case VerifyStatus::BadCall:
      return "a call names no such function, or one of another kind";
    case VerifyStatus::BadFrame:
      return "a function's frame overlaps that of a caller or lies outside the task's frames";
    case VerifyStatus::Recursion:
      return "a function calls itself, directly or through others, or calls nest too deep";
    case VerifyStatus::WrongSizes:
      return "the declared stack is smaller than the code needs";
    case VerifyStatus::ScratchTooSmall:
      return "the verifier's scratch memory is too small";
  }
  return "unknown";
}

}  // namespace stepwright::bytecode
