#pragma once

// The handlers of Interpreter::run (interpreter.cpp), as macros: they expand to labels and code that use its
// variables (pc, sp, top, memory, self, budget_left, ...). Nothing else may include this file.

#define NEXT goto* handlers[static_cast<std::uint8_t>(*pc++)]
#define OPERAND(T, at) read_as<T>(pc + (at))
#define FUNCTION(index, member)                                           \
  read_as<decltype(bytecode::FunctionRecord::member)>(                    \
      functions + std::size_t{index} * sizeof(bytecode::FunctionRecord) + \
      offsetof(bytecode::FunctionRecord, member))
#define FAULT(trap_code)                                  \
  do {                                                    \
    fault = trap_code;                                    \
    pc -= 1; /* the opcode of the faulting instruction */ \
    goto trapped;                                         \
  } while (false)
// A handler reads its operands at pc and steps over them at its end.
#define DONE(op)                   \
  pc += operand_bytes(Opcode::op); \
  NEXT
// The top of the stack is in the variable `top`, everything below it in memory: sp is where `top` would lie.
#define PUSH(value)       \
  do {                    \
    const Slot v = value; \
    *sp++ = top;          \
    top = v;              \
  } while (false)
#define POP() top = *--sp
#define UNARY(op, T, expression)   \
  op_##op : {                      \
    const T x = from_slot<T>(top); \
    top = to_slot(expression);     \
    NEXT;                          \
  }
#define BINARY(op, T, expression)    \
  op_##op : {                        \
    const T y = from_slot<T>(top);   \
    const T x = from_slot<T>(*--sp); \
    top = to_slot(expression);       \
    NEXT;                            \
  }
#define DIVISION(op, T, expression)              \
  op_##op : {                                    \
    const T y = from_slot<T>(top);               \
    if (y == 0) FAULT(TrapCode::DivisionByZero); \
    const T x = from_slot<T>(*--sp);             \
    top = to_slot(expression);                   \
    NEXT;                                        \
  }
// A shift or rotation: the value below, an I32 count on top.
#define SHIFT(op, T, expression)                      \
  op_##op : {                                         \
    const auto count = from_slot<std::uint32_t>(top); \
    const T x = from_slot<T>(*--sp);                  \
    top = to_slot(expression);                        \
    DONE(op);                                         \
  }
#define TO_INTEGER(op, T, rounding)                                                             \
  op_##op : {                                                                                   \
    Slot whole = 0;                                                                             \
    const double x = rounding(static_cast<double>(from_slot<T>(top)));                          \
    if (!to_integer(x, OPERAND(bytecode::IntType, 0), whole)) FAULT(TrapCode::ConversionRange); \
    top = whole;                                                                                \
    DONE(op);                                                                                   \
  }
