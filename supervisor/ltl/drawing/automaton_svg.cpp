#include "supervisor/ltl/drawing/automaton_svg.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string_view>

#include "runtime/ground/markup/xml_text.h"
#include "supervisor/ltl/drawing/automaton_layout.h"
#include "supervisor/ltl/drawing/guard_text.h"

namespace stepwright::ltl {

namespace {

constexpr double kColumn = 210, kRow = 110, kMargin = 90, kRadius = 24;
constexpr std::size_t kLabel = 26, kTitle = 2'000;

constexpr const char* kStyle =
    "<style>text{font:12px "
    "system-ui,sans-serif;fill:#222;text-anchor:middle}.letters{paint-order:stroke;stroke:#fff;stroke-width:"
    "4}.page{fill:#fff}"
    ".state{fill:#eef3f8;stroke:#2f6fb5;stroke-width:1.5}.true{fill:#e3f3e6;stroke:#2c8a3f}"
    ".false{fill:#f7e4e2;stroke:#b3362b}.ring{fill:none}.edge{fill:none;stroke:#667}.head{fill:#667}"
    "@media(prefers-color-scheme:dark){text{fill:#e4e8eb}.letters{stroke:#16191c}.page{fill:#16191c}.state{"
    "fill:#1d2a38}"
    ".true{fill:#19301e}.false{fill:#3a1f1c}.edge{stroke:#99a}.head{fill:#99a}}</style>\n"
    "<defs><marker id=\"head\" viewBox=\"0 0 8 8\" refX=\"8\" refY=\"4\" markerWidth=\"8\" "
    "markerHeight=\"8\" "
    "orient=\"auto\"><path class=\"head\" d=\"M0 0L8 4L0 8z\"/></marker></defs>\n";

struct Point {
  double x = 0, y = 0;
};

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f", value);
  return text;
}

std::string at(Point point) {
  return number(point.x) + " " + number(point.y);
}

class Picture {
 public:
  explicit Picture(const Automaton& automaton) : automaton_(automaton) { place(); }

  std::string write() {
    text_ = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + number(width_) + "\" height=\"" +
            number(height_) + "\" viewBox=\"0 0 " + number(width_) + " " + number(height_) + "\">\n" +
            kStyle + "<rect class=\"page\" width=\"100%\" height=\"100%\"/>\n";
    const Point first = places_[automaton_.initial];
    line({{first.x - 2.2 * kRadius, first.y}, {first.x - kRadius, first.y}});
    for (std::uint32_t state = 0; state < automaton_.size(); ++state) edges(state);
    for (std::uint32_t state = 0; state < automaton_.size(); ++state) circle(state);
    return text_ + "</svg>\n";
  }

 private:
  // Every other column half a row lower: arrows that pass it lead between its states.
  void place() {
    AutomatonGraph graph{.after = std::vector<std::vector<std::uint32_t>>(automaton_.size()),
                         .decided = std::vector<std::uint8_t>(automaton_.size()),
                         .initial = automaton_.initial};
    for (std::uint32_t state = 0; state < automaton_.size(); ++state) {
      graph.decided[state] = static_cast<std::uint8_t>(automaton_.verdicts[state]);
      if (!decided(state)) automaton_.guards.collect(automaton_.edges[state], graph.after[state]);
    }
    for (const StatePlace& each : lay_out(graph)) {
      places_.push_back(
          {kMargin + kColumn * each.column, kMargin + kRow * (each.row + 0.5 * (each.column % 2))});
      width_ = std::max(width_, places_.back().x + kMargin);
      height_ = std::max(height_, places_.back().y + kMargin);
    }
  }

  bool decided(std::uint32_t state) const { return automaton_.verdicts[state] != Verdict::Undecided; }

  void edges(std::uint32_t from) {
    for (const auto& [to, letters] : guard_texts(automaton_, from, kTitle)) {
      if (decided(from)) continue;  // never left
      to == from ? loop(places_[from], letters) : arrow(places_[from], places_[to], letters);
    }
  }

