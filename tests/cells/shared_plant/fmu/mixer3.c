/* Three flows that are shared out to two, as an FMU whose variables are arrays: FMI 3.0, the functions that a master of
 * ours calls, and no more (https://fmi-standard.org). tests/cells/shared_plant/fmu_pack.py makes mixer3.fmu of it and
 * of mixer3.xml. */
#include <stdlib.h>
#include <string.h>

#include "fmi3.h"

enum { IN = 3, OUT = 2 };
enum { INFLOW = 2, OPEN, SHARE, OUTFLOW, STEPS, COUNT };

static const size_t kSizes[COUNT] = {0, 0, IN, OUT, OUT * IN, OUT, OUT};
struct mixer {
  double number[COUNT][OUT * IN];
};

static void mix(struct mixer *mixer) {
  for (int out = 0; out < OUT; ++out) {
    double sum = 0;
    for (int in = 0; in < IN; ++in) sum += mixer->number[SHARE][out * IN + in] * mixer->number[INFLOW][in];
    mixer->number[OUTFLOW][out] = mixer->number[OPEN][out] != 0 ? sum : 0;
  }
}

EXPORT void *fmi3InstantiateCoSimulation(const char *name, const char *token, const char *resources, bool visible,
                                         bool logging, bool events, bool early, const uint32_t *required, size_t count,
                                         void *environment, void *log, void *update) {
  (void)name, (void)resources, (void)visible, (void)logging, (void)events, (void)early, (void)required, (void)count;
  (void)environment, (void)log, (void)update;
  if (strcmp(token, "{stepwright-mixer-3}") != 0) return 0;
  struct mixer *mixer = calloc(1, sizeof *mixer);
  for (int in = 0; in < IN; ++in) mixer->number[INFLOW][in] = in + 1;
  for (int out = 0; out < OUT; ++out) mixer->number[OPEN][out] = mixer->number[SHARE][out * IN + out] = 1;
  return mixer;
}
EXPORT void fmi3FreeInstance(void *mixer) { free(mixer); }
EXPORT int fmi3EnterInitializationMode(void *mixer, bool t, double tolerance, double start, bool s, double stop) {
  (void)mixer, (void)t, (void)tolerance, (void)start, (void)s, (void)stop;
  return OK;
}
EXPORT int fmi3ExitInitializationMode(void *mixer) {
  mix(mixer);
  return OK;
}
EXPORT int fmi3Terminate(void *mixer) { (void)mixer; return OK; }

EXPORT int fmi3DoStep(void *instance, double time, double step, bool no_earlier, bool *event, bool *terminate, bool *early,
                      double *reached) {
  struct mixer *mixer = instance;
  (void)no_earlier;
  mix(mixer);
  for (int out = 0; out < OUT; ++out) mixer->number[STEPS][out] += mixer->number[OPEN][out] != 0;
  *event = *terminate = *early = false;
  *reached = time + step;
  return OK;
}

/* One variable a call, as a whole. */
#define ACCESS(NAME, TYPE)                                                                                    \
  EXPORT int fmi3Set##NAME(void *mixer, const uint32_t *vr, size_t count, const TYPE *value, size_t values) { \
    if (count != 1 || *vr >= COUNT || kSizes[*vr] != values) return ERROR;                                    \
    for (size_t i = 0; i < values; ++i) ((struct mixer *)mixer)->number[*vr][i] = (double)value[i];           \
    return OK;                                                                                                \
  }                                                                                                           \
  EXPORT int fmi3Get##NAME(void *mixer, const uint32_t *vr, size_t count, TYPE *value, size_t values) {       \
    if (count != 1 || *vr >= COUNT || kSizes[*vr] != values) return ERROR;                                    \
    for (size_t i = 0; i < values; ++i) value[i] = (TYPE)((struct mixer *)mixer)->number[*vr][i];             \
    return OK;                                                                                                \
  }
ACCESS_ALL(ACCESS)
