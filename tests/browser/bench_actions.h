#pragma once

// The script itself: a plan of the bench, when each action runs and what it does to the plant.

#include <array>
#include <string_view>
#include <vector>

namespace stepwright::browser {

enum class Effect { Load, Unload, Order, Move };

struct ScriptedAction {
  std::string_view text;
  std::string_view step;
  double planned_start_s;
  double planned_finish_s;
  double start_s;
  double finish_s;
  Effect effect;
  int place;               // -1 a1, 0 f1, +1 a2; of a move: where it ends
  double percent;          // moved liquid
  std::vector<int> after;  // actions that it waits for; none = the start
};

inline const std::vector<ScriptedAction>& scripted_actions() {
  static const std::vector<ScriptedAction> kActions = {
      {"(load v1 f1 level8)", "S01_LOAD", 0, 8, 1.0, 9.4, Effect::Load, 0, 80, {}},
      {"(move v1 f1 a1)", "S02_MOVE", 8, 12, 9.4, 13.1, Effect::Move, -1, 0, {0}},
      {"(unload v1 a1 level8)", "S03_UNLOAD", 12, 20, 13.1, 21.6, Effect::Unload, -1, 80, {1}},
      {"(complete_order a1 c1 level7)", "S04_COMPLETE", 20, 34, 21.6, 36.2, Effect::Order, -1, 70, {2}},
      {"(move v1 a1 f1)", "S05_MOVE", 20, 24, 21.6, 25.3, Effect::Move, 0, 0, {2}},
      {"(load v1 f1 level8)", "S06_LOAD", 24, 32, 25.3, 33.8, Effect::Load, 0, 80, {4}},
      {"(move v1 f1 a2)", "S07_MOVE", 32, 36, 33.8, 37.5, Effect::Move, 1, 0, {5}},
      {"(unload v1 a2 level8)", "S08_UNLOAD", 36, 44, 37.5, 46.0, Effect::Unload, 1, 80, {6}},
      {"(partial_order a2 c2 level8)", "S09_PARTIAL", 44, 60, 46.0, 62.6, Effect::Order, 1, 80, {7}},
      {"(move v1 a2 f1)", "S10_MOVE", 44, 48, 46.0, 49.7, Effect::Move, 0, 0, {7}},
      {"(load v1 f1 level8)", "S11_LOAD", 48, 56, 49.7, 58.2, Effect::Load, 0, 80, {9}},
      {"(move v1 f1 a2)", "S12_MOVE", 56, 60, 58.2, 61.9, Effect::Move, 1, 0, {10}},
      {"(unload v1 a2 level5)", "S13_UNLOAD", 60, 65, 62.6, 68.0, Effect::Unload, 1, 50, {8, 11}},
      {"(final_order a2 c2 level2)", "S14_FINAL", 65, 69, 68.0, 72.3, Effect::Order, 1, 20, {12}},
      {"(move v1 a2 a1)", "S15_MOVE", 65, 72, 68.0, 75.2, Effect::Move, -1, 0, {12}},
      {"(unload v1 a1 level2)", "S16_UNLOAD", 72, 74, 75.2, 77.5, Effect::Unload, -1, 20, {3, 14}},
      {"(move v1 a1 f1)", "S17_MOVE", 74, 78, 77.5, 81.2, Effect::Move, 0, 0, {15}},
  };
  return kActions;
}

}  // namespace stepwright::browser
