#include "tests/fuzz/st/c_writer.h"

#include "tests/fuzz/st/c_expression.h"

namespace stepwright::st_fuzz {

namespace {

void add_leaves(const std::string& path, const std::string& text, const Type& type, std::vector<Leaf>& out);

void add_elements(const std::string& path, const std::string& text, const Type& type, std::size_t dimension,
                  std::int64_t flat, std::vector<Leaf>& out) {
  if (dimension == type.bounds.size())
    return add_leaves(path, text + ".at[" + std::to_string(flat) + "]", *type.element, out);
  const Bounds& bounds = type.bounds[dimension];
  for (std::int64_t i = bounds.low; i <= bounds.high; ++i)
    add_elements(path + "[" + std::to_string(i) + "]", text, type, dimension + 1,
                 flat * bounds.count() + i - bounds.low, out);
}

void add_leaves(const std::string& path, const std::string& text, const Type& type, std::vector<Leaf>& out) {
  switch (type.kind) {
    case TypeKind::Array:
      return add_elements(path, text, type, 0, 0, out);
    case TypeKind::Struct:
      for (const Field& each : type.fields)
        add_leaves(path + "." + each.name, text + "." + each.name, *each.type, out);
      return;
    case TypeKind::Block:
      for (const Variable& each : type.block->variables)
        if (each.section != Section::InOut && each.section != Section::Temp)
          add_leaves(path + "." + each.name, text + "." + each.name, *each.type, out);
      return;
    default:
      out.push_back({path, text, &type});
  }
}

std::string initial(const Type& type) {
  const bool starts_elsewhere = type.kind == TypeKind::Subrange || type.kind == TypeKind::Enumeration;
  return std::to_string(starts_elsewhere ? type.low : 0);
}

class Writer {
 public:
  Writer(const Program& program, const Dropped& dropped, std::string prefix, std::string& out)
      : program_(program), dropped_(dropped), prefix_(prefix), e_(std::move(prefix), out) {}

  void run() {
    for (const Type& each : program_.types) declare(each);
    for (const Pou& each : program_.pous) pou(each);
    host();
  }

 private:
  void line(const std::string& text) { e_.line(text); }

  void declare(const Type& type) {
    if (type.is_scalar()) return;
    line("typedef struct {");
    if (type.kind == TypeKind::Array) {
      std::int64_t count = 1;
      for (const Bounds& each : type.bounds) count *= each.count();
      line(e_.type_name(*type.element) + " at[" + std::to_string(count) + "];");
    }
    for (const Field& each : type.fields) line(e_.type_name(*each.type) + " " + each.name + ";");
    if (type.block != nullptr) members(*type.block);
    line("} " + e_.type_name(type) + ";");
  }

  void members(const Pou& pou) {
    for (const Variable& each : pou.variables)
      if (each.section != Section::Temp)
        line(e_.type_name(*each.type) + (each.section == Section::InOut ? "* " : " ") + each.name + ";");
  }

  // Sets every scalar in it to its initial value.
  void start(const std::string& name, const Type& type) {
    std::vector<Leaf> leaves;
    add_leaves("", name, type, leaves);
    for (const Leaf& each : leaves) line(each.expression + " = " + initial(*each.type) + ";");
  }

  void pou(const Pou& pou) {
    e_.enter(pou);
    if (pou.kind == PouKind::Program) {
      line("typedef struct {");
      members(pou);
      line("} " + prefix_ + "state;");
    }
    if (pou.kind == PouKind::Function) {
      function_head(pou);
    } else {
      line("static void " + prefix_ + "run_" + pou.name + "(" + prefix_ +
           (pou.kind == PouKind::Program ? "state" : pou.name) + "* self) {");
      for (const Variable& each : pou.variables)
        if (each.section == Section::Temp) local(each);
    }
    block(pou.body);
    line("leave:;");
    if (pou.result != nullptr) line("return " + pou.name + ";");
    line("}");
  }

  void local(const Variable& each) {
    line(e_.type_name(*each.type) + " " + each.name + ";");
    start(each.name, *each.type);
  }

