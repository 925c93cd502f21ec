#include <random>

#include "tests/bench/engines/workload.h"

namespace stepwright::bench {

namespace {

constexpr std::uint32_t kInputs = 128;

struct Rung {
  std::uint32_t a = 0, b = 0, c = 0;  // an input, or kInputs + the number of a rung above
};

std::vector<Rung> make_rungs(std::uint32_t count) {
  std::mt19937 random(7);
  std::vector<Rung> all(count);
  for (std::uint32_t k = 0; k < count; ++k) {
    const auto contact = [&] {
      const std::uint32_t above = k < 1000 ? k : 1000;  // machines have local logic
      if (above == 0 || random() % 2 == 0) return static_cast<std::uint32_t>(random() % kInputs);
      return static_cast<std::uint32_t>(kInputs + k - 1 - random() % above);
    };
    const std::uint32_t a = contact();
    const std::uint32_t b = contact();
    all[k] = {a, b, contact()};
  }
  return all;
}

std::string contact_name(std::uint32_t contact) {
  return contact < kInputs ? "x" + std::to_string(contact) : "q" + std::to_string(contact - kInputs);
}

std::string st_of(const std::vector<Rung>& all) {
  std::string text = "PROGRAM main\nVAR\n";
  for (std::uint32_t i = 0; i < kInputs; ++i) text += "  " + contact_name(i) + " : BOOL;\n";
  for (std::uint32_t k = 0; k < all.size(); ++k) text += "  " + contact_name(kInputs + k) + " : BOOL;\n";
  text += "END_VAR\n";
  for (std::uint32_t k = 0; k < all.size(); ++k) {
    text += contact_name(kInputs + k) + " := " + contact_name(all[k].a) + " AND NOT " +
            contact_name(all[k].b) + " OR " + contact_name(all[k].c) + ";\n";
  }
  return text + "END_PROGRAM\n";
}

// Rungs of one C function; more are split, as the time that gcc needs for a function grows faster than it.
constexpr std::size_t kChunk = 1000;

std::string c_frame(const std::string& variables, const std::string& body, const std::string& set,
                    const std::string& get, std::size_t coils) {
  return variables + "void set(const unsigned char *bools, const float *reals) {\n  (void)reals;\n" +
         "  for (int i = 0; i < " + std::to_string(kInputs) + "; ++i) " + set + "\n}\n" +
         "void scan(long long now_ns) {\n  (void)now_ns;\n" + body + "}\n" + "void get(double *results) {\n" +
         "  for (int i = 0; i < " + std::to_string(coils) + "; ++i) results[i] = " + get + ";\n}\n";
}

std::string place(std::uint32_t contact) {
  return contact < kInputs ? "x[" + std::to_string(contact) + "]"
                           : "q[" + std::to_string(contact - kInputs) + "]";
}

std::string hand_c(const std::vector<Rung>& all) {
  std::string functions;
  std::string body;
  const bool split = all.size() > kChunk;
  std::string& rungs = split ? functions : body;
  for (std::uint32_t k = 0; k < all.size(); ++k) {
    if (split && k % kChunk == 0) {
      const std::string name = "part" + std::to_string(k / kChunk) + "()";
      functions +=
          (k == 0 ? "" : "}\n") + std::string("static __attribute__((noinline)) void ") + name + " {\n";
      body += "  " + name + ";\n";
    }
    rungs += "  " + place(kInputs + k) + " = (" + place(all[k].a) + " & (" + place(all[k].b) + " ^ 1)) | " +
             place(all[k].c) + ";\n";
  }
  if (split) functions += "}\n";
  const std::string count = std::to_string(all.size());
  return c_frame("static unsigned char x[" + std::to_string(kInputs) + "], q[" + count + "];\n" + functions,
                 body, "x[i] = bools[i];", "q[i]", all.size());
}

// matiec has a field for each variable, not arrays; their layout in memory is the same.
std::string matiec_style_c(const std::vector<Rung>& all) {
  std::string body;
  for (std::uint32_t k = 0; k < all.size(); ++k) {
    body += "  SET(data->" + place(kInputs + k) + ", ((GET(data->" + place(all[k].a) + ") && !(GET(data->" +
            place(all[k].b) + "))) || GET(data->" + place(all[k].c) + ")));\n";
  }
  const std::string count = std::to_string(all.size());
  return c_frame(std::string(kMatiecStyle) + "typedef struct { VAR(BOOL) x[" + std::to_string(kInputs) +
                     "]; VAR(BOOL) q[" + count + "]; } MAIN;\nstatic MAIN instance;\n" +
                     "static MAIN *volatile where = &instance;\n",
                 "  MAIN *data = where;\n" + body, "instance.x[i].value = bools[i];", "instance.q[i].value",
                 all.size());
}

}  // namespace

Workload rungs(std::uint32_t count) {
  const std::vector<Rung> all = make_rungs(count);
  Workload out{"rungs", st_of(all), hand_c(all), matiec_style_c(all), {}, {}, {}};
  for (std::uint32_t i = 0; i < kInputs; ++i) out.bools.push_back("main." + contact_name(i));
  for (std::uint32_t k = 0; k < count; ++k) out.results.push_back("main." + contact_name(kInputs + k));
  return out;
}

}  // namespace stepwright::bench
