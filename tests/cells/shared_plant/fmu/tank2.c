/* A tank as an FMU for co-simulation, FMI 2.0: the functions that a master of ours calls, and no more
 * (https://fmi-standard.org). tests/cells/shared_plant/fmu_pack.py makes tank2.fmu of it and of tank2.xml. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define EXPORT __attribute__((visibility("default")))
enum { VALVE, DRAIN, LEVEL, FULL, AREA, LEAK, TRAP, VOLUME, STEPS, COUNT };
enum { OK = 0, DISCARD = 2, ERROR = 3 };

struct callbacks {
  void (*logger)(void *, const char *, int, const char *, const char *, ...);
  void *(*allocate)(size_t, size_t);
  void (*release)(void *);
  void (*finished)(void *, int);
  void *environment;
};
struct tank {
  double number[COUNT];
  struct callbacks call;
};

EXPORT void *fmi2Instantiate(const char *name, int kind, const char *guid, const char *resources,
                             const struct callbacks *call, int visible, int logging) {
  (void)name, (void)visible, (void)logging;
  if (kind != 1 || strcmp(guid, "{stepwright-tank-2}") != 0) return 0;
  if (strncmp(resources, "file:///", 8) != 0) return 0;
  struct tank *tank = call->allocate(1, sizeof *tank);
  tank->call = *call;
  tank->number[LEVEL] = 0.2;
  tank->number[AREA] = 0.5;
  return tank;
}
EXPORT void fmi2FreeInstance(void *tank) { ((struct tank *)tank)->call.release(tank); }
EXPORT int fmi2SetupExperiment(void *tank, int t, double tolerance, double start, int s, double stop) {
  (void)tank, (void)t, (void)tolerance, (void)start, (void)s, (void)stop;
  return OK;
}
EXPORT int fmi2EnterInitializationMode(void *tank) { (void)tank; return OK; }
EXPORT int fmi2ExitInitializationMode(void *tank) {
  struct tank *me = tank;
  if (me->number[AREA] > 0) return OK;
  me->call.logger(me->call.environment, "tank", ERROR, "logStatusError", "area is %g m2, which no tank has", me->number[AREA]);
  return ERROR;
}
EXPORT int fmi2Terminate(void *tank) { (void)tank; return OK; }

EXPORT int fmi2DoStep(void *instance, double time, double step, int no_earlier) {
  struct tank *tank = instance;
  double *n = tank->number;
  (void)time, (void)no_earlier;
  if (n[TRAP] == 1) abort();
  if (n[TRAP] == 2) pause();
  if (n[TRAP] == 3) {
    tank->call.logger(tank->call.environment, "tank", ERROR, "logStatusError", "the solver gave up at %g s", time);
    return ERROR;
  }
  if (n[TRAP] == 4) return DISCARD;
  n[LEVEL] += (0.01 * (n[VALVE] != 0) - 0.005 * (n[DRAIN] != 0) - n[LEAK]) / n[AREA] * step;
  if (n[LEVEL] < 0) n[LEVEL] = 0;
  if (n[LEVEL] > 2) n[LEVEL] = 2;
  n[FULL] = n[LEVEL] >= 1.9;
  n[VOLUME] = 1000 * n[AREA] * n[LEVEL];
  n[STEPS] += 1;
  return OK;
}

/* Kind 3: whether the step was discarded because the simulation has ended. */
EXPORT int fmi2GetBooleanStatus(void *tank, int kind, int *value) {
  *value = kind == 3 && ((struct tank *)tank)->number[TRAP] == 4;
  return OK;
}

#define ACCESS(NAME, TYPE)                                                                                   \
  EXPORT int fmi2Set##NAME(void *tank, const unsigned *vr, size_t count, const TYPE *value) {                \
    for (size_t i = 0; i < count; ++i) {                                                                     \
      if (vr[i] >= COUNT) return ERROR;                                                                      \
      ((struct tank *)tank)->number[vr[i]] = value[i];                                                       \
    }                                                                                                        \
    return OK;                                                                                               \
  }                                                                                                          \
  EXPORT int fmi2Get##NAME(void *tank, const unsigned *vr, size_t count, TYPE *value) {                      \
    for (size_t i = 0; i < count; ++i) {                                                                     \
      if (vr[i] >= COUNT) return ERROR;                                                                      \
      value[i] = (TYPE)((struct tank *)tank)->number[vr[i]];                                                 \
    }                                                                                                        \
    return OK;                                                                                               \
  }
ACCESS(Real, double)
ACCESS(Integer, int)
ACCESS(Boolean, int)
