#pragma once

// The quick instruction set as lists (superinstruction.h says what it is for).
// STEPWRIGHT_SUPERINSTRUCTIONS(X) expands X(Name, Elements, parts...): a superinstruction means exactly its
// parts, one after the other.
//
// A name reads like its parts: Var loads a variable of the running instance, Const a constant, Element the
// element of an array in the instance whose index is a variable there; ToVar and ToRef store the result,
// Else jumps if it is FALSE. `Elements` is the memory type of the elements that it reaches itself, or None.

// One arithmetic operation on one type; V, K and S load a variable, push a constant, store.
#define STEPWRIGHT_SUPER_OPERANDS(X, Op, V, K) \
  X(Var##Op, None, V, Op)                      \
  X(Const##Op, None, K, Op)                    \
  X(VarVar##Op, None, V, V, Op)                \
  X(VarConst##Op, None, V, K, Op)
#define STEPWRIGHT_SUPER_ASSIGN(X, Op, V, K, S) \
  X(Op##ToVar, None, Op, S)                     \
  X(Var##Op##ToVar, None, V, Op, S)             \
  X(Const##Op##ToVar, None, K, Op, S)           \
  X(VarVar##Op##ToVar, None, V, V, Op, S)       \
  X(VarConst##Op##ToVar, None, V, K, Op, S)

// The Ref of an element whose index is a DINT, and the element.
#define STEPWRIGHT_ELEMENT_REF AddrThis, LoadI32This, Index
#define STEPWRIGHT_REAL_ELEMENT STEPWRIGHT_ELEMENT_REF, LoadF32Ind

// One superinstruction a line, although nothing separates the macros of a list.
// clang-format off
#define STEPWRIGHT_SUPER_REAL(X, Op)                                            \
  STEPWRIGHT_SUPER_OPERANDS(X, Op, LoadF32This, ConstF32)                       \
  STEPWRIGHT_SUPER_ASSIGN(X, Op, LoadF32This, ConstF32, StoreF32This)           \
  X(Op##ToRef, None, Op, StoreF32Ind)                                           \
  X(Var##Op##ToRef, None, LoadF32This, Op, StoreF32Ind)                         \
  X(Const##Op##ToRef, None, ConstF32, Op, StoreF32Ind)                          \
  X(Element##Op, F32, STEPWRIGHT_REAL_ELEMENT, Op)                              \
  X(ElementVar##Op, F32, STEPWRIGHT_REAL_ELEMENT, LoadF32This, Op)              \
  X(Element##Op##ToVar, F32, STEPWRIGHT_REAL_ELEMENT, Op, StoreF32This)         \
  X(RefVarVar##Op, None, STEPWRIGHT_ELEMENT_REF, LoadF32This, LoadF32This, Op)  \
  X(RefElementVar##Op, F32, STEPWRIGHT_ELEMENT_REF, STEPWRIGHT_REAL_ELEMENT, LoadF32This, Op)

#define STEPWRIGHT_SUPER_ARITHMETIC(X)                                       \
  STEPWRIGHT_SUPER_REAL(X, AddF32)                                           \
  STEPWRIGHT_SUPER_REAL(X, SubF32)                                           \
  STEPWRIGHT_SUPER_REAL(X, MulF32)                                           \
  X(VarConstMulF32AddF32ToVar, None, LoadF32This, ConstF32, MulF32, AddF32, StoreF32This) \
  X(VarConstMulF32SubF32ToVar, None, LoadF32This, ConstF32, MulF32, SubF32, StoreF32This) \
  X(VarVarConstMulF32AddF32ToVar, None, LoadF32This, LoadF32This, ConstF32, MulF32, AddF32, StoreF32This) \
  X(VarVarConstMulF32SubF32ToVar, None, LoadF32This, LoadF32This, ConstF32, MulF32, SubF32, StoreF32This) \
  X(ElementVarMulF32ElementAddF32ToVar, F32, STEPWRIGHT_REAL_ELEMENT, LoadF32This, MulF32, \
    STEPWRIGHT_REAL_ELEMENT, AddF32, StoreF32This) \
  STEPWRIGHT_SUPER_OPERANDS(X, AddI32, LoadI32This, ConstI32)                \
  STEPWRIGHT_SUPER_ASSIGN(X, AddI32, LoadI32This, ConstI32, StoreI32This)    \
  STEPWRIGHT_SUPER_OPERANDS(X, SubI32, LoadI32This, ConstI32)                \
  STEPWRIGHT_SUPER_ASSIGN(X, SubI32, LoadI32This, ConstI32, StoreI32This)    \
  STEPWRIGHT_SUPER_OPERANDS(X, MulI32, LoadI32This, ConstI32)

#define STEPWRIGHT_SUPER_MOVES(X)                                                     \
  X(VarToVarF32, None, LoadF32This, StoreF32This)                                     \
  X(ConstToVarF32, None, ConstF32, StoreF32This)                                      \
  X(ConstToVarI32, None, ConstI32, StoreI32This)                                      \
  X(ElementRef, None, STEPWRIGHT_ELEMENT_REF)                                         \
  X(ElementRefI16, None, AddrThis, LoadI16This, Index)                                \
  X(ElementF32, F32, STEPWRIGHT_REAL_ELEMENT)                                         \
  X(ElementI32, I32, STEPWRIGHT_ELEMENT_REF, LoadI32Ind)                              \
  X(VarToElementF32, F32, STEPWRIGHT_ELEMENT_REF, LoadF32This, StoreF32Ind)

#define STEPWRIGHT_SUPER_JUMPS(X)                                        \
  X(BoolElse, None, LoadBoolThis, JumpIfFalse)                           \
  X(NotBoolElse, None, LoadNotBoolThis, JumpIfFalse)                     \
  X(EqI32Else, None, EqI32, JumpIfFalse)                                 \
  X(NeI32Else, None, NeI32, JumpIfFalse)                                 \
  X(LtI32Else, None, LtI32, JumpIfFalse)                                 \
  X(LeI32Else, None, LeI32, JumpIfFalse)                                 \
  X(GtI32Else, None, GtI32, JumpIfFalse)                                 \
  X(GeI32Else, None, GeI32, JumpIfFalse)                                 \
  X(VarConstEqI32Else, None, LoadI32This, ConstI32, EqI32, JumpIfFalse)  \
  X(VarConstNeI32Else, None, LoadI32This, ConstI32, NeI32, JumpIfFalse)  \
  X(VarConstLtI32Else, None, LoadI32This, ConstI32, LtI32, JumpIfFalse)  \
  X(VarConstLeI32Else, None, LoadI32This, ConstI32, LeI32, JumpIfFalse)  \
  X(VarConstGtI32Else, None, LoadI32This, ConstI32, GtI32, JumpIfFalse)  \
  X(VarConstGeI32Else, None, LoadI32This, ConstI32, GeI32, JumpIfFalse)  \
  X(VarConstLtF32Else, None, LoadF32This, ConstF32, LtF32, JumpIfFalse)  \
  X(VarConstGtF32Else, None, LoadF32This, ConstF32, GtF32, JumpIfFalse)  \
  X(CountGtI32Else, None, LoadI32This, ConstI32, AddI32, StoreI32This, LoadI32This, ConstI32, GtI32, JumpIfFalse) \
  X(CountGeI32Else, None, LoadI32This, ConstI32, AddI32, StoreI32This, LoadI32This, ConstI32, GeI32, JumpIfFalse) \
  X(NextDint, None, LoadI32This, ConstI32, GtI32, LoadI32This, ConstI32, AddI32, StoreI32This, JumpIfFalse) \
  X(NextInt, None, LoadI16This, ConstI32, GtI32, LoadI16This, ConstI32, AddI32, StoreI16This, JumpIfFalse)

#define STEPWRIGHT_SUPERINSTRUCTIONS(X) \
  STEPWRIGHT_SUPER_ARITHMETIC(X)        \
  STEPWRIGHT_SUPER_MOVES(X)             \
  STEPWRIGHT_SUPER_JUMPS(X)

// The instructions of the file that are quick ones, too: X(Name, ...). What is not here takes one dispatch
// more (Original).
#define STEPWRIGHT_QUICK_MEMORY(X, Type, c) \
  STEPWRIGHT_LOAD_OPCODES(X, Type, c)       \
  STEPWRIGHT_STORE_OPCODES(X, Type, c)
#define STEPWRIGHT_QUICK_ORDER(X, Op) X(Op##I32) X(Op##I64) X(Op##F32)

#define STEPWRIGHT_QUICK_ORIGINALS(X)                                                            \
  STEPWRIGHT_QUICK_MEMORY(X, Bool, "b")                                                          \
  STEPWRIGHT_QUICK_MEMORY(X, I16, "i")                                                           \
  STEPWRIGHT_QUICK_MEMORY(X, U16, "i")                                                           \
  STEPWRIGHT_QUICK_MEMORY(X, I32, "i")                                                           \
  STEPWRIGHT_QUICK_MEMORY(X, I64, "l")                                                           \
  STEPWRIGHT_QUICK_MEMORY(X, F32, "f")                                                           \
  STEPWRIGHT_QUICK_MEMORY(X, F64, "d")                                                           \
  STEPWRIGHT_QUICK_MEMORY(X, Ref, "r")                                                           \
  X(LoadBit) X(StoreBit) X(LocalGet) X(LocalSet) X(AddrAbs) X(AddrThis) X(AddrFrame)             \
  X(Index) X(IndexDyn) X(Offset)                                                                 \
  X(ConstBool) X(ConstI32) X(ConstI64) X(ConstF32) X(ConstF64)                                   \
  STEPWRIGHT_SIGNED(X, Add) STEPWRIGHT_FLOATING(X, Add)                                          \
  STEPWRIGHT_SIGNED(X, Sub) STEPWRIGHT_FLOATING(X, Sub)                                          \
  STEPWRIGHT_SIGNED(X, Mul) STEPWRIGHT_FLOATING(X, Mul)                                          \
  X(DivI32) STEPWRIGHT_FLOATING(X, Div)                                                          \
  X(WrapI16)                                                                                     \
  STEPWRIGHT_FUSED_OPCODES(X)                                                                    \
  X(AndBool) X(OrBool) X(XorBool) X(NotBool)                                                      \
  X(EqI32) X(NeI32)                                                                              \
  STEPWRIGHT_QUICK_ORDER(X, Lt) STEPWRIGHT_QUICK_ORDER(X, Le)                                    \
  STEPWRIGHT_QUICK_ORDER(X, Gt) STEPWRIGHT_QUICK_ORDER(X, Ge)                                    \
  X(BoolToI32) X(I32ToI64) X(I32ToF32)                                                           \
  X(Dup) X(Drop) X(Select) X(Jump) X(JumpIfFalse) X(JumpIfTrue)                                  \
  X(Call) X(CallInstanceAbs) X(CallInstanceThis) X(CallInstanceInd) X(Return) X(Now) X(Intrinsic)
// clang-format on
