#include "tests/fuzz/st/st_writer.h"

namespace stepwright::st_fuzz {

namespace {

std::string type_text(const Type& type) {
  if (type.kind != TypeKind::Array) return type.name;
  std::string bounds;
  for (const Bounds& each : type.bounds)
    bounds += (bounds.empty() ? "" : ", ") + std::to_string(each.low) + ".." + std::to_string(each.high);
  return "ARRAY[" + bounds + "] OF " + type_text(*type.element);
}

class Writer {
 public:
  Writer(const Program& program, const Dropped& dropped) : program_(program), dropped_(dropped) {}

  std::string run() && {
    line("(* seed " + std::to_string(program_.seed) + " *)");
    out_ += program_.before;
    line("TYPE");
    for (const Type& each : program_.types) declare(each);
    line("END_TYPE");
    for (const Pou& each : program_.pous) pou(each);
    out_ += program_.configuration;
    return std::move(out_);
  }

 private:
  void line(const std::string& text) { out_ += std::string(2 * depth_, ' ') + text + "\n"; }

  void declare(const Type& type) {
    if (type.kind == TypeKind::Subrange)
      line("  " + type.name + " : " + st_name(type.scalar) + "(" + std::to_string(type.low) + ".." +
           std::to_string(type.high) + ") := " + std::to_string(type.low) + ";");
    if (type.kind == TypeKind::Enumeration) {
      std::string names;
      for (const std::string& each : type.enumerators)
        names += names.empty() ? each + " := " + std::to_string(type.low) : ", " + each;
      line("  " + type.name + " : " + st_name(type.scalar) + " (" + names + ");");
    }
    if (type.kind != TypeKind::Struct) return;
    line("  " + type.name + " : STRUCT");
    for (const Field& each : type.fields) line("    " + each.name + " : " + type_text(*each.type) + ";");
    line("  END_STRUCT;");
  }

  void variables(const Pou& pou, Section section, const std::string& keyword) {
    bool opened = false;
    for (const Variable& each : pou.variables) {
      if (each.section != section) continue;
      if (!opened) line(keyword);
      opened = true;
      const std::string location = each.location.empty() ? "" : " AT " + each.location;
      line("  " + each.name + location + " : " + type_text(*each.type) + ";");
    }
    if (opened) line("END_VAR");
  }

  void pou(const Pou& pou) {
    const char* keyword = pou.kind == PouKind::Function ? "FUNCTION"
                          : pou.kind == PouKind::Block  ? "FUNCTION_BLOCK"
                                                        : "PROGRAM";
    line(keyword + (" " + pou.name) + (pou.result != nullptr ? " : " + pou.result->name : ""));
    variables(pou, Section::Input, "VAR_INPUT");
    variables(pou, Section::Output, "VAR_OUTPUT");
    variables(pou, Section::InOut, "VAR_IN_OUT");
    variables(pou, Section::Local, "VAR");
    variables(pou, Section::Temp, "VAR_TEMP");
    out_ += pou.declarations + pou.chart;
    block(pou.body);
    for (const Action& each : pou.actions) {
      line("ACTION " + each.name + ":");
      block(each.body);
      line("END_ACTION");
    }
    line(std::string("END_") + keyword);
  }

  void block(const Statements& statements) {
    ++depth_;
    for (const Statement& each : statements)
      if (!dropped_.contains(each.id)) statement(each);
    --depth_;
  }

  std::string arguments(const Statement& call) {
    std::string out;
    for (const Argument& each : call.arguments) {
      const bool output = each.parameter->section == Section::Output;
      out += (out.empty() ? "" : ", ") + each.parameter->name + (output ? " => " : " := ") +
             (each.value ? st_expression(*each.value) : st_place(each.place));
    }
    return "(" + out + ");";
  }

  void statement(const Statement& each) {
    switch (each.kind) {
      case StatementKind::Assign:
        return line(st_place(each.target) + " := " + st_expression(*each.value) + ";");
      case StatementKind::Copy:
        return line(st_place(each.target) + " := " + st_place(each.source) + ";");
      case StatementKind::CallBlock:
        return line(st_place(each.target) + arguments(each));
      case StatementKind::CallFunction:
        return line(st_place(each.target) + " := " + each.callee->name + arguments(each));
      case StatementKind::If:
        return branches(each);
      case StatementKind::Case:
        return select(each);
      case StatementKind::For:
        line("FOR " + each.counter->name + " := " + st_expression(*each.value) + " TO " +
             st_expression(*each.limit) + (each.step ? " BY " + st_expression(*each.step) : "") + " DO");
        block(each.body);
        return line("END_FOR;");
      case StatementKind::While:
      case StatementKind::Repeat:
        return loop(each);
      case StatementKind::Exit:
        return line("EXIT;");
      case StatementKind::Continue:
        return line("CONTINUE;");
      case StatementKind::Return:
        return line("RETURN;");
      case StatementKind::Text:
        return line(each.text);
    }
  }

  void branches(const Statement& statement) {
    for (const Branch& each : statement.branches) {
      const char* keyword = &each == &statement.branches.front() ? "IF " : "ELSIF ";
      line(each.condition ? keyword + st_expression(*each.condition) + " THEN" : "ELSE");
      block(each.body);
    }
    line("END_IF;");
  }

  void select(const Statement& statement) {
    const Type& type = *statement.value->type;
    line("CASE " + st_expression(*statement.value) + " OF");
    for (const Branch& each : statement.branches) {
      std::string labels;
      for (const CaseLabel& label : each.labels) {
        labels += (labels.empty() ? "" : ", ") + st_literal(type, label.low);
        if (label.high != label.low) labels += ".." + st_literal(type, label.high);
      }
      line(each.labels.empty() ? "ELSE" : labels + ":");
      block(each.body);
    }
    line("END_CASE;");
  }

  void loop(const Statement& each) {
    const std::string& counter = each.counter->name;
    const std::string turns = std::to_string(each.turns);
    const bool is_while = each.kind == StatementKind::While;
    line(counter + " := 0;");
    line(is_while ? "WHILE (" + st_expression(*each.value) + ") AND " + counter + " < " + turns + " DO"
                  : "REPEAT");
    line("  " + counter + " := " + counter + " + 1;");
    block(each.body);
    if (!is_while) line("UNTIL (" + st_expression(*each.value) + ") OR " + counter + " >= " + turns);
    line(is_while ? "END_WHILE;" : "END_REPEAT;");
  }

  const Program& program_;
  const Dropped& dropped_;
  std::string out_;
  std::size_t depth_ = 0;
};

}  // namespace

std::string write_st(const Program& program, const Dropped& dropped) {
  return Writer(program, dropped).run();
}

}  // namespace stepwright::st_fuzz