  void loop(Point centre, const std::string& letters) {
    const Point left{centre.x - 10, centre.y - kRadius + 2}, right{centre.x + 10, centre.y - kRadius + 2};
    text_ += "<path class=\"edge\" marker-end=\"url(#head)\" d=\"M" + at(left) + "C" +
             at({left.x - 20, left.y - 36}) + " " + at({right.x + 20, right.y - 36}) + " " + at(right) +
             "\"/>\n";
    label({centre.x, centre.y - kRadius - 30}, letters);
  }

  // Bent to the left of its way, so that there and back are two.
  void arrow(Point from, Point to, const std::string& letters) {
    const double dx = to.x - from.x, dy = to.y - from.y, length = std::hypot(dx, dy);
    const Point along{dx / length, dy / length}, aside{along.y, -along.x};
    const bool above = std::abs(dx) < 1;  // past the states between
    const double bend = (above ? 0.4 : 0.12) * length + 10;
    const Point middle{(from.x + to.x) / 2 + bend * aside.x, (from.y + to.y) / 2 + bend * aside.y};
    const Point begin = towards(from, middle), end = towards(to, middle);
    text_ += "<path class=\"edge\" marker-end=\"url(#head)\" d=\"M" + at(begin) + "Q" + at(middle) + " " +
             at(end) + "\"/>\n";
    label({(begin.x + end.x) / 4 + middle.x / 2, (begin.y + end.y) / 4 + middle.y / 2 - 4}, letters);
  }

  static Point towards(Point from, Point to) {
    const double length = std::hypot(to.x - from.x, to.y - from.y);
    return {from.x + kRadius * (to.x - from.x) / length, from.y + kRadius * (to.y - from.y) / length};
  }

  void line(const std::vector<Point>& points) {
    text_ += "<path class=\"edge\" marker-end=\"url(#head)\" d=\"M" + at(points[0]) + "L" + at(points[1]) +
             "\"/>\n";
  }

  void label(Point where, const std::string& letters) {
    const std::string shown = letters.size() > kLabel ? letters.substr(0, kLabel) + "..." : letters;
    text_ += "<text class=\"letters\" x=\"" + number(where.x) + "\" y=\"" + number(where.y) + "\">" +
             markup::xml_escaped(shown) + "<title>" + markup::xml_escaped(letters) + "</title></text>\n";
  }

  void circle(std::uint32_t state) {
    const Point centre = places_[state];
    const bool good = automaton_.accepting(state), bad = automaton_.rejecting(state);
    const std::string kind = good ? " true" : bad ? " false" : "";
    const std::string place = "cx=\"" + number(centre.x) + "\" cy=\"" + number(centre.y) + "\"";
    text_ += "<circle class=\"state" + kind + "\" " + place + " r=\"" + number(kRadius) + "\"/>\n";
    if (good)
      text_ += "<circle class=\"state true ring\" " + place + " r=\"" + number(kRadius - 4) + "\"/>\n";
    if (bad) {
      const double far = 0.7 * kRadius;
      text_ += "<path class=\"state false ring\" d=\"M" + at({centre.x - far, centre.y - far}) + "L" +
               at({centre.x + far, centre.y + far}) + "\"/>\n";
    }
    text_ += "<text x=\"" + number(centre.x) + "\" y=\"" + number(centre.y + 4) + "\">" +
             std::to_string(state) + "</text>\n";
  }

  const Automaton& automaton_;
  std::vector<Point> places_;
  double width_ = 0, height_ = 0;
  std::string text_;
};

}  // namespace

result::Result<std::string> automaton_svg(const Automaton& automaton, std::size_t most_states) {
  if (automaton.size() > most_states) {
    return result::fail("L0032", {},
                        "the automaton has " + std::to_string(automaton.size()) +
                            " states; a picture has at most " + std::to_string(most_states),
                        "write it as HOA");
  }
  return Picture(automaton).write();
}

}  // namespace stepwright::ltl
