/* The tank of tank.py in C: a plant of a cell over shared memory (plant_models/doc/shared_plant.md).
 *
 *   cc -O2 -o tank tank.c        and in cell.toml:  command = ["./tank"]
 */
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

enum { SOCKET = 3, AREA = 4, VERSION = 1 };

struct place {
  uint32_t count, at; /* numbers, and where they begin */
};
struct header {
  char magic[8];
  uint32_t version, bytes;
  struct place actuators, sensors, values, faults, names;
  uint64_t seed;
  uint64_t step; /* the runtime asks */
  int64_t time_ns, step_ns;
  char gap[40];
  uint32_t peer_version, status; /* the plant answers */
  uint64_t done;
  char message[256];
};
_Static_assert(sizeof(struct header) == 400, "offsets as documented");

static char *area;

/* The number of a terminal: `line` is "sensor level" and the like. */
static double *number(struct place block, const char *line) {
  const struct header *head = (const struct header *)area;
  const char *at = area + head->names.at, *end = at + head->names.count;
  size_t kind = strcspn(line, " ") + 1, index = 0;
  while (at < end) {
    const char *stop = memchr(at, '\n', (size_t)(end - at));
    size_t length = (size_t)((stop ? stop : end) - at);
    if (length == strlen(line) && memcmp(at, line, length) == 0) return (double *)(area + block.at) + index;
    if (length > kind && memcmp(at, line, kind) == 0) ++index;
    at += length + 1;
  }
  fprintf(stderr, "tank: the cell has no '%s'\n", line);
  _exit(1);
}

static void answer(struct header *head) {
  head->peer_version = VERSION;
  head->done = head->step;
  if (write(SOCKET, "r", 1) != 1) _exit(0);
}

int main(void) {
  struct stat facts;
  if (fstat(AREA, &facts) != 0 || (size_t)facts.st_size < sizeof(struct header)) return 1;
  area = mmap(0, (size_t)facts.st_size, PROT_READ | PROT_WRITE, MAP_SHARED, AREA, 0);
  if (area == MAP_FAILED) return 1;
  struct header *head = (struct header *)area;
  if (memcmp(head->magic, "SWPLANT1", 8) != 0 || head->version != VERSION) return 1;
  const double *valve = number(head->actuators, "actuator valve");
  const double *drain = number(head->actuators, "actuator drain");
  const double *leak = number(head->faults, "fault leak");
  double *level = number(head->sensors, "sensor level"), *full = number(head->sensors, "sensor full");
  double *volume = number(head->values, "value volume");
  double level_m = *level = 0.2;
  char byte;
  answer(head); /* ready */
  while (read(SOCKET, &byte, 1) == 1) {
    level_m += (0.02 * *valve - 0.01 * *drain - *leak) * (double)head->step_ns * 1e-9;
    level_m = level_m < 0 ? 0 : level_m > 2 ? 2 : level_m;
    *level = level_m;
    *full = level_m >= 1.9;
    *volume = 500 * level_m;
    answer(head);
  }
  return 0;
}
