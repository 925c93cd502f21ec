#pragma once

// The tasks of E. Plaku, Planning Robot Motions to Satisfy Linear Temporal Logic, Geometric, and Differential
// Constraints, AAAI 2012 workshop, section 2.5, for n propositions p1 ... pn.

#include <string>

namespace stepwright::ltl::test {

inline std::string region(int k) {
  return "p" + std::to_string(k);
}

// phi1: p1 ... pn in succession, and none of them out of turn.
inline std::string in_succession(int n) {
  std::string none = "(";
  for (int k = 1; k <= n; ++k) none += (k > 1 ? " & !" : "!") + region(k);
  none += ")";
  std::string text = region(n);
  for (int k = n - 1; k >= 1; --k)
    text = region(k) + " & ((" + region(k) + " | " + none + ") U (" + text + "))";
  return none + " U (" + text + ")";
}

// phi2: five visits i, j, k, i, j with different i, j, k. As it is printed the visits are not in each other,
// which leaves any three; nested they are in order.
inline std::string five_visits(int n, bool nested) {
  std::string text;
  for (int i = 1; i <= n; ++i)
    for (int j = 1; j <= n; ++j)
      for (int k = 1; k <= n; ++k) {
        if (i == j || j == k || i == k) continue;
        const std::string a = region(i), b = region(j), c = region(k);
        if (!text.empty()) text += " | ";
        text += nested ? "F(" + a + " & F(" + b + " & F(" + c + " & F(" + a + " & F " + b + "))))"
                       : "(F " + a + " & (F " + b + " & (F " + c + " & (F " + a + " & F " + b + "))))";
      }
  return text;
}

// phi3: each of them, in any order.
inline std::string coverage(int n) {
  std::string text;
  for (int k = 1; k <= n; ++k) text += (k > 1 ? " & F " : "F ") + region(k);
  return text;
}

}  // namespace stepwright::ltl::test
