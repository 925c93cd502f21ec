#include "tests/bench/engines/workload.h"

namespace stepwright::bench {

namespace {

constexpr int kBlocks = 100;

constexpr const char* kController = R"(FUNCTION_BLOCK CONTROLLER
VAR_INPUT PV, SP, KP, KI, KD, DT : REAL; END_VAR
VAR_OUTPUT OUT : REAL; END_VAR
VAR E, I, D, LAST : REAL; END_VAR
E := SP - PV;
I := I + E * KI * DT;
IF I > 100.0 THEN I := 100.0; ELSIF I < -100.0 THEN I := -100.0; END_IF;
D := D + ((E - LAST) / DT - D) * 0.25;
LAST := E;
OUT := KP * E + I + KD * D;
IF OUT > 100.0 THEN OUT := 100.0; ELSIF OUT < -100.0 THEN OUT := -100.0; END_IF;
END_FUNCTION_BLOCK
)";

// What all write into the program for each number.
std::string each(const char* pattern) {
  std::string text;
  for (int k = 0; k < kBlocks; ++k) {
    for (const char* c = pattern; *c != '\0'; ++c) {
      if (*c == '@') {
        text += std::to_string(k);
      } else {
        text += *c;
      }
    }
  }
  return text;
}

std::string st() {
  return std::string(kController) + "PROGRAM main\nVAR\n" +
         each(
             "  in@ : BOOL; pv@ : REAL; timer@ : TON; counter@ : CTU; control@ : CONTROLLER; lamp@ : "
             "BOOL;\n") +
         "END_VAR\n" +
         each(
             "timer@(IN := in@, PT := T#30ms);\n"
             "counter@(CU := in@, R := timer@.Q, PV := 3);\n"
             "control@(PV := pv@, SP := 50.0, KP := 2.0, KI := 0.5, KD := 0.125, DT := 0.0078125);\n"
             "lamp@ := timer@.Q OR counter@.Q;\n") +
         "END_PROGRAM\n";
}

constexpr const char* kHandStart = R"(
typedef struct { unsigned char in, q, m; long long pt, et, start; } Ton;
typedef struct { unsigned char cu, r, q, m; short pv, cv; } Ctu;
typedef struct { float pv, sp, kp, ki, kd, dt, out, e, i, d, last; } Pid;
static Ton timers[100];
static Ctu counters[100];
static Pid controls[100];
static unsigned char in[100], lamp[100];
static float pv[100];
static void ton(Ton *t, long long now) {
  if (t->in && !t->m) t->start = now;
  const long long run = now - t->start;
  t->q = t->in & (run >= t->pt);
  t->et = t->in ? (run < t->pt ? run : t->pt) : 0;
  t->m = t->in;
}
static void ctu(Ctu *c) {
  const short next = c->cv + (c->cu & (c->m ^ 1) & (c->cv < 32767));
  c->cv = c->r ? 0 : next;
  c->m = c->cu;
  c->q = c->cv >= c->pv;
}
static float limit(float x) { return x > 100.0f ? 100.0f : x < -100.0f ? -100.0f : x; }
static void pid(Pid *p) {
  p->e = p->sp - p->pv;
  p->i = limit(p->i + p->e * p->ki * p->dt);
  p->d = p->d + ((p->e - p->last) / p->dt - p->d) * 0.25f;
  p->last = p->e;
  p->out = limit(p->kp * p->e + p->i + p->kd * p->d);
}
void set(const unsigned char *bools, const float *reals) {
  for (int k = 0; k < 100; ++k) in[k] = bools[k], pv[k] = reals[k];
}
void get(double *results) {
  for (int k = 0; k < 100; ++k) {
    *results++ = lamp[k];
    *results++ = counters[k].cv;
    *results++ = controls[k].out;
  }
}
void scan(long long now) {
  for (int k = 0; k < 100; ++k) {
    timers[k].in = in[k], timers[k].pt = 30000000, ton(&timers[k], now);
    counters[k].cu = in[k], counters[k].r = timers[k].q, counters[k].pv = 3, ctu(&counters[k]);
    Pid *p = &controls[k];
    p->pv = pv[k], p->sp = 50, p->kp = 2, p->ki = 0.5f, p->kd = 0.125f, p->dt = 0.0078125f, pid(p);
    lamp[k] = timers[k].q | counters[k].q;
  }
}
)";

