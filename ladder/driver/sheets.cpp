#include "ladder/driver/sheets.h"

#include <algorithm>
#include <utility>

#include "ladder/driver/declaration_text.h"
#include "ladder/driver/library.h"
#include "ladder/driver/project_scope.h"
#include "ladder/driver/text_sheets.h"
#include "ladder/lowering/diagram_to_chart.h"
#include "ladder/lowering/diagram_to_ladder.h"
#include "ladder/lowering/shown_ladder.h"
#include "ladder/source/codes.h"

namespace stepwright::driver {

namespace {

using graphic::Sheet;

const char* kind_word(graphic::PouKind kind) {
  return kind == graphic::PouKind::Program         ? "PROGRAM"
         : kind == graphic::PouKind::FunctionBlock ? "FUNCTION_BLOCK"
                                                   : "FUNCTION";
}

graphic::Listing whole_listing(const std::string& text) {
  return listing_of(text, 0, text.size());
}

// A text of a file is numbered as the file is, if its lines are lines of the file.
graphic::Listing file_listing(const graphic::SourceText& text, const std::string& file_text) {
  graphic::Listing listing = whole_listing(text.text);
  if (text.anchors.size() != 1) return listing;
  const auto end = file_text.begin() +
                   static_cast<std::ptrdiff_t>(std::min<std::size_t>(text.anchors[0].file, file_text.size()));
  listing.first_line += static_cast<std::uint32_t>(std::count(file_text.begin(), end, '\n'));
  return listing;
}

class ProjectSheets {
 public:
  ProjectSheets(const graphic::Project& project, const ProgramInterfaces& interfaces,
                syntax::SyntaxContext& context)
      : project_(project),
        interfaces_(interfaces),
        texts_(interfaces),
        context_(context),
        file_(context.sources.add(project.file_name.empty() ? "project" : project.file_name,
                                  project.file_text)) {}

  std::vector<Sheet> run() {
    const auto no_mark = [](std::uint32_t) { return std::string(); };
    add_text("TYPE", "", texts_.types(project_, no_mark));
    for (const graphic::Pou& pou : project_.pous) add(pou);
    add_globals();
    graphic::Project tasks = project_;
    tasks.globals.clear();
    for (graphic::Resource& each : tasks.resources) each.globals.clear();
    add_text("CONFIGURATION", project_.configuration, texts_.configuration(tasks, no_mark));
    for (Sheet& each : sheets_) each.file = context_.sources.name(file_);
    return std::move(sheets_);
  }

 private:
  void add_text(const char* kind, const std::string& name, const std::string& text) {
    if (text.empty()) return;
    Sheet& sheet = sheets_.emplace_back(Sheet{kind, name});
    sheet.body = whole_listing(text);
  }

  void add_globals() {
    Sheet sheet{"VAR_GLOBAL", ""};
    sheet.variables = project_.globals;
    for (const graphic::Resource& each : project_.resources)
      sheet.variables.insert(sheet.variables.end(), each.globals.begin(), each.globals.end());
    for (graphic::Variable& each : sheet.variables) each.section = graphic::VariableSection::Global;
    sheet.variables = texts_.quoted(std::move(sheet.variables));
    if (!sheet.variables.empty()) sheets_.push_back(std::move(sheet));
  }

  void add(const graphic::Pou& pou) {
    Sheet sheet{kind_word(pou.kind), pou.name};
    sheet.result_type = pou.result_type;
    sheet.comment = pou.comment;
    sheet.variables = texts_.quoted(pou.variables);
    if (const auto* text = std::get_if<graphic::StBody>(&pou.body)) sheet.body = whole_listing(text->text);
    if (const auto* ladder = std::get_if<graphic::LadderProgram>(&pou.body)) sheet.body = *ladder;
    if (const auto* chart = std::get_if<graphic::SfcChart>(&pou.body)) sheet.body = *chart;
    if (std::holds_alternative<graphic::DrawnBody>(pou.body)) draw(pou, sheet);
    if (const auto* chart = std::get_if<graphic::SfcChart>(&sheet.body)) {
      result::Diagnostics diagnostics = graphic::check(*chart);
      for (result::Diagnostic& each : diagnostics)
        if (each.where.file.empty()) each.where = context_.sources.location({file_, pou.where});
      context_.sink.add(std::move(diagnostics));
    }
    sheets_.push_back(std::move(sheet));
  }

  void draw(const graphic::Pou& pou, Sheet& sheet) {
    const auto& drawn = std::get<graphic::DrawnBody>(pou.body);
    if (drawn.body.language != graphic::BodyLanguage::Diagram) {
      sheet.body = file_listing(drawn.body.text, project_.file_text);
      return;
    }
    ProjectScope scope(pou, interfaces_, file_, context_);
    scope.hide_marks();
    if (drawn.body.diagram.language == graphic::DiagramLanguage::Chart) {
      sheet.body = lowering::shown_chart(drawn, scope);
    } else {
      sheet.body = lowering::shown_ladder(lowering::diagram_to_ladder(drawn.body.diagram, scope));
      if (drawn.body.diagram.language == graphic::DiagramLanguage::FunctionBlocks)
        sheet.drawn = drawn.body.diagram;
    }
  }

  const graphic::Project& project_;
  const ProgramInterfaces& interfaces_;
  DeclarationText texts_;
  syntax::SyntaxContext& context_;
  source::FileId file_;
  std::vector<Sheet> sheets_;
};

// Drawn blocks name their types in files that are not lexed: all of the library.
void add_library_interfaces(syntax::SyntaxContext& context, ProgramInterfaces& interfaces) {
  for (const LibraryDeclaration& each : library_declarations()) context.names.intern(each.name);
  syntax::Unit library;
  add_library(context, library);
  interfaces.add(library, context.names);
}

}  // namespace

result::Result<std::vector<Sheet>> sheets_of(const CompileInput& input) {
  source::SourceSet sources;
  source::NameTable names;
  syntax::intern_keywords(names);
  source::DiagnosticSink sink(sources);
  syntax::SyntaxContext context{sources, names, sink, input.dialect};
  ProgramInterfaces interfaces;
  const bool has_drawn = !input.projects.empty();  // they call what texts and library declare
  if (has_drawn) add_library_interfaces(context, interfaces);
  std::vector<Sheet> sheets;
  const auto append = [&sheets](std::vector<Sheet> more) {
    for (Sheet& each : more) sheets.push_back(std::move(each));
  };
  for (const source::NamedText& each : input.texts) {
    const source::FileId file = sources.add(each.name, each.text);
    syntax::Unit unit;
    syntax::parse_unit(context, file, unit);
    if (sink.has_errors()) continue;
    if (has_drawn) interfaces.add(unit, names);
    append(text_sheets(context, file, unit));
  }
  for (const graphic::Project* each : input.projects) interfaces.add(*each);
  for (const graphic::Project* each : input.projects) append(ProjectSheets(*each, interfaces, context).run());
  if (sink.has_errors()) return tl::unexpected(sink.take());
  return sheets;
}

}  // namespace stepwright::driver
