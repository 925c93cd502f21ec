/* A tank as an FMU for co-simulation, FMI 3.0: the functions that a master of ours calls, and no more
 * (https://fmi-standard.org). tests/cells/shared_plant/fmu_pack.py makes tank3.fmu of it and of tank3.xml. */
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "fmi3.h"

enum { VALVE, DRAIN, LEVEL, FULL, AREA, LEAK, TRAP, VOLUME, STEPS, COUNT };

typedef void (*log_message)(void *, int, const char *, const char *);
struct tank {
  double number[COUNT];
  log_message log;
  void *environment;
};

EXPORT void *fmi3InstantiateCoSimulation(const char *name, const char *token, const char *resources,
                                         bool visible, bool logging, bool events, bool early,
                                         const uint32_t *required, size_t count, void *environment,
                                         log_message log, void *update) {
  (void)name, (void)visible, (void)logging, (void)events, (void)early, (void)required, (void)count, (void)update;
  if (strcmp(token, "{stepwright-tank-3}") != 0) return 0;
  if (resources[0] != '/' || resources[strlen(resources) - 1] != '/') return 0;
  struct tank *tank = calloc(1, sizeof *tank);
  tank->number[LEVEL] = 0.2;
  tank->number[AREA] = 0.5;
  tank->log = log;
  tank->environment = environment;
  return tank;
}
EXPORT void fmi3FreeInstance(void *tank) { free(tank); }
EXPORT int fmi3EnterInitializationMode(void *tank, bool t, double tolerance, double start, bool s, double stop) {
  (void)tank, (void)t, (void)tolerance, (void)start, (void)s, (void)stop;
  return OK;
}
EXPORT int fmi3ExitInitializationMode(void *instance) {
  struct tank *tank = instance;
  if (tank->number[AREA] > 0) return OK;
  tank->log(tank->environment, ERROR, "logStatusError", "no tank has such an area");
  return ERROR;
}
EXPORT int fmi3Terminate(void *tank) { (void)tank; return OK; }

EXPORT int fmi3DoStep(void *instance, double time, double step, bool no_earlier, bool *event, bool *terminate,
                      bool *early, double *reached) {
  struct tank *tank = instance;
  double *n = tank->number;
  (void)no_earlier;
  if (n[TRAP] == 1) abort();
  if (n[TRAP] == 2) pause();
  if (n[TRAP] == 3) {
    tank->log(tank->environment, ERROR, "logStatusError", "the solver gave up");
    return ERROR;
  }
  n[LEVEL] += (0.01 * (n[VALVE] != 0) - 0.005 * (n[DRAIN] != 0) - n[LEAK]) / n[AREA] * step;
  if (n[LEVEL] < 0) n[LEVEL] = 0;
  if (n[LEVEL] > 2) n[LEVEL] = 2;
  n[FULL] = n[LEVEL] >= 1.9;
  n[VOLUME] = 1000 * n[AREA] * n[LEVEL];
  n[STEPS] += 1;
  *event = *early = false;
  *terminate = n[TRAP] == 4;
  *reached = time + step;
  return OK;
}

#define ACCESS(NAME, TYPE)                                                                                   \
  EXPORT int fmi3Set##NAME(void *tank, const uint32_t *vr, size_t count, const TYPE *value, size_t values) { \
    for (size_t i = 0; i < count && count == values; ++i) {                                                  \
      if (vr[i] >= COUNT) return ERROR;                                                                      \
      ((struct tank *)tank)->number[vr[i]] = (double)value[i];                                               \
    }                                                                                                        \
    return count == values ? OK : ERROR;                                                                     \
  }                                                                                                          \
  EXPORT int fmi3Get##NAME(void *tank, const uint32_t *vr, size_t count, TYPE *value, size_t values) {       \
    for (size_t i = 0; i < count && count == values; ++i) {                                                  \
      if (vr[i] >= COUNT) return ERROR;                                                                      \
      value[i] = (TYPE)((struct tank *)tank)->number[vr[i]];                                                 \
    }                                                                                                        \
    return count == values ? OK : ERROR;                                                                     \
  }
ACCESS_ALL(ACCESS)
