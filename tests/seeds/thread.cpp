#include "tests/seeds/thread.hpp"

#include <cerrno>
#include <utility>

extern "C" {
int __real_pthread_create(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*);
int __real_pthread_join(pthread_t, void**);
}

namespace xr3::seeds {

WorkerThread& worker_thread() {
  static WorkerThread thread;
  return thread;
}

int WorkerThread::create(pthread_t* id, void* (*function)(void*), void* argument) {
  if (is_running_) return EAGAIN;
  function_ = function;
  argument_ = argument;
  is_running_ = is_ready_ = true;
  const int error = __real_pthread_create(id, nullptr, run, this);
  if (error != 0) is_running_ = is_ready_ = false;
  return error;
}

int WorkerThread::join(pthread_t id) {
  while (is_running_) take_turn();
  return __real_pthread_join(id, nullptr);
}

void WorkerThread::take_turn() {
  is_ready_ = false;
  turn_.release();
  turn_has_ended_.acquire();
}

void WorkerThread::end_turn(pthread_mutex_t* mutex) {
  ::pthread_mutex_unlock(mutex);
  turn_has_ended_.release();
  turn_.acquire();
  ::pthread_mutex_lock(mutex);
}

void* WorkerThread::run(void* self) {
  WorkerThread& thread = *static_cast<WorkerThread*>(self);
  thread.turn_.acquire();
  void* const result = thread.function_(thread.argument_);
  thread.is_running_ = thread.is_ready_ = false;
  thread.turn_has_ended_.release();
  return result;
}

}  // namespace xr3::seeds
