// The server's calls about its process, the clock and its thread are redirected to here, as those
// in wraps.cpp.
#include <pthread.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <string_view>

#include "tests/seeds/kernel.hpp"
#include "tests/seeds/memory.hpp"
#include "tests/seeds/thread.hpp"

using xr3::seeds::current_kernel;
using xr3::seeds::Kernel;
using xr3::seeds::Outside;
using xr3::seeds::worker_thread;

extern "C" {

std::int64_t __real__ZNSt6chrono3_V212steady_clock3nowEv();
int __real_getrlimit(int, rlimit*);
int __real_setrlimit(int, const rlimit*);
int __real_getrusage(int, rusage*);
int __real_setpriority(int, id_t, int);
int __real_stat(const char*, struct stat*);
long __real_sysconf(int);
int __real_pthread_create(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*);
int __real_pthread_join(pthread_t, void**);
int __real_pthread_cond_wait(pthread_cond_t*, pthread_mutex_t*);
int __real_pthread_cond_signal(pthread_cond_t*);
int __real_pthread_cond_broadcast(pthread_cond_t*);

// It returns its only member, as far as the calling convention is concerned.
std::int64_t __wrap__ZNSt6chrono3_V212steady_clock3nowEv() {
  Kernel* kernel = current_kernel;
  return kernel == nullptr ? __real__ZNSt6chrono3_V212steady_clock3nowEv()
                           : kernel->look_at_clock();
}

// --- The worker's thread.

int __wrap_pthread_create(pthread_t* id, const pthread_attr_t* attributes, void* (*function)(void*),
                          void* argument) {
  if (current_kernel == nullptr) return __real_pthread_create(id, attributes, function, argument);
  const Outside outside;
  return worker_thread().create(id, function, argument);
}
int __wrap_pthread_join(pthread_t id, void** result) {
  if (current_kernel == nullptr) return __real_pthread_join(id, result);
  return worker_thread().join(id);
}
int __wrap_pthread_cond_wait(pthread_cond_t* condition, pthread_mutex_t* mutex) {
  if (current_kernel == nullptr) return __real_pthread_cond_wait(condition, mutex);
  worker_thread().end_turn(mutex);
  return 0;
}
int __wrap_pthread_cond_signal(pthread_cond_t* condition) {
  worker_thread().wake();
  return __real_pthread_cond_signal(condition);
}
int __wrap_pthread_cond_broadcast(pthread_cond_t* condition) {
  worker_thread().wake();
  return __real_pthread_cond_broadcast(condition);
}

// --- Memory, processor time and limits: the same in each run.

std::size_t __wrap___sanitizer_get_current_allocated_bytes() {
  return static_cast<std::size_t>(xr3::seeds::held_bytes());
}
int __wrap_getrlimit(int resource, rlimit* limit) {
  Kernel* kernel = current_kernel;
  if (kernel == nullptr) return __real_getrlimit(resource, limit);
  limit->rlim_cur = limit->rlim_max = kernel->max_descriptors;
  return 0;
}
int __wrap_setrlimit(int resource, const rlimit* limit) {
  return current_kernel == nullptr ? __real_setrlimit(resource, limit) : 0;
}
int __wrap_getrusage(int who, rusage* usage) {
  if (current_kernel == nullptr) return __real_getrusage(who, usage);
  *usage = {};
  return 0;
}
int __wrap_setpriority(int which, id_t who, int priority) {
  return current_kernel == nullptr ? __real_setpriority(which, who, priority) : 0;
}
int __wrap_stat(const char* path, struct stat* status) {
  Kernel* kernel = current_kernel;
  if (kernel == nullptr || std::string_view(path) != "/proc/self/fd")
    return __real_stat(path, status);
  *status = {};
  status->st_size = static_cast<off_t>(kernel->open_files());
  return 0;
}
long __wrap_sysconf(int name) {
  return current_kernel != nullptr && name == _SC_PAGESIZE ? 0 : __real_sysconf(name);
}

}  // extern "C"