#define LOADS(M)                                                                          \
  op_Load##M##Abs : PUSH(load<bytecode::MemType::M>(memory + OPERAND(std::uint32_t, 0))); \
  DONE(Load##M##Abs);                                                                     \
  op_Load##M##This : PUSH(load<bytecode::MemType::M>(self + OPERAND(std::uint32_t, 0)));  \
  DONE(Load##M##This);                                                                    \
  op_Load##M##Ind : if (!within(top, size_of(bytecode::MemType::M), memory_size))         \
                        FAULT(reference_fault(top));                                      \
  top = load<bytecode::MemType::M>(memory + top);                                         \
  NEXT;
#define STORES(M)                                                                          \
  op_Store##M##Abs : store<bytecode::MemType::M>(memory + OPERAND(std::uint32_t, 0), top); \
  POP();                                                                                   \
  DONE(Store##M##Abs);                                                                     \
  op_Store##M##This : store<bytecode::MemType::M>(self + OPERAND(std::uint32_t, 0), top);  \
  POP();                                                                                   \
  DONE(Store##M##This);                                                                    \
  op_Store##M##Ind : if (!within(sp[-1], size_of(bytecode::MemType::M), memory_size))      \
                         FAULT(reference_fault(sp[-1]));                                   \
  store<bytecode::MemType::M>(memory + sp[-1], top);                                       \
  --sp;                                                                                    \
  POP();                                                                                   \
  NEXT;
// Takes the cost off the budget: off this slice of it, off the next one, or not at all.
#define CHARGE(cost, fault)                           \
  do {                                                \
    if (__builtin_expect((cost) > budget_left, 0)) {  \
      budget_left = slices.refill(budget_left, cost); \
      if ((cost) > budget_left) fault;                \
    }                                                 \
    budget_left -= (cost);                            \
  } while (false)
// A jump whose target lies behind it costs the distance, so that every loop ends.
#define JUMP(op, condition)                                                                    \
  {                                                                                            \
    const auto distance = OPERAND(std::int32_t, 0);                                            \
    if (condition) {                                                                           \
      if (distance < 0) {                                                                      \
        const std::uint64_t cost = negate(static_cast<std::uint64_t>(std::int64_t{distance})); \
        CHARGE(cost, FAULT(TrapCode::Watchdog));                                               \
      }                                                                                        \
      pc += distance;                                                                          \
    }                                                                                          \
    DONE(op);                                                                                  \
  }
#define COMPARISONS(op, sign)             \
  BINARY(op##I32, std::int32_t, x sign y) \
  BINARY(op##I64, std::int64_t, x sign y) \
  BINARY(op##F32, float, x sign y)        \
  BINARY(op##F64, double, x sign y)
#define ORDERED(op, sign)                  \
  COMPARISONS(op, sign)                    \
  BINARY(op##U32, std::uint32_t, x sign y) \
  BINARY(op##U64, std::uint64_t, x sign y)
#define ARITHMETIC(op, sign)                                \
  BINARY(op##I32, std::uint32_t, x sign y)                  \
  BINARY(op##I64, std::uint64_t, x sign y)                  \
  BINARY(op##F32, float, settle_nan<float>(x sign y, x, y)) \
  BINARY(op##F64, double, settle_nan<double>(x sign y, x, y))
#define BITWISE(op, sign)                   \
  BINARY(op##Bool, std::uint64_t, x sign y) \
  BINARY(op##I32, std::uint32_t, x sign y)  \
  BINARY(op##I64, std::uint64_t, x sign y)

// A boolean operation on the top of the stack and a BOOL in memory.
#define FUSED(op, base, expression)                                                   \
  op_##op : {                                                                         \
    const Slot y = load<bytecode::MemType::Bool>((base) + OPERAND(std::uint32_t, 0)); \
    expression;                                                                       \
    DONE(op);                                                                         \
  }
#define FUSED_BOOLEAN(op, expression) \
  FUSED(op##Abs, memory, expression)  \
  FUSED(op##This, self, expression)
// The same with two operands: a load and the operation behind it (x, y), or the operation (y) and a store of
// its result, or a load and a store (y).
#define FUSED_LOAD(op, base, expression)                                              \
  op_##op : {                                                                         \
    const Slot x = load<bytecode::MemType::Bool>((base) + OPERAND(std::uint32_t, 0)); \
    const Slot y = load<bytecode::MemType::Bool>((base) + OPERAND(std::uint32_t, 4)); \
    PUSH(expression);                                                                 \
    DONE(op);                                                                         \
  }
#define FUSED_STORE(op, base, expression)                                             \
  op_##op : {                                                                         \
    const Slot y = load<bytecode::MemType::Bool>((base) + OPERAND(std::uint32_t, 0)); \
    store<bytecode::MemType::Bool>((base) + OPERAND(std::uint32_t, 4), expression);   \
    POP();                                                                            \
    DONE(op);                                                                         \
  }
#define FUSED_MOVE(op, base, expression)                                              \
  op_##op : {                                                                         \
    const Slot y = load<bytecode::MemType::Bool>((base) + OPERAND(std::uint32_t, 0)); \
    store<bytecode::MemType::Bool>((base) + OPERAND(std::uint32_t, 4), expression);   \
    DONE(op);                                                                         \
  }
#define FUSED_PAIR(kind, op, expression) kind(op##Abs, memory, expression) kind(op##This, self, expression)
// The value stays if it lies within the bounds.
#define CHECK(op, T, lower, upper)                                  \
  op_##op : {                                                       \
    const T x = from_slot<T>(top);                                  \
    if (x < (lower) || x > (upper)) FAULT(TrapCode::SubrangeRange); \
    DONE(op);                                                       \
  }
#define CONSTANT(T, at) \
  from_slot<T>(read_as<Slot>(constants + std::size_t{OPERAND(std::uint32_t, at)} * sizeof(Slot)))
