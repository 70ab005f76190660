// The thread of the server's worker. It runs only while the thread of the event loop lets it and
// waits, so that a run has one order of events.
#pragma once

#include <pthread.h>

#include <semaphore>

namespace xr3::seeds {

class WorkerThread {
 public:
  /// Creates the thread; it waits for its first turn. Returns an error as pthread_create() does.
  int create(pthread_t* id, void* (*function)(void*), void* argument);
  /// Gives it turns until it has ended.
  int join(pthread_t id);

  /// It has something to do.
  bool is_ready() const { return is_ready_; }
  /// Something for it may have happened.
  void wake() { is_ready_ = is_running_; }
  /// It works until it has nothing more to do. Meanwhile the caller waits.
  void take_turn();

  /// In the worker's thread: ends its turn, and returns with the next one. The mutex is unlocked
  /// meanwhile.
  void end_turn(pthread_mutex_t* mutex);

 private:
  static void* run(void* self);

  std::binary_semaphore turn_{0};
  std::binary_semaphore turn_has_ended_{0};
  void* (*function_)(void*) = nullptr;
  void* argument_ = nullptr;
  bool is_running_ = false;
  bool is_ready_ = false;
};

/// One exists at a time.
WorkerThread& worker_thread();

}  // namespace xr3::seeds
