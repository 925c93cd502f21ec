#pragma once

// Binary decision diagrams, reduced and shared: equal functions are equal numbers. Variables are tested in
// the order of their levels, the smallest first. There is a bound on the nodes, and on the steps of one
// answer; beyond it every answer is false, and exhausted() says that none of them counts.
//
// Source: R. Bryant, Graph-Based Algorithms for Boolean Function Manipulation, IEEE Trans. Computers 35(8),
// 1986. Thread rule: one thread at a time.

#include <cstdint>
#include <optional>
#include <vector>

namespace stepwright::ltl {

class Diagram {
 public:
  using Node = std::uint32_t;
  static constexpr Node kFalse = 0;
  static constexpr Node kTrue = 1;
  static constexpr std::uint32_t kNoLevel = 0xFFFFFFFF;  // of the constants

  explicit Diagram(std::size_t most_nodes);

  Node variable(std::uint32_t level);
  Node negation(Node a) { return choose(a, kFalse, kTrue); }
  Node both(Node a, Node b) { return choose(a, b, kFalse); }
  Node either(Node a, Node b) { return choose(a, kTrue, b); }
  Node choose(Node condition, Node then, Node otherwise);

  // Requires a level above those of both parts. Numbers grow: parts have smaller ones than the whole.
  Node make(std::uint32_t level, Node low, Node high);

  std::uint32_t level(Node node) const { return nodes_[node].level; }
  Node low(Node node) const { return nodes_[node].low; }    // where the variable is false
  Node high(Node node) const { return nodes_[node].high; }  // where it is true

  std::size_t size() const { return nodes_.size(); }
  bool exhausted() const { return exhausted_; }

 private:
  struct Inner {
    std::uint32_t level = kNoLevel;
    Node low = 0, high = 0;
    bool operator==(const Inner&) const = default;
  };
  struct Question {
    Node condition = 0, otherwise = 0, then = 0;
    bool operator==(const Question&) const = default;
  };
  struct Open {
    Question question;
    std::uint32_t top = 0;
    std::optional<Node> low;  // the answer where the variable of `top` is false
  };
  struct Answer {
    Question asked;
    Node answer = kFalse;
  };

  // The answer that needs no look at parts, or that was given before; else the question as simple as it gets.
  std::optional<Node> at_once(Question& asked);
  void grow();
  std::size_t slot_of(const Inner& inner) const;
  Answer& answer_of(const Question& asked);
  Question part(const Question& of, std::uint32_t top, bool value) const;

  std::size_t most_;
  bool exhausted_ = false;
  std::vector<Inner> nodes_;
  std::vector<Node> slots_;      // of nodes by their hash; kFalse is a free one
  std::vector<Answer> answers_;  // by the hash of the question; a newer one takes the place of an older one
  std::vector<Open> open_;       // of choose()
};

}  // namespace stepwright::ltl
