#include "supervisor/ltl/mission/task_picture.h"

#include <algorithm>
#include <map>
#include <utility>

#include "supervisor/ltl/drawing/automaton_layout.h"
#include "supervisor/ltl/program/train_program.h"

namespace stepwright::ltl {
namespace {

using run::AutomatonPicture;

// Of each state those that letters lead to, with these.
using Edges = std::map<std::uint32_t, std::map<std::uint32_t, std::vector<Label>>>;

AutomatonPicture::Verdict drawn_verdict(Verdict verdict) {
  switch (verdict) {
    case Verdict::True:
      return AutomatonPicture::Verdict::Done;
    case Verdict::False:
      return AutomatonPicture::Verdict::Failed;
    default:
      return AutomatonPicture::Verdict::Undecided;
  }
}

std::vector<std::string> names_in(Label label, const std::vector<std::string>& places) {
  std::vector<std::string> names;
  for (std::size_t k = 0; k < places.size(); ++k)
    if ((label >> k & 1) != 0) names.push_back(places[k]);
  return names;
}

class TaskPicture {
 public:
  explicit TaskPicture(const TaskPictureInput& input) : input_(input), monitor_(input.task->monitor) {}

  AutomatonPicture make() {
    picture_.id = "task";
    picture_.text = input_.task->text;
    picture_.initial = input_.task->begins();
    follow_plan();
    explore();
    if (edges_.size() > kMostDrawnStates) keep_planned();
    draw();
    return std::move(picture_);
  }

 private:
  void follow_plan() {
    if (!input_.begins) return;
    picture_.planned = {*input_.begins};
    for (const WayLabel& read : input_.planned) {
      const std::uint32_t next = monitor_.next(picture_.planned.back(), read.label);
      if (next != picture_.planned.back()) picture_.planned.push_back(next);
    }
  }

  void explore() {
    std::vector<Label> letters = input_.letters;
    for (const WayLabel& read : input_.planned) letters.push_back(read.label);
    std::ranges::sort(letters);
    letters.erase(std::ranges::unique(letters).begin(), letters.end());
    std::vector<std::uint32_t> open = {picture_.initial};
    for (const std::uint32_t state : picture_.planned) open.push_back(state);
    while (!open.empty()) {
      const std::uint32_t from = open.back();
      open.pop_back();
      if (edges_.contains(from)) continue;
      auto& after = edges_[from];
      if (monitor_.verdicts[from] != Verdict::Undecided) continue;  // never left
      for (const Label letter : letters) {
        const std::uint32_t to = monitor_.next(from, letter);
        if (to == from) continue;
        after[to].push_back(letter);
        open.push_back(to);
      }
    }
  }

  void keep_planned() {
    const auto is_planned = [&](std::uint32_t state) {
      return state == picture_.initial ||
             std::ranges::find(picture_.planned, state) != picture_.planned.end();
    };
    picture_.left_out = edges_.size();
    std::erase_if(edges_, [&](const auto& each) { return !is_planned(each.first); });
    for (auto& [from, after] : edges_)
      std::erase_if(after, [&](const auto& each) { return !is_planned(each.first); });
    picture_.left_out -= edges_.size();
  }

  void draw() {
    std::vector<std::uint32_t> states;  // in the order of the picture
    std::map<std::uint32_t, std::uint32_t> number;
    for (const auto& [state, after] : edges_) {
      number[state] = static_cast<std::uint32_t>(states.size());
      states.push_back(state);
    }
    AutomatonGraph graph{.after = std::vector<std::vector<std::uint32_t>>(states.size()),
                         .decided = std::vector<std::uint8_t>(states.size()),
                         .initial = number.at(picture_.initial)};
    for (const std::uint32_t state : picture_.planned) graph.first_row.push_back(number.at(state));
    for (const auto& [from, after] : edges_) {
      graph.decided[number.at(from)] = static_cast<std::uint8_t>(monitor_.verdicts[from]);
      for (const auto& [to, letters] : after) {
        graph.after[number.at(from)].push_back(number.at(to));
        AutomatonPicture::Edge edge{.from = from, .to = to};
        for (const Label letter : letters) edge.letters.push_back(names_in(letter, input_.places));
        picture_.edges.push_back(std::move(edge));
      }
    }
    const std::vector<StatePlace> places = lay_out(graph);
    const auto left = edges_left();
    for (std::size_t k = 0; k < states.size(); ++k) {
      AutomatonPicture::State state{.state = states[k],
                                    .column = places[k].column,
                                    .row = static_cast<double>(places[k].row),
                                    .verdict = drawn_verdict(monitor_.verdicts[states[k]])};
      if (const auto found = left.find(states[k]); found != left.end()) state.left = found->second;
      picture_.states.push_back(state);
    }
  }

  // Edges from each state to the nearest one that is done; states without a way there are missing.
  std::map<std::uint32_t, std::uint32_t> edges_left() const {
    std::map<std::uint32_t, std::uint32_t> left;
    for (const auto& [state, after] : edges_)
      if (monitor_.accepting(state)) left[state] = 0;
    for (std::uint32_t distance = 1; distance <= edges_.size(); ++distance) {
      std::vector<std::uint32_t> found;
      for (const auto& [state, after] : edges_) {
        if (left.contains(state)) continue;
        const bool near = std::ranges::any_of(after, [&](const auto& each) {
          const auto behind = left.find(each.first);
          return behind != left.end() && behind->second + 1 == distance;
        });
        if (near) found.push_back(state);
      }
      if (found.empty()) break;
      for (const std::uint32_t state : found) left[state] = distance;
    }
    return left;
  }

  const TaskPictureInput& input_;
  const Automaton& monitor_;
  Edges edges_;
  AutomatonPicture picture_;
};

}  // namespace

run::AutomatonPicture task_picture(const TaskPictureInput& input) {
  return TaskPicture(input).make();
}

}  // namespace stepwright::ltl
