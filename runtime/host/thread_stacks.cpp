#include "runtime/host/thread_stacks.h"

#include <pthread.h>

namespace stepwright::host {

bool limit_thread_stacks() {
  pthread_attr_t attributes;
  if (pthread_attr_init(&attributes) != 0) return false;
  const bool done = pthread_attr_setstacksize(&attributes, kThreadStackBytes) == 0 &&
                    pthread_setattr_default_np(&attributes) == 0;
  pthread_attr_destroy(&attributes);
  return done;
}

}  // namespace stepwright::host
