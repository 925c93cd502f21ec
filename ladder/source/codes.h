#pragma once

// The code of every diagnostic of the compiler. Stable: scripts name them, and each has a page in
// ladder/doc/diagnostics; a test holds codes and pages together. E01xx text and syntax, E02xx names and
// declarations, E03xx types, E04xx statements and calls, E05xx addresses, E06xx configuration, E07xx charts
// and rungs, E08xx exchange files, E09xx tests, W0xxx warnings.

namespace stepwright::source::code {

inline constexpr const char* kTooMany = "E0100";
inline constexpr const char* kBadCharacter = "E0101";
inline constexpr const char* kUnterminated = "E0102";
inline constexpr const char* kBadLiteral = "E0103";
inline constexpr const char* kUnexpectedToken = "E0104";
inline constexpr const char* kMissingEnd = "E0105";
inline constexpr const char* kTooDeep = "E0106";
inline constexpr const char* kNotSupported = "E0107";
inline constexpr const char* kLiteralRange = "E0108";
inline constexpr const char* kLongName = "E0109";
inline constexpr const char* kBadTagPragma = "E0110";

inline constexpr const char* kUndeclared = "E0201";
inline constexpr const char* kDuplicate = "E0202";
inline constexpr const char* kUnknownType = "E0203";
inline constexpr const char* kUnknownMember = "E0204";
inline constexpr const char* kNotAVariable = "E0205";
inline constexpr const char* kRecursion = "E0206";
inline constexpr const char* kMissingExternal = "E0207";
inline constexpr const char* kBadSection = "E0208";
inline constexpr const char* kTooLarge = "E0209";

inline constexpr const char* kTypeMismatch = "E0301";
inline constexpr const char* kBadOperand = "E0302";
inline constexpr const char* kNotConstant = "E0303";
inline constexpr const char* kOutOfRange = "E0304";
inline constexpr const char* kConstantDivision = "E0305";
inline constexpr const char* kBadArrayBounds = "E0306";
inline constexpr const char* kIndexCount = "E0307";
inline constexpr const char* kConstantIndex = "E0308";
inline constexpr const char* kBadInitializer = "E0309";

inline constexpr const char* kReadOnly = "E0401";
inline constexpr const char* kUnknownParameter = "E0402";
inline constexpr const char* kArgumentCount = "E0403";
inline constexpr const char* kNotCallable = "E0404";
inline constexpr const char* kDuplicateArgument = "E0405";
inline constexpr const char* kBadForVariable = "E0406";
inline constexpr const char* kDuplicateCase = "E0407";
inline constexpr const char* kExitOutsideLoop = "E0408";
inline constexpr const char* kNeedsVariable = "E0409";
inline constexpr const char* kNoResult = "E0410";
inline constexpr const char* kMissingInOut = "E0411";
inline constexpr const char* kShortLived = "E0412";

inline constexpr const char* kBadAddress = "E0501";
inline constexpr const char* kAddressSize = "E0502";
inline constexpr const char* kAddressNotHere = "E0504";
inline constexpr const char* kMissingAddress = "E0505";
inline constexpr const char* kMemberPlace = "E0506";

inline constexpr const char* kNoProgram = "E0601";
inline constexpr const char* kUnknownTask = "E0602";
inline constexpr const char* kUnknownProgram = "E0603";
inline constexpr const char* kBadTask = "E0604";
inline constexpr const char* kSeveralConfigurations = "E0605";
inline constexpr const char* kBadConnection = "E0606";

inline constexpr const char* kUnknownLabel = "E0701";
inline constexpr const char* kEdgeInFunction = "E0702";
inline constexpr const char* kBadChart = "E0703";

inline constexpr const char* kBadXml = "E0801";
inline constexpr const char* kNotPlcopen = "E0802";
inline constexpr const char* kBadDiagram = "E0803";
inline constexpr const char* kExchangeUnsupported = "E0804";
inline constexpr const char* kOmronAddress = "E0811";
inline constexpr const char* kOmronConstruct = "E0812";
inline constexpr const char* kOmronFull = "E0813";
inline constexpr const char* kNoRungForm = "E0814";

inline constexpr const char* kOnlyInTest = "E0901";
inline constexpr const char* kBadMock = "E0902";

inline constexpr const char* kUnreachable = "W0001";
inline constexpr const char* kUnusedResult = "W0002";
inline constexpr const char* kUnusedVariable = "W0003";
inline constexpr const char* kUnusedParameter = "W0004";
inline constexpr const char* kUnusedPou = "W0005";
inline constexpr const char* kNeverWritten = "W0006";
inline constexpr const char* kWrittenTwice = "W0007";
inline constexpr const char* kEndlessLoop = "W0008";
inline constexpr const char* kForVariableWritten = "W0009";
inline constexpr const char* kRealEquality = "W0010";
inline constexpr const char* kConstantCondition = "W0011";
inline constexpr const char* kNoEffect = "W0012";
inline constexpr const char* kHidingName = "W0013";
inline constexpr const char* kMissingCase = "W0014";
inline constexpr const char* kEmptyBody = "W0015";
inline constexpr const char* kOverlap = "W0016";
inline constexpr const char* kForeignCode = "W0017";
inline constexpr const char* kAccessPath = "W0018";
inline constexpr const char* kInputWritten = "W0019";
inline constexpr const char* kLoneTagPragma = "W0020";
inline constexpr const char* kLooseEnd = "W0021";

}  // namespace stepwright::source::code
