#pragma once

// The container file, byte by byte: a header, a section table, sections of fixed-size records.
// Everything is little-endian; these structs are the bytes of the file and are read with memcpy.
// Specified in runtime/doc/bytecode_format.md.
//
// Invariants of a valid file (the verifier checks them): every section exactly once, in the order of its id
// (the last one, Document, may be missing), each starting at the next multiple of 8 behind the one before,
// padding zero, the file ends with the last. Ranges into another section (members of types, code of
// functions, transitions and steps of charts, links of transitions) follow each other in the order of their
// owners without gaps.

#include <cstdint>
#include <type_traits>

namespace stepwright::bytecode {

inline constexpr std::uint32_t kMagic = 0x31425753;  // "SWB1"
inline constexpr std::uint16_t kVersion = 4;
inline constexpr std::uint8_t kNoBit = 0xFF;  // an address that is a byte address, not a bit
inline constexpr std::uint32_t kNoIndex = 0xFFFFFFFF;

// Bounds that keep a hostile file from asking for the machine's memory.
inline constexpr std::uint32_t kMaxContainerBytes = 64u << 20;
inline constexpr std::uint32_t kMaxImageBytes = 64u << 20;
inline constexpr std::uint32_t kMaxStackSlots = 1u << 20;
inline constexpr std::uint32_t kMaxCallDepth = 64;
inline constexpr std::uint32_t kMaxTasks = 16;
inline constexpr std::uint32_t kMaxStringBytes = 4096;    // of a name
inline constexpr std::uint32_t kMaxTextBytes = 1u << 16;  // of what people read: a condition, a comment
// Of all texts longer than a name together, counted wherever one is used.
inline constexpr std::uint32_t kMaxLongTextBytes = 16u << 20;
inline constexpr std::uint32_t kMaxLocals = 0xFFFF;  // of one function, parameters included

struct FileHeader {
  std::uint32_t magic;
  std::uint16_t version;
  std::uint16_t section_count;
  std::uint32_t total_bytes;
  std::uint32_t reserved;  // 0
  std::uint64_t checksum;  // hash_bytes(bytes behind the header, seed = hash_bytes(the first 16 bytes))
};

enum class Section : std::uint32_t {
  Sizes = 0,
  Strings,
  Types,
  Members,
  Symbols,
  Tasks,
  ProgramCalls,
  Functions,
  Locals,
  Code,
  Constants,
  InitialData,
  IoMap,
  RetainMap,
  SfcCharts,
  SfcSteps,
  SfcTransitions,
  SfcLinks,
  SourceFiles,
  SourceMap,
  // For viewers: bytes that say nothing to an engine, and may be missing altogether.
  Document,
};
// Those that every file has.
inline constexpr std::uint16_t kSectionCount = 20;
inline constexpr std::uint16_t kMostSections = 21;
inline constexpr std::uint32_t kMaxDocumentBytes = 4u << 20;

struct SectionEntry {
  std::uint32_t id;
  std::uint32_t offset;    // from the start of the file, a multiple of 8
  std::uint32_t size;      // in bytes, a multiple of the record's size
  std::uint32_t reserved;  // 0
};

// The section Sizes: exactly one. The memory is one block: the image [inputs][outputs][markers][data], then
// the frames, `frame_bytes` for each task in the order of the table. Frames hold the locals of functions that
// need an address; they have no value between scans.
struct SizesRecord {
  std::uint32_t input_bytes;
  std::uint32_t output_bytes;
  std::uint32_t marker_bytes;
  std::uint32_t data_bytes;
  std::uint32_t stack_slots;  // 64-bit slots that the deepest call chain of any task needs
  std::uint32_t call_depth;   // functions in that chain's longest path
  std::uint32_t frame_bytes;  // of one task
};

// A piece of the section Strings; UTF-8, not terminated. A name or a text.
struct StringRef {
  std::uint32_t offset;
  std::uint32_t length;
};

enum class TypeKind : std::uint8_t {
  Elementary = 0,
  Array = 1,  // one dimension; more dimensions are arrays of arrays
  Struct = 2,
  Instance = 3,     // the data of a program or function block
  String = 4,       // STRING[n] or WSTRING[n]
  Enumeration = 5,  // an integer with names
  Reference = 6,    // REF_TO
  Subrange = 7,     // an integer with bounds
};
inline constexpr std::uint8_t kTypeKindCount = 8;

struct TypeRecord {
  StringRef name;
  std::uint8_t kind;  // TypeKind
  std::uint8_t
      elementary;  // ElementaryType; String or Wstring; the base of an enumeration or a subrange; else 0
  std::uint16_t reserved;  // 0
  std::uint32_t size;      // bytes in the image
  std::uint32_t first;  // Array: element type. Struct, Instance, Enumeration: first member. Reference: target
  std::uint32_t count;  // Array: elements. Struct, Instance, Enumeration: members. String: capacity
  std::int64_t lower;   // Array: index of the first element. Subrange: lower bound (unsigned base: its bits)
  std::int64_t upper;   // Array: index of the last element. Subrange: upper bound
};

enum MemberFlag : std::uint32_t {
  kMemberConstant = 1,  // its value is the program's, not the process': nothing carries it over
  kMemberHidden = 2,    // state that the compiler keeps; no name of the program, and no viewer shows it
};
inline constexpr std::uint32_t kMemberFlagMask = 3;

struct MemberRecord {
  StringRef name;
  std::uint32_t type;  // kNoIndex for an enumerator
  std::uint32_t
      offset;  // from the start of the struct or instance; the value of an enumerator (signed: as i32)
  std::uint32_t flags;  // MemberFlag; 0 for an enumerator
};

// VAR_IN_OUT, VAR_TEMP and the variables of functions are not listed: they have no value between scans.
enum class SymbolSection : std::uint8_t { Local = 0, Input = 1, Output = 2, Global = 3 };
inline constexpr std::uint8_t kSymbolSectionCount = 4;

enum SymbolFlag : std::uint16_t {
  kSymbolRetain = 1,
  kSymbolLocated = 2,
  kSymbolConstant = 4,
};
inline constexpr std::uint16_t kSymbolFlagMask = 7;

// A variable by its path ("MAIN.timer.Q", "level_a1"). Its address is absolute.
struct SymbolRecord {
  StringRef name;
  std::uint32_t type;
  std::uint32_t address;
  std::uint8_t bit;      // 0..7 for a located BOOL, else kNoBit
  std::uint8_t section;  // SymbolSection
  std::uint16_t flags;   // SymbolFlag
};

struct TaskRecord {
  StringRef name;
  std::uint32_t interval_us;  // 0: runs on its trigger only; without one, again as soon as it has ended
  std::uint32_t priority;     // 0 is the highest
  std::uint32_t first_call;
  std::uint32_t call_count;
  std::uint32_t trigger;  // symbol of the BOOL whose rising edge runs it (SINGLE); kNoIndex: none
};

// One program instance that a task runs, in the order of the table.
struct ProgramCallRecord {
  StringRef name;
  std::uint32_t function;
  std::uint32_t instance;  // absolute address of its data
};

enum class FunctionKind : std::uint8_t { Function = 0, FunctionBlock = 1, Program = 2 };
inline constexpr std::uint8_t kFunctionKindCount = 3;

enum FunctionFlag : std::uint32_t {
  kFunctionOfLibrary = 1,  // a trap in it is one of the call that led into the library
};
inline constexpr std::uint32_t kFunctionFlagMask = 1;

struct FunctionRecord {
  StringRef name;
  std::uint8_t kind;          // FunctionKind
  std::uint8_t result;        // StackType or kNoResult; kNoResult unless kind is Function
  std::uint16_t param_count;  // 0 unless kind is Function; the first locals, popped from the caller's stack
  std::uint32_t local_count;  // parameters included
  std::uint32_t first_local;  // into the section Locals: one StackType byte each
  std::uint32_t code_offset;  // into the section Code
  std::uint32_t code_size;
  std::uint32_t max_stack;      // operand slots, as the verifier computes them
  std::uint32_t instance_size;  // bytes of the instance; 0 if kind is Function
  std::uint32_t frame_offset;   // of its memory locals within the task's frame; behind those of every caller
  std::uint32_t frame_size;     // bytes of them
  std::uint32_t flags;          // FunctionFlag
};

struct IoRecord {
  StringRef address;  // "%IX0.0"
  std::uint32_t symbol;
};

struct RetainRecord {
  std::uint32_t address;
  std::uint32_t size;
};

struct SfcChartRecord {
  StringRef name;
  std::uint32_t first_step;
  std::uint32_t step_count;
  std::uint32_t first_transition;
  std::uint32_t transition_count;
};

enum SfcStepFlag : std::uint8_t { kStepInitial = 1 };

struct SfcStepRecord {
  StringRef name;
  StringRef comment;      // a text
  std::uint32_t address;  // of the step's activity (X): a BOOL byte, or a bit
  std::uint8_t bit;       // kNoBit for a BOOL byte
  std::uint8_t flags;     // SfcStepFlag
  std::uint16_t reserved;
};

struct SfcTransitionRecord {
  StringRef name;
  StringRef condition;         // a text
  std::uint32_t first_source;  // into SfcLinks: indexes of steps within the chart
  std::uint32_t source_count;
  std::uint32_t first_target;
  std::uint32_t target_count;
  std::uint32_t address;  // of the transition bit; kNoIndex if there is none
  std::uint8_t bit;
  std::uint8_t reserved[3];
};

// Code from `pc` of `function` on, up to the next record, comes from this line. Sorted by (function, pc).
struct SourceMapRecord {
  std::uint32_t function;
  std::uint32_t pc;
  std::uint32_t file;    // into SourceFiles (StringRef each)
  std::uint32_t line;    // from 1
  std::uint32_t column;  // from 1; 0: not known
};

static_assert(sizeof(FileHeader) == 24 && sizeof(SectionEntry) == 16 && sizeof(SizesRecord) == 28);
static_assert(sizeof(StringRef) == 8 && sizeof(TypeRecord) == 40 && sizeof(MemberRecord) == 20);
static_assert(sizeof(SymbolRecord) == 20 && sizeof(TaskRecord) == 28 && sizeof(ProgramCallRecord) == 16);
static_assert(sizeof(FunctionRecord) == 48 && sizeof(IoRecord) == 12 && sizeof(RetainRecord) == 8);
static_assert(sizeof(SfcChartRecord) == 24 && sizeof(SfcStepRecord) == 24);
static_assert(sizeof(SfcTransitionRecord) == 40 && sizeof(SourceMapRecord) == 20);

// The record that a section is made of.
template <Section>
struct RecordOf {
  using Type = std::uint8_t;  // Strings, Locals, Code, InitialData, Document: plain bytes
};
#define STEPWRIGHT_RECORD(section, record) \
  template <>                              \
  struct RecordOf<Section::section> {      \
    using Type = record;                   \
  };
STEPWRIGHT_RECORD(Sizes, SizesRecord)
STEPWRIGHT_RECORD(Types, TypeRecord)
STEPWRIGHT_RECORD(Members, MemberRecord)
STEPWRIGHT_RECORD(Symbols, SymbolRecord)
STEPWRIGHT_RECORD(Tasks, TaskRecord)
STEPWRIGHT_RECORD(ProgramCalls, ProgramCallRecord)
STEPWRIGHT_RECORD(Functions, FunctionRecord)
STEPWRIGHT_RECORD(Constants, std::uint64_t)
STEPWRIGHT_RECORD(IoMap, IoRecord)
STEPWRIGHT_RECORD(RetainMap, RetainRecord)
STEPWRIGHT_RECORD(SfcCharts, SfcChartRecord)
STEPWRIGHT_RECORD(SfcSteps, SfcStepRecord)
STEPWRIGHT_RECORD(SfcTransitions, SfcTransitionRecord)
STEPWRIGHT_RECORD(SfcLinks, std::uint32_t)
STEPWRIGHT_RECORD(SourceFiles, StringRef)
STEPWRIGHT_RECORD(SourceMap, SourceMapRecord)
#undef STEPWRIGHT_RECORD

}  // namespace stepwright::bytecode
