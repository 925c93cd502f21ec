#pragma once

// The instruction set as a list: STEPWRIGHT_OPCODES(X) expands X(Name, Operands, pops, pushes) for every
// opcode, in the order of their numbers (0, 1, 2, ...), which is part of the container format.
//
// `pops` and `pushes` name stack types, deepest first: b Bool, i I32, l I64, f F32, d F64, r Ref.
// "*" = the effect depends on an operand (see the instruction's text in runtime/doc/bytecode_format.md).
// Binary operations take the left operand first: x y SubI32 gives x - y.

// Load and Store of one memory type in the three address modes. Indirect stores take the Ref below the value.
#define STEPWRIGHT_LOAD_OPCODES(X, Type, c) \
  X(Load##Type##Abs, U32, "", c)            \
  X(Load##Type##This, U32, "", c)           \
  X(Load##Type##Ind, None, "r", c)
#define STEPWRIGHT_STORE_OPCODES(X, Type, c) \
  X(Store##Type##Abs, U32, c, "")            \
  X(Store##Type##This, U32, c, "")           \
  X(Store##Type##Ind, None, "r" c, "")

#define STEPWRIGHT_MEMORY_OPCODES(X)     \
  STEPWRIGHT_LOAD_OPCODES(X, Bool, "b")  \
  STEPWRIGHT_LOAD_OPCODES(X, I8, "i")    \
  STEPWRIGHT_LOAD_OPCODES(X, U8, "i")    \
  STEPWRIGHT_LOAD_OPCODES(X, I16, "i")   \
  STEPWRIGHT_LOAD_OPCODES(X, U16, "i")   \
  STEPWRIGHT_LOAD_OPCODES(X, I32, "i")   \
  STEPWRIGHT_LOAD_OPCODES(X, I64, "l")   \
  STEPWRIGHT_LOAD_OPCODES(X, F32, "f")   \
  STEPWRIGHT_LOAD_OPCODES(X, F64, "d")   \
  STEPWRIGHT_LOAD_OPCODES(X, Ref, "r")   \
  STEPWRIGHT_STORE_OPCODES(X, Bool, "b") \
  STEPWRIGHT_STORE_OPCODES(X, I8, "i")   \
  STEPWRIGHT_STORE_OPCODES(X, U8, "i")   \
  STEPWRIGHT_STORE_OPCODES(X, I16, "i")  \
  STEPWRIGHT_STORE_OPCODES(X, U16, "i")  \
  STEPWRIGHT_STORE_OPCODES(X, I32, "i")  \
  STEPWRIGHT_STORE_OPCODES(X, I64, "l")  \
  STEPWRIGHT_STORE_OPCODES(X, F32, "f")  \
  STEPWRIGHT_STORE_OPCODES(X, F64, "d")  \
  STEPWRIGHT_STORE_OPCODES(X, Ref, "r")  \
  X(LoadBit, ByteBit, "", "b")           \
  X(StoreBit, ByteBit, "b", "")          \
  X(LocalGet, U32, "*", "*")             \
  X(LocalSet, U32, "*", "*")             \
  X(AddrAbs, U32, "", "r")               \
  X(AddrThis, U32, "", "r")              \
  X(AddrFrame, U32, "", "r")             \
  X(Index, Range, "ri", "r")             \
  X(IndexDyn, U32, "riii", "r")          \
  X(Offset, U32, "r", "r")               \
  X(MemCopy, U32, "rr", "")              \
  X(StringOp, U8, "*", "*")

#define STEPWRIGHT_CONSTANT_OPCODES(X) \
  X(ConstBool, U8, "", "b")            \
  X(ConstI32, U32, "", "i")            \
  X(ConstI64, U32, "", "l")            \
  X(ConstF32, U32, "", "f")            \
  X(ConstF64, U32, "", "d")            \
  X(ConstNull, None, "", "r")

// The four arithmetic types of one operation, and the two more of unsigned integers.
#define STEPWRIGHT_SIGNED(X, Op) \
  X(Op##I32, None, "ii", "i")    \
  X(Op##I64, None, "ll", "l")
#define STEPWRIGHT_UNSIGNED(X, Op) \
  X(Op##U32, None, "ii", "i")      \
  X(Op##U64, None, "ll", "l")
#define STEPWRIGHT_FLOATING(X, Op) \
  X(Op##F32, None, "ff", "f")      \
  X(Op##F64, None, "dd", "d")

// clang-format off: one opcode a line, although nothing separates the macros of a list
#define STEPWRIGHT_ARITHMETIC_OPCODES(X) \
  STEPWRIGHT_SIGNED(X, Add)              \
  STEPWRIGHT_FLOATING(X, Add)            \
  STEPWRIGHT_SIGNED(X, Sub)              \
  STEPWRIGHT_FLOATING(X, Sub)            \
  STEPWRIGHT_SIGNED(X, Mul)              \
  STEPWRIGHT_FLOATING(X, Mul)            \
  STEPWRIGHT_SIGNED(X, Div)              \
  STEPWRIGHT_UNSIGNED(X, Div)            \
  STEPWRIGHT_FLOATING(X, Div)            \
  STEPWRIGHT_SIGNED(X, Mod)              \
  STEPWRIGHT_UNSIGNED(X, Mod)            \
  X(NegI32, None, "i", "i")              \
  X(NegI64, None, "l", "l")              \
  X(NegF32, None, "f", "f")              \
  X(NegF64, None, "d", "d")              \
  X(WrapI8, None, "i", "i")              \
  X(WrapU8, None, "i", "i")              \
  X(WrapI16, None, "i", "i")             \
  X(WrapU16, None, "i", "i")

// A boolean operation whose right operand is a BOOL in memory (one byte): what contacts compile to. The
// writer forms them from a load and the operation behind it; compilers need not know them.
#define STEPWRIGHT_FUSED_BOOLEAN(X, Name, pops) \
  X(Name##Abs, U32, pops, "b")                  \
  X(Name##This, U32, pops, "b")

// Two instructions on BOOLs in memory as one: a load and the operation behind it; an operation and the store
// of its result; a load and a store. A rung of three contacts is a LoadAndBool and an AndStoreBool.
#define STEPWRIGHT_BOOLEAN_PAIR(X, Name, pops, pushes) \
  X(Name##Abs, TwoU32, pops, pushes)                   \
  X(Name##This, TwoU32, pops, pushes)

#define STEPWRIGHT_BOOLEAN_PAIR_OPCODES(X)             \
  STEPWRIGHT_BOOLEAN_PAIR(X, LoadAndBool, "", "b")     \
  STEPWRIGHT_BOOLEAN_PAIR(X, LoadOrBool, "", "b")      \
  STEPWRIGHT_BOOLEAN_PAIR(X, LoadAndNotBool, "", "b")  \
  STEPWRIGHT_BOOLEAN_PAIR(X, LoadOrNotBool, "", "b")   \
  STEPWRIGHT_BOOLEAN_PAIR(X, LoadNorBool, "", "b")     \
  STEPWRIGHT_BOOLEAN_PAIR(X, LoadNandBool, "", "b")    \
  STEPWRIGHT_BOOLEAN_PAIR(X, AndStoreBool, "b", "")    \
  STEPWRIGHT_BOOLEAN_PAIR(X, OrStoreBool, "b", "")     \
  STEPWRIGHT_BOOLEAN_PAIR(X, AndNotStoreBool, "b", "") \
  STEPWRIGHT_BOOLEAN_PAIR(X, OrNotStoreBool, "b", "")  \
  STEPWRIGHT_BOOLEAN_PAIR(X, MoveBool, "", "")         \
  STEPWRIGHT_BOOLEAN_PAIR(X, MoveNotBool, "", "")

#define STEPWRIGHT_FUSED_OPCODES(X)            \
  STEPWRIGHT_FUSED_BOOLEAN(X, LoadNotBool, "") \
  STEPWRIGHT_FUSED_BOOLEAN(X, AndBool, "b")    \
  STEPWRIGHT_FUSED_BOOLEAN(X, OrBool, "b")     \
  STEPWRIGHT_FUSED_BOOLEAN(X, AndNotBool, "b") \
  STEPWRIGHT_FUSED_BOOLEAN(X, OrNotBool, "b")  \
  STEPWRIGHT_FUSED_BOOLEAN(X, XorBool, "b")    \
  STEPWRIGHT_BOOLEAN_PAIR_OPCODES(X)

#define STEPWRIGHT_BIT_OPCODES(X) \
  X(AndBool, None, "bb", "b")     \
  X(OrBool, None, "bb", "b")      \
  X(XorBool, None, "bb", "b")     \
  X(NotBool, None, "b", "b")      \
  STEPWRIGHT_SIGNED(X, And)       \
  STEPWRIGHT_SIGNED(X, Or)        \
  STEPWRIGHT_SIGNED(X, Xor)       \
  X(NotI32, None, "i", "i")       \
  X(NotI64, None, "l", "l")       \
  X(ShlI32, None, "ii", "i")      \
  X(ShlI64, None, "li", "l")      \
  X(ShrI32, None, "ii", "i")      \
  X(ShrI64, None, "li", "l")      \
  X(RolI32, U8, "ii", "i")        \
  X(RolI64, None, "li", "l")      \
  X(RorI32, U8, "ii", "i")        \
  X(RorI64, None, "li", "l")
// clang-format on

#define STEPWRIGHT_EQUALITY(X, Op) \
  X(Op##I32, None, "ii", "b")      \
  X(Op##I64, None, "ll", "b")      \
  X(Op##F32, None, "ff", "b")      \
  X(Op##F64, None, "dd", "b")
#define STEPWRIGHT_ORDER(X, Op) \
  STEPWRIGHT_EQUALITY(X, Op)    \
  X(Op##U32, None, "ii", "b")   \
  X(Op##U64, None, "ll", "b")

#define STEPWRIGHT_COMPARISON_OPCODES(X) \
  STEPWRIGHT_EQUALITY(X, Eq)             \
  STEPWRIGHT_EQUALITY(X, Ne)             \
  STEPWRIGHT_ORDER(X, Lt)                \
  STEPWRIGHT_ORDER(X, Le)                \
  STEPWRIGHT_ORDER(X, Gt)                \
  STEPWRIGHT_ORDER(X, Ge)                \
  X(EqRef, None, "rr", "b")              \
  X(NeRef, None, "rr", "b")              \
  X(CheckI32, Bounds, "i", "i")          \
  X(CheckI64, Constants, "l", "l")       \
  X(CheckU64, Constants, "l", "l")

#define STEPWRIGHT_CONVERSION_OPCODES(X) \
  X(BoolToI32, None, "b", "i")           \
  X(I32ToBool, None, "i", "b")           \
  X(I64ToBool, None, "l", "b")           \
  X(I32ToI64, None, "i", "l")            \
  X(U32ToI64, None, "i", "l")            \
  X(I64ToI32, None, "l", "i")            \
  X(I32ToF32, None, "i", "f")            \
  X(U32ToF32, None, "i", "f")            \
  X(I64ToF32, None, "l", "f")            \
  X(U64ToF32, None, "l", "f")            \
  X(I32ToF64, None, "i", "d")            \
  X(U32ToF64, None, "i", "d")            \
  X(I64ToF64, None, "l", "d")            \
  X(U64ToF64, None, "l", "d")            \
  X(F32ToF64, None, "f", "d")            \
  X(F64ToF32, None, "d", "f")            \
  X(RoundF32, U8, "f", "*")              \
  X(RoundF64, U8, "d", "*")              \
  X(TruncF32, U8, "f", "*")              \
  X(TruncF64, U8, "d", "*")

#define STEPWRIGHT_CONTROL_OPCODES(X)          \
  X(Dup, None, "*", "*")                       \
  X(Drop, None, "*", "*")                      \
  X(Select, None, "*", "*")                    \
  X(Jump, I32, "", "")                         \
  X(JumpIfFalse, I32, "b", "")                 \
  X(JumpIfTrue, I32, "b", "")                  \
  X(Call, U32, "*", "*")                       \
  X(CallInstanceAbs, FunctionAddress, "", "")  \
  X(CallInstanceThis, FunctionAddress, "", "") \
  X(CallInstanceInd, U32, "r", "")             \
  X(Return, None, "*", "")                     \
  X(Now, None, "", "l")                        \
  X(Intrinsic, U8, "*", "*")                   \
  X(Trap, U8, "", "")

#define STEPWRIGHT_OPCODES(X)      \
  STEPWRIGHT_MEMORY_OPCODES(X)     \
  STEPWRIGHT_CONSTANT_OPCODES(X)   \
  STEPWRIGHT_ARITHMETIC_OPCODES(X) \
  STEPWRIGHT_FUSED_OPCODES(X)      \
  STEPWRIGHT_BIT_OPCODES(X)        \
  STEPWRIGHT_COMPARISON_OPCODES(X) \
  STEPWRIGHT_CONVERSION_OPCODES(X) \
  STEPWRIGHT_CONTROL_OPCODES(X)

// Functions that are not worth an opcode of their own: X(Name, pops, pushes). Abs to Max are exact: each
// gives the same bits on every machine. The elementary functions behind them are those of the platform's C
// library, F32 computed in double and rounded once; both engines call the same ones.
#define STEPWRIGHT_REAL_INTRINSIC(X, Op) \
  X(Op##F32, "f", "f")                   \
  X(Op##F64, "d", "d")

#define STEPWRIGHT_ELEMENTARY_FUNCTIONS(X) \
  STEPWRIGHT_REAL_INTRINSIC(X, Sin)        \
  STEPWRIGHT_REAL_INTRINSIC(X, Cos)        \
  STEPWRIGHT_REAL_INTRINSIC(X, Tan)        \
  STEPWRIGHT_REAL_INTRINSIC(X, Asin)       \
  STEPWRIGHT_REAL_INTRINSIC(X, Acos)       \
  STEPWRIGHT_REAL_INTRINSIC(X, Atan)       \
  X(Atan2F32, "ff", "f")                   \
  X(Atan2F64, "dd", "d")                   \
  STEPWRIGHT_REAL_INTRINSIC(X, Exp)        \
  STEPWRIGHT_REAL_INTRINSIC(X, Ln)         \
  STEPWRIGHT_REAL_INTRINSIC(X, Log)        \
  X(PowF32, "ff", "f")                     \
  X(PowF64, "dd", "d")

#define STEPWRIGHT_INTRINSICS(X) \
  X(AbsI32, "i", "i")            \
  X(AbsI64, "l", "l")            \
  X(AbsF32, "f", "f")            \
  X(AbsF64, "d", "d")            \
  X(SqrtF32, "f", "f")           \
  X(SqrtF64, "d", "d")           \
  X(MinI32, "ii", "i")           \
  X(MinI64, "ll", "l")           \
  X(MinU32, "ii", "i")           \
  X(MinU64, "ll", "l")           \
  X(MinF32, "ff", "f")           \
  X(MinF64, "dd", "d")           \
  X(MaxI32, "ii", "i")           \
  X(MaxI64, "ll", "l")           \
  X(MaxU32, "ii", "i")           \
  X(MaxU64, "ll", "l")           \
  X(MaxF32, "ff", "f")           \
  X(MaxF64, "dd", "d")           \
  STEPWRIGHT_ELEMENTARY_FUNCTIONS(X)

// Operations of StringOp, each for STRING (S) and WSTRING (W): X(Name, pops, pushes). The Ref of a
// destination lies below the sources. Positions count from 1. The meaning of each is in
// runtime/doc/bytecode_format.md.
#define STEPWRIGHT_BOTH_STRINGS(X, Op, pops, pushes) \
  X(Op##S, pops, pushes)                             \
  X(Op##W, pops, pushes)

#define STEPWRIGHT_STRING_EDITS(X)                 \
  STEPWRIGHT_BOTH_STRINGS(X, Init, "ri", "")       \
  STEPWRIGHT_BOTH_STRINGS(X, Clear, "r", "")       \
  STEPWRIGHT_BOTH_STRINGS(X, Length, "r", "i")     \
  STEPWRIGHT_BOTH_STRINGS(X, Copy, "rr", "")       \
  STEPWRIGHT_BOTH_STRINGS(X, Concat, "rrr", "")    \
  STEPWRIGHT_BOTH_STRINGS(X, Left, "rri", "")      \
  STEPWRIGHT_BOTH_STRINGS(X, Right, "rri", "")     \
  STEPWRIGHT_BOTH_STRINGS(X, Mid, "rrii", "")      \
  STEPWRIGHT_BOTH_STRINGS(X, Insert, "rrri", "")   \
  STEPWRIGHT_BOTH_STRINGS(X, Delete, "rrii", "")   \
  STEPWRIGHT_BOTH_STRINGS(X, Replace, "rrrii", "") \
  STEPWRIGHT_BOTH_STRINGS(X, Find, "rr", "i")      \
  STEPWRIGHT_BOTH_STRINGS(X, Compare, "rr", "i")   \
  STEPWRIGHT_BOTH_STRINGS(X, CharAt, "ri", "i")    \
  STEPWRIGHT_BOTH_STRINGS(X, SetCharAt, "rii", "")

// The destination below the value; the value of a text, or trap BadArgument.
#define STEPWRIGHT_STRING_CONVERSION(X, Type, c)    \
  STEPWRIGHT_BOTH_STRINGS(X, From##Type, "r" c, "") \
  STEPWRIGHT_BOTH_STRINGS(X, To##Type, "r", c)

#define STEPWRIGHT_STRING_CONVERSIONS(X)     \
  STEPWRIGHT_STRING_CONVERSION(X, Bool, "b") \
  STEPWRIGHT_STRING_CONVERSION(X, I64, "l")  \
  STEPWRIGHT_STRING_CONVERSION(X, U64, "l")  \
  STEPWRIGHT_STRING_CONVERSION(X, F32, "f")  \
  STEPWRIGHT_STRING_CONVERSION(X, F64, "d")  \
  STEPWRIGHT_STRING_CONVERSION(X, Time, "l") \
  STEPWRIGHT_STRING_CONVERSION(X, Date, "l") \
  STEPWRIGHT_STRING_CONVERSION(X, Tod, "l")  \
  STEPWRIGHT_STRING_CONVERSION(X, Dt, "l")   \
  X(StringToWstring, "rr", "")               \
  X(WstringToString, "rr", "")

// Whether To... of the text has a value. In the order of the conversions.
#define STEPWRIGHT_STRING_TESTS(X)             \
  STEPWRIGHT_BOTH_STRINGS(X, IsBool, "r", "b") \
  STEPWRIGHT_BOTH_STRINGS(X, IsI64, "r", "b")  \
  STEPWRIGHT_BOTH_STRINGS(X, IsU64, "r", "b")  \
  STEPWRIGHT_BOTH_STRINGS(X, IsF32, "r", "b")  \
  STEPWRIGHT_BOTH_STRINGS(X, IsF64, "r", "b")  \
  STEPWRIGHT_BOTH_STRINGS(X, IsTime, "r", "b") \
  STEPWRIGHT_BOTH_STRINGS(X, IsDate, "r", "b") \
  STEPWRIGHT_BOTH_STRINGS(X, IsTod, "r", "b")  \
  STEPWRIGHT_BOTH_STRINGS(X, IsDt, "r", "b")

#define STEPWRIGHT_STRING_OPS(X)   \
  STEPWRIGHT_STRING_EDITS(X)       \
  STEPWRIGHT_STRING_CONVERSIONS(X) \
  STEPWRIGHT_STRING_TESTS(X)
