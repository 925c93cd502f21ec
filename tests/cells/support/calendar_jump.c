/* LD_PRELOAD: the calendar of a process jumps. Every reading of CLOCK_REALTIME, gettimeofday and time is moved by a
 * day forward, a day back and not at all, in turn every 50 ms; the monotonic clock is left alone. Counts how often
 * sleeps, timers and waits were asked to follow the calendar: at the end of the process the number is appended to the
 * file that CALENDAR_JUMP_REPORT names. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/syscall.h>
#include <sys/time.h>
#include <sys/timerfd.h>
#include <time.h>
#include <unistd.h>

static atomic_long readings;
static atomic_long waits;

/* The system itself, past every library. */
static int real_gettime(clockid_t clock, struct timespec* time) {
  return (int)syscall(SYS_clock_gettime, clock, time);
}

static long offset_s(void) {
  static const long day = 86400;
  struct timespec now;
  real_gettime(CLOCK_MONOTONIC, &now);
  const long turn = (now.tv_sec * 20 + now.tv_nsec / 50000000) % 3;
  return turn == 0 ? 0 : turn == 1 ? day : -day;
}

static int is_calendar(clockid_t clock) {
  return clock == CLOCK_REALTIME || clock == CLOCK_REALTIME_COARSE || clock == CLOCK_TAI;
}

int clock_gettime(clockid_t clock, struct timespec* time) {
  const int result = real_gettime(clock, time);
  if (result == 0 && is_calendar(clock)) {
    atomic_fetch_add(&readings, 1);
    time->tv_sec += offset_s();
  }
  return result;
}

int gettimeofday(struct timeval* restrict time, void* restrict zone) {
  (void)zone;
  struct timespec now;
  clock_gettime(CLOCK_REALTIME, &now);
  time->tv_sec = now.tv_sec;
  time->tv_usec = now.tv_nsec / 1000;
  return 0;
}

time_t time(time_t* out) {
  struct timespec now;
  clock_gettime(CLOCK_REALTIME, &now);
  if (out != NULL) *out = now.tv_sec;
  return now.tv_sec;
}

int clock_nanosleep(clockid_t clock, int flags, const struct timespec* until, struct timespec* left) {
  if (is_calendar(clock) && (flags & TIMER_ABSTIME) != 0) atomic_fetch_add(&waits, 1);
  return syscall(SYS_clock_nanosleep, clock, flags, until, left) == 0 ? 0 : errno;
}

int timerfd_create(int clock, int flags) {
  if (is_calendar(clock)) atomic_fetch_add(&waits, 1);
  return (int)syscall(SYS_timerfd_create, clock, flags);
}

int pthread_cond_timedwait(pthread_cond_t* restrict condition, pthread_mutex_t* restrict mutex,
                           const struct timespec* restrict until) {
  typedef int Function(pthread_cond_t*, pthread_mutex_t*, const struct timespec*);
  atomic_fetch_add(&waits, 1); /* its default clock is the calendar's */
  Function* next = (Function*)dlsym(RTLD_NEXT, "pthread_cond_timedwait");
  return next(condition, mutex, until);
}

__attribute__((destructor)) static void report(void) {
  const char* const path = getenv("CALENDAR_JUMP_REPORT");
  if (path == NULL) return;
  const int file = open(path, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600);
  if (file < 0) return;
  dprintf(file, "readings %ld waits %ld\n", atomic_load(&readings), atomic_load(&waits));
  close(file);
}
