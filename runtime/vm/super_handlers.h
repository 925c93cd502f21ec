#pragma once

// The handlers of the superinstructions, as macros for Interpreter::run (see handler_macros.h). Nothing else
// may include this file. Inside SUPER, at[n] is where the operands of part n lie, relative to pc.

#define SUPER(name, ...)                                                      \
  super_##name : {                                                            \
    constexpr const Superinstruction& kSuper = superinstruction(Quick::name); \
    constexpr auto at = part_offsets(kSuper);                                 \
    __VA_ARGS__;                                                              \
    pc += at[kSuper.count] - 1;                                               \
    NEXT;                                                                     \
  }
#define FAULT_IN(part, trap_code) \
  do {                            \
    pc += at[part];               \
    FAULT(trap_code);             \
  } while (false)

// The values of a type: what a part loads, and the result of an operation.
#define VALUE_F32 float
#define VALUE_I32 std::uint32_t
#define VAR(M, part) from_slot<VALUE_##M>(load<bytecode::MemType::M>(self + OPERAND(std::uint32_t, at[part])))
#define CONST(M, part) from_slot<VALUE_##M>(OPERAND(std::uint32_t, at[part]))
#define BELOW(M) from_slot<VALUE_##M>(*--sp)
#define TOP(M) from_slot<VALUE_##M>(top)
#define RESULT_F32(x, sign, y) settle_nan<float>((x)sign(y), x, y)
#define RESULT_I32(x, sign, y) ((x)sign(y))
#define TO_VAR(M, part, value) \
  store<bytecode::MemType::M>(self + OPERAND(std::uint32_t, at[part]), to_slot(value))
// Through the Ref on top of the stack.
#define TO_REF(M, part, value)                                                                        \
  if (!within(top, size_of(bytecode::MemType::M), memory_size)) FAULT_IN(part, reference_fault(top)); \
  store<bytecode::MemType::M>(memory + top, to_slot(value));                                          \
  POP()
// AddrThis, a load of the index, Index: parts n to n + 2. The position counts from the lower bound.
#define POSITION(position, n, Type)                                                             \
  const std::uint32_t position = static_cast<std::uint32_t>(load<bytecode::MemType::Type>(      \
                                     self + OPERAND(std::uint32_t, at[(n) + 1]))) -             \
                                 OPERAND(std::uint32_t, at[(n) + 2]);                           \
  if (position > OPERAND(std::uint32_t, at[(n) + 2] + 4) - OPERAND(std::uint32_t, at[(n) + 2])) \
  FAULT_IN((n) + 2, TrapCode::IndexRange)
#define REF(n, position)                                             \
  static_cast<Slot>(self - memory) + OPERAND(std::uint32_t, at[n]) + \
      std::uint64_t{position} * OPERAND(std::uint32_t, at[(n) + 2] + 8)
// An element of four bytes in the instance.
#define PLACE(n, position) (self + OPERAND(std::uint32_t, at[n]) + std::size_t{position} * 4)
#define ELEMENT(M, n, position) from_slot<VALUE_##M>(load<bytecode::MemType::M>(PLACE(n, position)))

#define SUPER_BINARY(M, x_value, sign, y_value, use) \
  const VALUE_##M y = y_value;                       \
  const VALUE_##M x = x_value;                       \
  const VALUE_##M z = RESULT_##M(x, sign, y);        \
  use

