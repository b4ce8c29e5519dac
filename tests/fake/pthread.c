// pthread_create as on a system or in a container at its process limit: fails with EAGAIN while
// THREADS threads (an environment variable) exist. For LD_PRELOAD.

#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>

static atomic_int live;

struct Start {
  void* (*run)(void*);
  void* argument;
};

static void* run(void* given) {
  const struct Start start = *(struct Start*)given;
  free(given);
  void* result = start.run(start.argument);
  atomic_fetch_sub(&live, 1);
  return result;
}

int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*function)(void*),
                   void* argument) {
  typedef int (*Create)(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*);
  const char* limit = getenv("THREADS");
  if (atomic_fetch_add(&live, 1) >= (limit ? atoi(limit) : 0)) {
    atomic_fetch_sub(&live, 1);
    return EAGAIN;
  }
  struct Start* start = malloc(sizeof *start);
  start->run = function;
  start->argument = argument;
  Create create;
  *(void**)&create = dlsym(RTLD_NEXT, "pthread_create");
  return create(thread, attributes, run, start);
}