  void function_head(const Pou& pou) {
    std::string parameters;
    for (const Variable& each : pou.variables) {
      const bool by_reference = each.section == Section::InOut || each.section == Section::Output;
      if (!by_reference && each.section != Section::Input) continue;
      parameters += (parameters.empty() ? "" : ", ") + e_.type_name(*each.type) +
                    (by_reference ? "* " : " ") + each.name;
    }
    line("static " + e_.type_name(*pou.result) + " " + prefix_ + pou.name + "(" + parameters + ") {");
    for (const Variable& each : pou.variables) {
      if (each.section == Section::Local || each.section == Section::Result) local(each);
      if (each.section == Section::Output) line("*" + each.name + " = " + initial(*each.type) + ";");
    }
  }

  void block(const Statements& statements) {
    for (const Statement& each : statements) {
      if (dropped_.contains(each.id)) continue;
      line("{");
      statement(each);
      line("}");
    }
  }

  void statement(const Statement& each) {
    switch (each.kind) {
      case StatementKind::Assign: {
        const std::string target = e_.place(each.target);
        return e_.store(*each.target.type, each.target.bit, target, e_.value(*each.value));
      }
      case StatementKind::Copy: {
        const std::string target = e_.place(each.target);
        return line(target + " = " + e_.place(each.source) + ";");
      }
      case StatementKind::CallBlock:
        return call_block(each);
      case StatementKind::CallFunction:
        return call_function(each);
      case StatementKind::If:
        return branches(each);
      case StatementKind::Case:
        return select(each);
      case StatementKind::For:
        return count(each);
      case StatementKind::While:
      case StatementKind::Repeat:
        return loop(each);
      case StatementKind::Exit:
        return line("goto exit" + std::to_string(loops_.back()) + ";");
      case StatementKind::Continue:
        return line("goto next" + std::to_string(loops_.back()) + ";");
      case StatementKind::Return:
        return line("goto leave;");
      case StatementKind::Text:
        return;  // programs for C have none
    }
  }

  void call_block(const Statement& each) {
    const Pou& callee = *each.target.type->block;
    for (const Argument& argument : each.arguments) {
      const std::string parameter = "." + argument.parameter->name;
      if (argument.parameter->section == Section::Output) continue;
      const std::string instance = e_.place(each.target);
      if (argument.value) {
        e_.store(*argument.parameter->type, -1, instance + parameter, e_.value(*argument.value));
      } else {
        line(instance + parameter + " = &" + e_.place(argument.place) + ";");
      }
    }
    line(prefix_ + "run_" + callee.name + "(&" + e_.place(each.target) + ");");
    for (const Argument& argument : each.arguments) {
      if (argument.parameter->section != Section::Output) continue;
      const std::string target = e_.place(argument.place);
      line(target + " = " + e_.place(each.target) + "." + argument.parameter->name + ";");
    }
  }

  void call_function(const Statement& each) {
    std::string arguments;
    std::string after;
    for (const Argument& argument : each.arguments) {
      const Type& type = *argument.parameter->type;
      std::string text = e_.fresh();
      if (argument.value) {
        line(e_.type_name(type) + " " + text + ";");
        e_.store(type, -1, text, e_.value(*argument.value));
      } else if (argument.parameter->section == Section::InOut) {
        text = "&" + e_.place(argument.place);
      } else {
        line(e_.type_name(type) + " " + text + ";");
        after += e_.place(argument.place) + " = " + text + ";\n";
        text = "&" + text;
      }
      arguments += (arguments.empty() ? "" : ", ") + text;
    }
    const std::string result =
        e_.keep(e_.type_name(*each.callee->result), prefix_ + each.callee->name + "(" + arguments + ")");
    line(after + e_.place(each.target) + " = " + result + ";");
  }

  void branches(const Statement& statement) {
    for (const Branch& each : statement.branches) {
      line("if (" + (each.condition ? e_.value(*each.condition) : "1") + ") {");
      block(each.body);
      line("} else {");
    }
    for (std::size_t i = 0; i < statement.branches.size(); ++i) line("}");
  }