constexpr const char* kMatiecBlocks = R"(
typedef float REAL;
typedef short INT;
typedef long long TIME;
typedef struct { VAR(BOOL) in; VAR(TIME) pt; VAR(BOOL) q; VAR(TIME) et; VAR(BOOL) m; VAR(TIME) start; } TON;
typedef struct { VAR(BOOL) cu; VAR(BOOL) r; VAR(INT) pv; VAR(BOOL) q; VAR(INT) cv; VAR(BOOL) m; } CTU;
typedef struct {
  VAR(REAL) pv; VAR(REAL) sp; VAR(REAL) kp; VAR(REAL) ki; VAR(REAL) kd; VAR(REAL) dt;
  VAR(REAL) out; VAR(REAL) e; VAR(REAL) i; VAR(REAL) d; VAR(REAL) last;
} PID;
static TIME current_time;
static void TON_body(TON *data) {
  if (GET(data->in)) {
    if (!GET(data->m)) SET(data->start, current_time);
    SET(data->et, current_time - GET(data->start));
    SET(data->q, GET(data->et) >= GET(data->pt));
    if (GET(data->q)) SET(data->et, GET(data->pt));
  } else {
    SET(data->q, 0);
    SET(data->et, 0);
  }
  SET(data->m, GET(data->in));
}
static void CTU_body(CTU *data) {
  if (GET(data->r)) SET(data->cv, 0);
  else if (GET(data->cu) && !GET(data->m) && GET(data->cv) < 32767) SET(data->cv, GET(data->cv) + 1);
  SET(data->m, GET(data->cu));
  SET(data->q, GET(data->cv) >= GET(data->pv));
}
static void PID_body(PID *data) {
  SET(data->e, GET(data->sp) - GET(data->pv));
  SET(data->i, GET(data->i) + GET(data->e) * GET(data->ki) * GET(data->dt));
  if (GET(data->i) > 100.0) SET(data->i, 100.0);
  else if (GET(data->i) < -100.0) SET(data->i, -100.0);
  SET(data->d, GET(data->d) + ((GET(data->e) - GET(data->last)) / GET(data->dt) - GET(data->d)) * 0.25);
  SET(data->last, GET(data->e));
  SET(data->out, GET(data->kp) * GET(data->e) + GET(data->i) + GET(data->kd) * GET(data->d));
  if (GET(data->out) > 100.0) SET(data->out, 100.0);
  else if (GET(data->out) < -100.0) SET(data->out, -100.0);
}
)";

std::string matiec_style_c() {
  std::string text =
      kMatiecStyle + std::string(kMatiecBlocks) + "typedef struct {\n" +
      each("VAR(BOOL) in@; VAR(REAL) pv@; TON timer@; CTU counter@; PID control@; VAR(BOOL) lamp@;\n") +
      "} MAIN;\nstatic MAIN instance;\nstatic MAIN *volatile where = &instance;\n" +
      "void set(const unsigned char *bools, const float *reals) {\n" +
      each("instance.in@.value = bools[@]; instance.pv@.value = reals[@];\n") +
      "}\nvoid get(double *results) {\n" +
      each(
          "*results++ = instance.lamp@.value; *results++ = instance.counter@.cv.value;\n"
          "*results++ = instance.control@.out.value;\n");
  return text + "}\nvoid scan(long long now_ns) {\nMAIN *data = where;\ncurrent_time = now_ns;\n" +
         each(
             "SET(data->timer@.in, GET(data->in@)); SET(data->timer@.pt, 30000000); "
             "TON_body(&data->timer@);\n"
             "SET(data->counter@.cu, GET(data->in@)); SET(data->counter@.r, GET(data->timer@.q));\n"
             "SET(data->counter@.pv, 3); CTU_body(&data->counter@);\n"
             "SET(data->control@.pv, GET(data->pv@)); SET(data->control@.sp, 50.0);\n"
             "SET(data->control@.kp, 2.0); SET(data->control@.ki, 0.5); SET(data->control@.kd, 0.125);\n"
             "SET(data->control@.dt, 0.0078125); PID_body(&data->control@);\n"
             "SET(data->lamp@, GET(data->timer@.q) || GET(data->counter@.q));\n") +
         "}\n";
}

}  // namespace

Workload blocks() {
  Workload out{"blocks", st(), kHandStart, matiec_style_c(), {}, {}, {}};
  for (int k = 0; k < kBlocks; ++k) {
    const std::string number = std::to_string(k);
    out.bools.push_back("main.in" + number);
    out.reals.push_back("main.pv" + number);
    out.results.push_back("main.lamp" + number);
    out.results.push_back("main.counter" + number + ".CV");
    out.results.push_back("main.control" + number + ".OUT");
  }
  return out;
}

}  // namespace stepwright::bench