#define SUPER_OPERANDS(op, M, sign)                                                \
  SUPER(Var##op, SUPER_BINARY(M, TOP(M), sign, VAR(M, 0), top = to_slot(z)))       \
  SUPER(Const##op, SUPER_BINARY(M, TOP(M), sign, CONST(M, 0), top = to_slot(z)))   \
  SUPER(VarVar##op, SUPER_BINARY(M, VAR(M, 0), sign, VAR(M, 1), PUSH(to_slot(z)))) \
  SUPER(VarConst##op, SUPER_BINARY(M, VAR(M, 0), sign, CONST(M, 1), PUSH(to_slot(z))))
#define SUPER_ASSIGN(op, M, sign)                                                             \
  SUPER(op##ToVar, SUPER_BINARY(M, BELOW(M), sign, TOP(M), TO_VAR(M, 1, z)); POP())           \
  SUPER(Var##op##ToVar, SUPER_BINARY(M, TOP(M), sign, VAR(M, 0), TO_VAR(M, 2, z)); POP())     \
  SUPER(Const##op##ToVar, SUPER_BINARY(M, TOP(M), sign, CONST(M, 0), TO_VAR(M, 2, z)); POP()) \
  SUPER(VarVar##op##ToVar, SUPER_BINARY(M, VAR(M, 0), sign, VAR(M, 1), TO_VAR(M, 3, z)))      \
  SUPER(VarConst##op##ToVar, SUPER_BINARY(M, VAR(M, 0), sign, CONST(M, 1), TO_VAR(M, 3, z)))
#define SUPER_REAL(op, sign)                                                                          \
  SUPER_OPERANDS(op, F32, sign)                                                                       \
  SUPER_ASSIGN(op, F32, sign)                                                                         \
  SUPER(op##ToRef, SUPER_BINARY(F32, BELOW(F32), sign, TOP(F32), POP()); TO_REF(F32, 1, z))           \
  SUPER(Var##op##ToRef, SUPER_BINARY(F32, TOP(F32), sign, VAR(F32, 0), POP()); TO_REF(F32, 2, z))     \
  SUPER(Const##op##ToRef, SUPER_BINARY(F32, TOP(F32), sign, CONST(F32, 0), POP()); TO_REF(F32, 2, z)) \
  SUPER(Element##op, POSITION(i, 0, I32);                                                             \
        SUPER_BINARY(F32, TOP(F32), sign, ELEMENT(F32, 0, i), top = to_slot(z)))                      \
  SUPER(ElementVar##op, POSITION(i, 0, I32);                                                          \
        SUPER_BINARY(F32, ELEMENT(F32, 0, i), sign, VAR(F32, 4), PUSH(to_slot(z))))                   \
  SUPER(Element##op##ToVar, POSITION(i, 0, I32);                                                      \
        SUPER_BINARY(F32, TOP(F32), sign, ELEMENT(F32, 0, i), TO_VAR(F32, 5, z)); POP())              \
  SUPER(RefVarVar##op, POSITION(i, 0, I32); PUSH(REF(0, i));                                          \
        SUPER_BINARY(F32, VAR(F32, 3), sign, VAR(F32, 4), PUSH(to_slot(z))))                          \
  SUPER(RefElementVar##op, POSITION(i, 0, I32); POSITION(k, 3, I32); PUSH(REF(0, i));                 \
        SUPER_BINARY(F32, ELEMENT(F32, 3, k), sign, VAR(F32, 7), PUSH(to_slot(z))))
// x op (variable * constant), stored.
#define SUPER_SCALED(op, sign)                                                       \
  SUPER(VarConstMulF32##op##ToVar,                                                   \
        SUPER_BINARY(F32, VAR(F32, 0), *, CONST(F32, 1), const float x0 = TOP(F32)); \
        TO_VAR(F32, 4, RESULT_F32(x0, sign, z)); POP())

#define SUPER_MULTIPLY_ADD(op, sign)                                                    \
  SUPER(VarVarConstMulF32##op##ToVar,                                                   \
        SUPER_BINARY(F32, VAR(F32, 1), *, CONST(F32, 2), const float x0 = VAR(F32, 0)); \
        TO_VAR(F32, 5, RESULT_F32(x0, sign, z)))

// The jump is part n.
#define ELSE(n, condition)                                                                   \
  if (!(condition)) {                                                                        \
    const auto distance = OPERAND(std::int32_t, at[n]);                                      \
    if (distance < 0) {                                                                      \
      const std::uint64_t cost = negate(static_cast<std::uint64_t>(std::int64_t{distance})); \
      CHARGE(cost, FAULT_IN(n, TrapCode::Watchdog));                                         \
    }                                                                                        \
    pc += distance;                                                                          \
  }
#define SIGNED(x) static_cast<std::int32_t>(x)
#define SUPER_COMPARE_I32(op, sign)                                              \
  SUPER(op##I32Else, const auto y = from_slot<std::int32_t>(top);                \
        const auto x = from_slot<std::int32_t>(*--sp); POP(); ELSE(1, x sign y)) \
  SUPER(VarConst##op##I32Else, ELSE(3, SIGNED(VAR(I32, 0)) sign SIGNED(CONST(I32, 1))))
// A counter's step and the test behind it.
#define SUPER_COUNT(op, sign)                                                                    \
  SUPER(Count##op##I32Else, SUPER_BINARY(I32, VAR(I32, 0), +, CONST(I32, 1), TO_VAR(I32, 3, z)); \
        ELSE(7, SIGNED(VAR(I32, 4)) sign SIGNED(CONST(I32, 5))))
// The end of a FOR loop: the test on the old value, the step, the jump back.
#define SUPER_NEXT(name, M)                                                                                  \
  SUPER(name, const auto x =                                                                                 \
                  from_slot<std::int32_t>(load<bytecode::MemType::M>(self + OPERAND(std::uint32_t, at[0]))); \
        const bool last = x > OPERAND(std::int32_t, at[1]);                                                  \
        const auto next =                                                                                    \
            from_slot<std::uint32_t>(load<bytecode::MemType::M>(self + OPERAND(std::uint32_t, at[3]))) +     \
            OPERAND(std::uint32_t, at[4]);                                                                   \
        store<bytecode::MemType::M>(self + OPERAND(std::uint32_t, at[6]), next); ELSE(7, last))

#define SUPER_HANDLERS                                                                                  \
  SUPER_REAL(AddF32, +)                                                                                 \
  SUPER_REAL(SubF32, -)                                                                                 \
  SUPER_REAL(MulF32, *)                                                                                 \
  SUPER_SCALED(AddF32, +)                                                                               \
  SUPER_SCALED(SubF32, -)                                                                               \
  SUPER_MULTIPLY_ADD(AddF32, +)                                                                         \
  SUPER_MULTIPLY_ADD(SubF32, -)                                                                         \
  SUPER(ElementVarMulF32ElementAddF32ToVar, POSITION(i, 0, I32); POSITION(k, 6, I32);                   \
        SUPER_BINARY(F32, ELEMENT(F32, 0, i), *, VAR(F32, 4), const float y0 = ELEMENT(F32, 6, k));     \
        TO_VAR(F32, 11, RESULT_F32(z, +, y0)))                                                          \
  SUPER_OPERANDS(AddI32, I32, +)                                                                        \
  SUPER_ASSIGN(AddI32, I32, +)                                                                          \
  SUPER_OPERANDS(SubI32, I32, -)                                                                        \
  SUPER_ASSIGN(SubI32, I32, -)                                                                          \
  SUPER_OPERANDS(MulI32, I32, *)                                                                        \
  SUPER(VarToVarF32, TO_VAR(F32, 1, VAR(I32, 0)))                                                       \
  SUPER(ConstToVarF32, TO_VAR(F32, 1, CONST(I32, 0)))                                                   \
  SUPER(ConstToVarI32, TO_VAR(I32, 1, CONST(I32, 0)))                                                   \
  SUPER(ElementRef, POSITION(i, 0, I32); PUSH(REF(0, i)))                                               \
  SUPER(ElementRefI16, POSITION(i, 0, I16); PUSH(REF(0, i)))                                            \
  SUPER(ElementF32, POSITION(i, 0, I32); PUSH(load<bytecode::MemType::F32>(PLACE(0, i))))               \
  SUPER(ElementI32, POSITION(i, 0, I32); PUSH(load<bytecode::MemType::I32>(PLACE(0, i))))               \
  SUPER(VarToElementF32, POSITION(i, 0, I32); store<bytecode::MemType::F32>(PLACE(0, i), VAR(I32, 3)))  \
  SUPER(BoolElse, ELSE(1, load<bytecode::MemType::Bool>(self + OPERAND(std::uint32_t, at[0])) != 0))    \
  SUPER(NotBoolElse, ELSE(1, load<bytecode::MemType::Bool>(self + OPERAND(std::uint32_t, at[0])) == 0)) \
  SUPER_COMPARE_I32(Eq, ==)                                                                             \
  SUPER_COMPARE_I32(Ne, !=)                                                                             \
  SUPER_COMPARE_I32(Lt, <)                                                                              \
  SUPER_COMPARE_I32(Le, <=)                                                                             \
  SUPER_COMPARE_I32(Gt, >)                                                                              \
  SUPER_COMPARE_I32(Ge, >=)                                                                             \
  SUPER(VarConstLtF32Else, ELSE(3, VAR(F32, 0) < CONST(F32, 1)))                                        \
  SUPER(VarConstGtF32Else, ELSE(3, VAR(F32, 0) > CONST(F32, 1)))                                        \
  SUPER_COUNT(Gt, >)                                                                                    \
  SUPER_COUNT(Ge, >=)                                                                                   \
  SUPER_NEXT(NextDint, I32)                                                                             \
  SUPER_NEXT(NextInt, I16)