  void select(const Statement& statement) {
    const std::string selector = e_.value(*statement.value);
    const std::string type = c_name(statement.value->type->scalar);
    for (const Branch& each : statement.branches) {
      std::string test;
      for (const CaseLabel& label : each.labels) {
        const auto bound = [&](std::uint64_t bits) {
          return "(" + type + ")" + std::to_string(bits) + "ull";
        };
        test += (test.empty() ? "" : " || ") + ("(" + selector + " >= " + bound(label.low)) + " && " +
                selector + " <= " + bound(label.high) + ")";
      }
      line("if (" + (each.labels.empty() ? "1" : test) + ") {");
      block(each.body);
      line("} else {");
    }
    for (std::size_t i = 0; i < statement.branches.size(); ++i) line("}");
  }

  void loop_body(const Statement& each, int number) {
    loops_.push_back(number);
    block(each.body);
    loops_.pop_back();
    line("next" + std::to_string(number) + ":;");
  }

  // In 128 bits nothing wraps.
  void count(const Statement& each) {
    const int number = ++loop_count_;
    const std::string counter = e_.variable(*each.counter);
    const std::string type = e_.type_name(*each.counter->type);
    line(counter + " = " + e_.value(*each.value) + ";");
    const std::string limit = e_.value(*each.limit);
    const std::string step = each.step ? e_.value(*each.step) : e_.keep(type, "1");
    const std::string at = e_.keep("__int128", counter);
    line("while (" + step + " >= 0 ? " + at + " <= " + limit + " : " + at + " >= " + limit + ") {");
    loop_body(each, number);
    line(at + " = (__int128)" + counter + " + " + step + ";\n" + counter + " = (" + type + ")" + at + ";\n}");
    line("exit" + std::to_string(number) + ":;");
  }

  void loop(const Statement& each) {
    const int number = ++loop_count_;
    const std::string counter = e_.variable(*each.counter);
    const std::string turns = std::to_string(each.turns);
    line(counter + " = 0;\nfor (;;) {");
    if (each.kind == StatementKind::While)
      line("if (!(" + e_.value(*each.value) + " & (" + counter + " < " + turns + "))) break;");
    line(counter + " += 1;");
    loop_body(each, number);
    if (each.kind == StatementKind::Repeat)
      line("if (" + e_.value(*each.value) + " | (" + counter + " >= " + turns + ")) break;");
    line("}\nexit" + std::to_string(number) + ":;");
  }

  void host() {
    const std::string instance = prefix_ + "instance";
    line("static " + prefix_ + "state " + instance + ";");
    line("static void " + prefix_ + "init(void) {");
    const std::vector<Leaf> leaves = leaves_of(program_);
    for (const Leaf& each : leaves) line(instance + each.expression + " = " + initial(*each.type) + ";");
    line("}\nstatic int " + prefix_ + "scan(void) {\nconst int code = setjmp(trapped);");
    line("if (code == 0) " + prefix_ + "run_main(&" + instance + ");\nreturn code;\n}");
    line("static const struct leaf " + prefix_ + "leaves[] = {");
    for (const Leaf& each : leaves) {
      const std::string name = instance + each.expression;
      line("{&" + name + ", sizeof(" + name + ")},");
    }
    line("};");
  }

  const Program& program_;
  const Dropped& dropped_;
  std::string prefix_;
  CExpressions e_;
  std::vector<int> loops_;
  int loop_count_ = 0;
};

}  // namespace

std::vector<Leaf> leaves_of(const Program& program) {
  std::vector<Leaf> out;
  for (const Variable& each : program.main().variables)
    add_leaves("main." + each.name, "." + each.name, *each.type, out);
  return out;
}

std::string write_c(std::span<const Program* const> programs, const Dropped& dropped) {
  std::string out = "#include \"meaning.h\"\n";
  std::string table = "const struct program programs[] = {\n";
  for (std::size_t i = 0; i < programs.size(); ++i) {
    const std::string prefix = "p" + std::to_string(i) + "_";
    Writer(*programs[i], dropped, prefix, out).run();
    table += "{" + prefix + "init, " + prefix + "scan, " + prefix + "leaves, sizeof(" + prefix +
             "leaves) / sizeof(" + prefix + "leaves[0])},\n";
  }
  return out + table + "};\n";
}

}  // namespace stepwright::st_fuzz
